# Left: the chain of rigid links every tenth of a second. Right: CPU time per step and link against the number of links.
# Called with shapes (x z, instants apart by two empty lines), costs (kind, links, microseconds), picture.
set terminal pngcairo size 1500,700 font 'sans,15' linewidth 1.3 background 'white'
set output picture
set encoding utf8
set border 3 lc rgb '#444444'
set tics nomirror
set format '%h'
set grid back lc rgb '#DDDDDD' lt 1 lw 0.7
set multiplot layout 1,2
set title 'Forty rigid links falling, every 0.1 s'
set xlabel 'x [m]'
set ylabel 'z [m]'
set key off
plot shapes using 1:2 with lines lc rgb '#1F4E9A'
set title 'CPU time per step and link'
set xlabel 'links'
set ylabel '[us]'
set logscale x
set yrange [0:*]
set key top left
plot for [kind in 'rigid superelement virtual'] costs using (strcol(1) eq kind ? $2 : NaN):3 with linespoints pt 7 lw 1.5 title kind
unset multiplot
