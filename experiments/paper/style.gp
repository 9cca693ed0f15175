# What the figures share: size, font, a colour for every policy, tab-separated input with a header.
set terminal svg size 720,420 font 'sans,13' background rgb 'white'
set output target
set datafile separator '\t'
set key top left Left reverse samplen 2
set grid lc rgb '#dddddd'
set border 3
set tics nomirror
set format y '%.1te%T'
full = '#222222'; rand = '#d95f02'; tgreedy = '#7570b3'; dec = '#1b9e77'; kf = '#1f78b4'
