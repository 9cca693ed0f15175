# Figure 3: batch elimination time and iSAM2 update time against EC under COLAMD, with the least-squares line.
load system("dirname '".ARG0."'").'/style.gp'
data = out.'/full.cost.tsv'
f(x) = a * x + b
a = 1e-9; b = 1e-4
set fit quiet logfile '/dev/null'
set xlabel 'elimination complexity under COLAMD'
set ylabel 'time [s]'
set format x '%.0te%T'
stats data using (column('ec_colamd')):(column('batch_s')) name 'batch' nooutput
fit f(x) data using (column('ec_colamd')):(column('batch_s')) via a, b
plot data using (column('ec_colamd')):(column('update_s')) with points pt 7 ps 0.35 lc rgb rand title 'iSAM2 update', \
     data using (column('ec_colamd')):(column('batch_s')) with points pt 7 ps 0.35 lc rgb kf title 'batch elimination', \
     f(x) with lines lw 1.5 lc rgb full title sprintf('least squares, R^2 = %.4f', batch_correlation**2)
