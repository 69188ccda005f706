# SPDX-License-Identifier: LGPL-2.1-or-later
# gnuplot -e "data='muscle.dat'; folder='doc/pictures'" muscle.gp
set terminal svg size 900,520 font 'sans,13' background 'white'
set output folder.'/muscle_errors.svg'
set key outside right
set linetype 1 lc rgb '#000000' dt 1 lw 2 pt 7
set linetype 2 lc rgb '#999999' dt 1 lw 2 pt 7
set linetype 3 lc rgb '#e69f00' dt 2 lw 2 pt 6
set linetype 4 lc rgb '#8b4513' dt 2 lw 2 pt 6
set linetype 5 lc rgb '#d55e00' dt 1 lw 2 pt 7
set linetype 6 lc rgb '#009e73' dt 1 lw 2 pt 7
set linetype 7 lc rgb '#66c2a5' dt 2 lw 2 pt 6
set linetype 8 lc rgb '#56b4e9' dt 1 lw 2 pt 7
set linetype 9 lc rgb '#0072b2' dt 1 lw 2 pt 7
set linetype 10 lc rgb '#7b3294' dt 1 lw 2 pt 7
set grid lc rgb '#dddddd'
set logscale xy
set format y '10^{%T}'
set xtics (8, 16, 32, 64, 128)
set xrange [7:150]
set xlabel 'steps on 0.2 s'
set ylabel 'relative error of the displacements at the end'
stats data using 1 nooutput
plot for [i=0:STATS_blocks-2] data index i using 1:2 with linespoints lt (i+1) title columnheader(1)
