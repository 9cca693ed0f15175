# What each way of taking poses out of a graph loses over the elimination complexity that it leaves, one panel a rate, logarithmic.
set terminal svg size 980,760 font 'sans,12' background rgb 'white' enhanced
set output out
set datafile separator '\t'
set datafile missing '-'
set logscale xy
set format y '%g'
set autoscale noextend
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
set grid lc rgb '#e4e4e4'
set border 3
set tics nomirror
# Ticks at 1, 2, 3 and 5 of every power of ten: a panel may span less than one.
set xtics ()
do for [power=2:12] { do for [digit in '1 2 3 5'] { set xtics add (gprintf('%.0s%c', digit * 10**power) digit * 10**power) } }
set key at screen 0.99, screen 0.93 right top Left reverse samplen 1 noenhanced
families = '^tree@ ^subgraph@ ^l1@ ^seif@ ^kf$ ^kf[+] ^ec@'
names = 'tree subgraph l1 seif kf kf|ecgreedy ec'
colours = '#1f78b4 #1b9e77 #d95f02 #7570b3 #a6761d #666666 #b2182b'
shapes = '5 9 11 13 6 4 7'
# Sorted by EC: ec's prices are one curve, whatever their clustering.
rows(k, rate) = sprintf("< awk -F'\\t' '$1 == \"%s\" && $2 == \"%s\" && $3 ~ /%s/ && $8 + 0 > 0' %s | sort -t \"\t\" -k 7,7g", graph, rate, word(families, k), table)
rates = system(sprintf("awk -F'\\t' '$1 == \"%s\" && $8 + 0 > 0 {print $2}' %s | sort -nu | paste -sd' '", graph, table))
set multiplot layout (words(rates) + 1) / 2, 2 title graph noenhanced margins 0.08, 0.86, 0.09, 0.91 spacing 0.08, 0.16
do for [n=1:words(rates)] {
  set title 'one pose of '.word(rates, n)
  set xlabel (n > words(rates) - 2 ? 'elimination complexity (wmf)' : '')
  set ylabel (n % 2 ? 'divergence lost, nats' : '')
  plot for [k=1:6] rows(k, word(rates, n)) using 7:8 with points pt (int(word(shapes, k))) ps 0.9 lc rgb word(colours, k) title word(names, k), \
       rows(7, word(rates, n)) using 7:8 with linespoints lw 1 pt 7 ps 0.7 lc rgb word(colours, 7) title word(names, 7)
  set key off
}
unset multiplot
