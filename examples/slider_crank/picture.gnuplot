# Deflection of the middle of the rod over its length, all models (variable out: folder of the CSV files).
set terminal pngcairo size 1000,600 font 'sans,11'
set output out.'/deflection.png'
set datafile separator ','
set encoding utf8
set border 3 lc rgb '#444444'
set tics nomirror
set format '%h'
set grid back lc rgb '#DDDDDD' lt 1 lw 0.7
set title 'Slider-crank of Goncalves and Ambrosio: deflection of the middle of the rod over its length'
set xlabel 'time [s]'
set key bottom left
plot out.'/exact.csv' every ::1 using 1:2 with lines lw 3 lc rgb '#bbbbbb' title 'geometrically exact beam', \
  out.'/beams.csv' every ::1 using 1:2 with lines lc rgb '#000000' title 'nonlinear beams', \
  out.'/one_M.csv' every ::1 using 1:2 with lines lc rgb '#cc5500' title 'one superelement', \
  out.'/pieces_2_M.csv' every ::1 using 1:2 with lines lc rgb '#0066cc' title 'two superelements', \
  out.'/pieces_4_M.csv' every ::1 using 1:2 with lines dt 2 lc rgb '#008844' title 'four superelements'
