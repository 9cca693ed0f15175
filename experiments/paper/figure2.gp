# Figure 2: EC under COLAMD and EC of iSAM2's Bayes tree, over time.
load system("dirname '".ARG0."'").'/style.gp'
data = out.'/full.cost.tsv'
set xlabel 'step'
set ylabel 'elimination complexity'
plot data using (column('step')):(column('ec_colamd')) with lines lw 2 lc rgb kf title 'EC, COLAMD', \
     data using (column('step')):(column('ec_bt')) with lines lw 2 lc rgb rand title 'EC, iSAM2''s Bayes tree'
