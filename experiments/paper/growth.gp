# Figures 4 and 5: factors and EC over time, for every policy at rate r; dashed: what the paper predicts from `full`.
load system("dirname '".ARG0."'").'/style.gp'
set terminal svg size 1100,420 font 'sans,13' background rgb 'white'
file(policy) = out.'/'.policy.r.'.trace.tsv'
whole = out.'/full.trace.tsv'
set multiplot layout 1,2
set xlabel 'step'
set key bottom right  # curves rise to the top
set logscale y
set format y '10^{%T}'
set ylabel 'factors'
plot whole using (column('step')):(column('edges')) with lines lw 2 lc rgb full title 'full', \
     file('rand') using (column('step')):(column('edges')) with lines lw 2 lc rgb rand title sprintf('rand%d', r), \
     file('tgreedy') using (column('step')):(column('edges')) with lines lw 2 lc rgb tgreedy title sprintf('tgreedy%d', r), \
     file('dec') using (column('step')):(column('edges')) with lines lw 2 lc rgb dec title sprintf('dec%d', r), \
     file('kf') using (r*column('step')):(column('edges')) with lines lw 2 lc rgb kf title sprintf('kf%d', r)
set ylabel 'elimination complexity, COLAMD'
plot whole using (column('step')):(column('ec')) with lines lw 2 lc rgb full title 'full', \
     file('rand') using (column('step')):(column('ec')) with lines lw 2 lc rgb rand title sprintf('rand%d', r), \
     file('tgreedy') using (column('step')):(column('ec')) with lines lw 2 lc rgb tgreedy title sprintf('tgreedy%d', r), \
     file('dec') using (column('step')):(column('ec')) with lines lw 2 lc rgb dec title sprintf('dec%d', r), \
     file('kf') using (r*column('step')):(column('ec')) with lines lw 2 lc rgb kf title sprintf('kf%d', r), \
     whole using (column('step')):(column('ec')*9/r**2) with lines lw 1.5 dt 2 lc rgb dec title 'full × 9/r^2', \
     whole using (column('step')):(column('ec')/r**3) with lines lw 1.5 dt 2 lc rgb kf title 'full / r^3'
unset multiplot
