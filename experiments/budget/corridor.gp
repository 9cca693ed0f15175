# Time of a step and memory over the steps of a corridor. data, target: by -e.
set terminal svg size 720,460 font "sans-serif,13" background "white"
set output target
set datafile separator "\t"
set lmargin 12
set rmargin 4
set multiplot layout 2,1 title "a window of 20 poses on a corridor"
set yrange [0:*]
set ylabel "microseconds"
plot data using 1:(1e6 * $2) every ::1 with lines lw 1.5 lc rgb "#1b6ca8" title "update, mean of 1000 steps"
set ylabel "megabytes"
set xlabel "step"
plot data using 1:3 every ::1 with lines lw 1.5 lc rgb "#1b6ca8" title "memory"
unset multiplot
