# SPDX-License-Identifier: LGPL-2.1-or-later
# gnuplot -e "study='results/force_velocity'; folder='doc/pictures'" force_velocity.gp
# Shortening of the block beside the force-velocity curve of its fibres, thesis (A.2.3), with e0 = 5 1/s.
set terminal svg size 900,520 font 'sans,13' background 'white'
set datafile separator ','
set output folder.'/force_velocity.svg'
set grid lc rgb '#dddddd'
set key outside right
set xlabel 'load over isometric force [-]'
set ylabel 'shortening [lengths/s]'
set xrange [0:1]
set yrange [0:6]
set parametric
set trange [0:1.2]
slow(e) = 29.825565*e**3 - 0.943550*e**2 + 0.970369*e + 0.350355
fast(e) = 0.257927*e**3 + 0.143175*e**2
factor(v) = v < 0.25 ? slow(0.25 - v) : fast(1.2 - v)
plot factor(t), 5*t with lines lw 2 lc rgb '#000000' title 'fibres (A.2.3)', \
     '< grep "pennation=0," '.study.'/study.csv' using 4:(-$7) with linespoints pt 7 lw 2 lc rgb '#0072b2' title 'block, 0 degrees', \
     '< grep "pennation=15," '.study.'/study.csv' using 4:(-$7) with linespoints pt 7 lw 2 lc rgb '#d55e00' title 'block, 15 degrees'
