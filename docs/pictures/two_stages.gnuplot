# The README's picture: a part of stage 1 (mesh of the chassis) and a motion of stage 2 (rod of the slider-crank).
# Run from the root of the tree, after examples/chassis/run and examples/slider_crank/run:
#   gnuplot docs/pictures/two_stages.gnuplot
set terminal pngcairo size 1200,430 font 'sans,11' background 'white'
set output 'docs/pictures/two_stages.png'
set encoding utf8
lines = 'build/examples/chassis/lines.txt'
out = 'build/examples/slider_crank'
set multiplot layout 1,2

set origin 0.0, 0.0
set size 0.5, 1.0
set title 'reducer: a chassis becomes eight nodes and twenty modes' font 'sans,12'
unset border
unset tics
unset colorbox
unset key
set view 62, 32, 2.5, 1.0
set view equal xyz
splot lines using 1:2:($4 == 3 ? $3 : NaN) with lines lc rgb '#AAAAAA' lw 0.8, \
  lines using 1:2:($4 == 1 ? $3 : NaN) with lines lc rgb '#1F4E9A' lw 1.6, \
  lines using 1:2:($4 == 15 ? $3 : NaN) with points pt 7 ps 1.0 lc rgb '#C0392B'

set origin 0.5, 0.0
set size 0.5, 1.0
set border 3 lc rgb '#444444'
set xtics nomirror
set ytics nomirror
set format '%h'
set grid back lc rgb '#DDDDDD' lt 1 lw 0.7
set key bottom left samplen 2 font 'sans,10'
set datafile separator ','
set title 'mechanism: deflection of the rod of a slider-crank, over its length' font 'sans,12'
set xlabel 'time [s]'
plot [0:0.06] out.'/exact.csv' every ::1 using 1:2 with lines lw 5 lc rgb '#CCCCCC' title 'geometrically exact beam', \
  out.'/one_M.csv' every ::1 using 1:2 with lines lw 1.5 lc rgb '#CC5500' title 'one superelement', \
  out.'/pieces_2_M.csv' every ::1 using 1:2 with lines lw 1.5 lc rgb '#0066CC' title 'two superelements', \
  out.'/beams.csv' every ::1 using 1:2 with lines lw 1.5 dt 2 lc rgb '#000000' title 'eight nonlinear beams'
unset multiplot
