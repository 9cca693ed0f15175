# What of the EC is left by each policy, over how long a landmark is in sight; a panel an ordering.
set terminal svg size 1100,460 font 'sans,13' background rgb 'white'
set output target
set datafile separator '\t'
set datafile missing '-'
set grid lc rgb '#dddddd'
set border 3
set tics nomirror
set logscale xy
set xlabel 'observations a landmark'
set ylabel 'EC, of the whole graph''s'
set key below
set yrange [0.003:1.2]
share(policy, ordering) = sprintf("< awk -F '\t' 'NR > 1 && $6 == \"full\" && $5 == \"%s\" {whole[$1,$2,$3] = $9} NR > 1 && $6 == \"%s\" && $5 == \"%s\" && $9 != \"-\" {print $4 \"\t\" $9 / whole[$1,$2,$3]}' %s", ordering, policy, ordering, data)
set multiplot layout 1,2
do for [ordering in 'colamd wmf'] {
  set title ordering
  plot share('rand@4', ordering) with points pt 6 lc rgb '#d95f02' title 'rand, r = 4', \
       share('tgreedy@4', ordering) with points pt 4 lc rgb '#7570b3' title 'tgreedy, r = 4', \
       share('dec@4', ordering) with points pt 8 lc rgb '#1b9e77' title 'dec, r = 4', \
       share('kf@4', ordering) with points pt 10 lc rgb '#1f78b4' title 'kf, r = 4', \
       9/16. with lines dt 2 lc rgb '#1b9e77' title '9/r^2', \
       1/64. with lines dt 2 lc rgb '#1f78b4' title '1/r^3'
}
unset multiplot
