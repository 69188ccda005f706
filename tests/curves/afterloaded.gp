# SPDX-License-Identifier: LGPL-2.1-or-later
# gnuplot -e "run='results/afterloaded_contraction'; folder='doc/pictures'" afterloaded.gp
set terminal svg size 900,640 font 'sans,13' background 'white'
set datafile separator ','
set output folder.'/afterloaded.svg'
set grid lc rgb '#dddddd'
set key outside right
set lmargin 10
set rmargin 26
set xrange [0:0.4]
set multiplot layout 3,1
set ylabel 'activation [-]'
set yrange [0:1.1]
plot run.'/activation_muscle_length-3d.csv' using 1:2 with lines lw 2 lc rgb '#000000' title 'activation'
set ylabel 'force [N]'
set yrange [-9:10]
plot run.'/reaction.csv' using 1:5 with lines lw 2 lc rgb '#0072b2' title 'muscle', \
     '' using 1:8 with lines lw 2 lc rgb '#d55e00' title 'stop'
set ylabel 'shortening [mm]'
set yrange [*:*]
set xlabel 'time [s]'
plot run.'/displacements-3d.csv' using 1:(-1e3*$2) with lines lw 2 lc rgb '#009e73' title 'end'
unset multiplot
