# Sigma and ATE of a graph's policies over elimination complexity under wmf, logarithmic.
set terminal svg size 980,430 font 'sans,12' background rgb 'white' enhanced
set output target
set datafile separator '\t'
set datafile missing '-'
set logscale xy
set format x '10^{%L}'
set format y '%g'
set autoscale noextend
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
set grid lc rgb '#e4e4e4'
set border 3
set tics nomirror
set lmargin 9
set xlabel 'elimination complexity (wmf)'
families = '^full$ ^kf@[0-9]+$ ^dec ^aligned ^rand ^tgreedy ^covisible ^ecgreedy [+]ecgreedy'
names = 'full kf dec aligned rand tgreedy covisible ecgreedy kf|ecgreedy'
colours = '#222222 #1f78b4 #1b9e77 #66a61e #d95f02 #7570b3 #a6761d #e7298a #b2182b'
shapes = '7 5 9 11 13 6 4 7 5'
# What left nothing out has no error to show on a logarithmic axis.
rows(k, column) = sprintf("< awk -F'\\t' '$1 == \"%s\" && $2 ~ /%s/ && $%d > 1e-5' %s", graph, word(families, k), column, data)
plots(column) = sprintf('for [k=1:9] rows(k, %d) using 6:%d with linespoints lw 1 pt (int(word(shapes, k))) ps 0.9 lc rgb word(colours, k) title word(names, k)', column, column)
set multiplot layout 1,2 title graph noenhanced
set key off
set ylabel 'sigma, metres'
eval 'plot '.plots(7)
set key outside right top Left reverse samplen 1 noenhanced
set ylabel 'ATE against the optimum, metres'
eval 'plot '.plots(8)
unset multiplot
