# EC, time to order and time to eliminate, by graph and method, as ratios.
set terminal svg size 1250,1150 font 'sans,12' noenhanced background rgb 'white'
set output target
set datafile separator '\t'
set datafile missing 'NaN'
data = out.'/ratios.tsv'
names = 'colamd amd metis scotch wmf best'
colours = '#222222 #7570b3 #1b9e77 #a6a6a6 #d95f02 #e7298a'
shapes = '7 5 9 11 13 6'
set grid ytics xtics lc rgb '#e4e4e4'
set border 3
set tics nomirror
set logscale y 2
set xtics rotate by 40 right font ',10'
set offsets 0.5, 0.5, 0, 0
set lmargin 10
set key outside right top Left reverse samplen 1
points(kind) = sprintf('for [i=1:6] data using 0:(column("%s_".word(names, i))):xtic(1) with points ' \
  .'pt (int(word(shapes, i))) ps 1.1 lc rgb word(colours, i) title word(names, i)', kind)
set multiplot layout 3,1
set title 'elimination complexity, by that of colamd'
eval 'plot '.points('ec')
set title 'CPU time to order, by that of amd'
eval 'plot '.points('order')
set title 'time to eliminate (one thread), by that of colamd'
eval 'plot '.points('eliminate')
unset multiplot
