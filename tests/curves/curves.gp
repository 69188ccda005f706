# SPDX-License-Identifier: LGPL-2.1-or-later
# gnuplot -e "data='curves.dat'; folder='doc/pictures'" curves.gp
set terminal svg size 900,520 font 'sans,13' background 'white'
set key outside right
set linetype 1 lc rgb '#000000' dt 1 lw 2
set linetype 2 lc rgb '#999999' dt 1 lw 2
set linetype 3 lc rgb '#0072b2' dt 1 lw 2
set linetype 4 lc rgb '#56b4e9' dt 1 lw 2
set linetype 5 lc rgb '#e69f00' dt 2 lw 2
set linetype 6 lc rgb '#c8b400' dt 2 lw 2
set linetype 7 lc rgb '#8b4513' dt 2 lw 2
set linetype 8 lc rgb '#d55e00' dt 1 lw 2
set linetype 9 lc rgb '#cc79a7' dt 1 lw 2
set linetype 10 lc rgb '#009e73' dt 1 lw 2
set linetype 11 lc rgb '#66c2a5' dt 1 lw 2
set linetype 12 lc rgb '#7b3294' dt 4 lw 2
set xlabel 'time step / period'
set grid lc rgb '#dddddd'
set key autotitle columnheader
stats data using 1 nooutput
n = STATS_blocks - 1

set logscale x
set format x '10^{%T}'
set output folder.'/spectral_radius.svg'
set ylabel 'spectral radius'
set yrange [0:1.3]
set xrange [0.01:100]
plot for [i=0:n-1] data index i using 1:2 with lines lt (i+1) title columnheader(1)

unset logscale x
set format x '%g'
set xrange [0:0.4]
set output folder.'/damping.svg'
set ylabel 'algorithmic damping ratio'
set yrange [0:0.2]
plot for [i=0:n-1] data index i using 1:3 with lines lt (i+1) title columnheader(1)

set output folder.'/period_error.svg'
set ylabel 'relative period error'
set yrange [-0.2:0.5]
plot for [i=0:n-1] data index i using 1:4 with lines lt (i+1) title columnheader(1)
