# Error against CPU time of one joint: a panel per number of superelements, all other runs in grey behind.
# Called with table, joint, picture.
set terminal pngcairo size 1500,1250 font 'sans,15' linewidth 1.3 background 'white'
set output picture
set datafile separator ','
set encoding utf8
rms_of_signal = joint eq 'revolute' ? 2.467e-2 : 3.617e-2
heading = joint eq 'revolute' ? 'Hinged beam, [Car00] 8.1' : 'Beam on a spherical joint, [Car00] 8.2'
set logscale xy
set format xy '10^{%T}'
set mxtics 10
set mytics 10
set grid back lc rgb '#DDDDDD' lt 1 lw 0.7
set border 3 lc rgb '#444444'
set tics nomirror
set xrange [0.004:8]
set yrange [(joint eq 'revolute' ? 6e-4 : 5e-4):(joint eq 'revolute' ? 0.4 : 2)]
set key at graph 0.02, 0.03 left bottom Left reverse samplen 2 spacing 1.05 font ',13'
row(family, parts, modes) = (strcol(1) eq joint && strcol(2) eq family && $3 == parts && $4 == modes && strcol(12) eq 'completed')
relative(family, parts, modes) = row(family, parts, modes) ? $10 / rms_of_signal : NaN
# A cut between the two modes of a pair keeps both: these runs have one mode more per superelement than asked for.
completed(parts) = (strcol(1) eq joint && strcol(2) eq 'superelements' && $3 == parts && strcol(12) eq 'completed' \
  && $6 - 12 * parts > $4 * parts) ? $10 / rms_of_signal : NaN
array modes[5] = [0, 2, 4, 6, 8]
array colours[5] = ['#000000', '#56B4E9', '#0072B2', '#E69F00', '#D55E00']
array marks[5] = [4, 6, 8, 12, 14]
array names[5] = ['no modes', '2 modes', '4 modes', '6 modes', '8 modes']
set multiplot layout 2,2 title heading.': error against CPU time; steps from 0.05 (left) to 0.0005 (right)' font ',18'
do for [panel = 0:3] {
  pieces = 2**panel
  set title sprintf(pieces == 1 ? '%d superelement' : '%d superelements', pieces)
  set xlabel panel > 1 ? 'CPU time of the run without reading the model [s]' : ''
  set ylabel panel % 2 == 0 ? 'RMS error / RMS of the signal' : ''
  plot for [other = 0:3] for [i = 1:5] table using 9:(relative('superelements', 2**other, modes[i])) with points pt 7 ps 0.5 lc rgb '#DDDDDD' notitle, \
    table using 9:(relative('nonlinear', 2 * pieces, 0)) with linespoints pt 5 ps 0.8 dt (6,4) lc rgb '#999999' title sprintf('%d nonlinear beams of 3 nodes', 2 * pieces), \
    for [i = 1:5] table using 9:(relative('superelements', pieces, modes[i])) with linespoints pt marks[i] ps 1.2 lc rgb colours[i] title names[i], \
    table using 9:(completed(pieces)) with points pt 7 ps 0.7 lc rgb '#000000' title (pieces > 1 ? 'pair of equal frequencies completed' : '')
}
unset multiplot
