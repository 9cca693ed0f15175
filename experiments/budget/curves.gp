# Window, EC_BT and online error over the steps. data, target, name: by -e.
set terminal svg size 720,640 font "sans-serif,13" background "white"
set output target
set datafile separator "\t"
set key autotitle columnhead top left
set lmargin 12
set rmargin 4
set multiplot layout 3,1 title name
set ylabel "poses"
plot data using 1:2 with lines lw 1.5 lc rgb "#1b6ca8" title "window"
set ylabel "EC"
set format y "%.1t{/Symbol \327}10^{%T}"
plot data using 1:3 with lines lw 1.5 lc rgb "#1b6ca8" title "ec\\_bt", data using 1:4 with lines lw 1 dt 2 lc rgb "#b8442f" title "budget"
unset format
set ylabel "metres"
set xlabel "step"
plot data using 1:5 with lines lw 1.5 lc rgb "#1b6ca8" title "error of the newest pose"
unset multiplot
