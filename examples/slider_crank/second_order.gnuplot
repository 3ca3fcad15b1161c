# One body: linear and of second order, beside the exact beam (variable out: folder of the CSV files).
set terminal svg size 900,480 font 'sans,13' background '#ffffff'
set output out.'/second_order.svg'
set datafile separator ','
set encoding utf8
set border 3 lc rgb '#444444'
set tics nomirror
set format '%h'
set grid back lc rgb '#DDDDDD' lt 1 lw 0.7
set title 'Deflection of the middle of the rod over its length, one superelement'
set xlabel 'time [s]'
set xrange [0:0.06]
set key outside bottom center horizontal
plot out.'/exact.csv' every ::1 using 1:2 with lines lw 6 lc rgb '#bbbbbb' title 'geometrically exact beam', \
  out.'/one_B.csv' every ::1 using 1:2 with lines lw 1.5 dt 3 lc rgb '#888888' title 'linear, inertia B', \
  out.'/one_M.csv' every ::1 using 1:2 with lines lw 1.5 lc rgb '#cc5500' title 'linear, inertia M', \
  out.'/one_second_8.csv' every ::1 using 1:2 with lines lw 1.5 lc rgb '#0066cc' title 'second order'
