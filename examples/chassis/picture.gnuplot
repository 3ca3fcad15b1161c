# The mesh of the chassis: shells in grey, beams in blue, point masses and boundary nodes as dots.
# Called with lines (three columns and the kind: 1 beam, 3 shell, 15 point; segments apart by two empty lines), picture.
set terminal pngcairo size 1500,800 font 'sans,15' linewidth 1.3 background 'white'
set output picture
set encoding utf8
unset border
unset tics
unset colorbox
set title 'Chassis after [GA00]: 262 beams, 121 shells, 18 point masses and 8 attachments'
set view 62, 32, 2.4, 1.0
set view equal xyz
set key off
splot lines using 1:2:($4 == 3 ? $3 : NaN) with lines lc rgb '#AAAAAA' lw 0.8, \
  lines using 1:2:($4 == 1 ? $3 : NaN) with lines lc rgb '#1F4E9A' lw 1.8, \
  lines using 1:2:($4 == 15 ? $3 : NaN) with points pt 7 ps 1.1 lc rgb '#C0392B'
