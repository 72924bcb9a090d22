set terminal svg size 1100,520 font 'Arial,13' background 'white'
set output 'x.svg'
$front1 << END
END
$line0 << END
END
$line1 << END
END
set datafile missing '?'
set logscale xy
set format xy '10^{%T}'
set border 3 lc rgb '#404040'
set tics nomirror out
set grid lt 1 lc rgb '#e4e4e4'
set tmargin at screen 0.86
set bmargin at screen 0.13
set yrange
set arrow 1 from graph 0, first E to graph 1, first E nohead dt 3 lc rgb '#606060'
set label 1 ' the reference itself' at graph 0, first E offset 0,0.6 tc rgb '#606060'
set multiplot title 'Simple pendulum, IFToMM A01' noenhanced
set ylabel 'error, over the range of the worst column'
set lmargin at screen 0.085
set rmargin at screen 0.735
set xlabel 'work [evaluations of all bodies]'
set key at screen 0.985,0.86 right top Left reverse noenhanced samplen 2 spacing 1.25
plot $front1 using 1:3 with steps lc rgb '#d0d0d0' lw 7 title 'least cost', \
  $line0 using 1:3 with linespoints lw 1.5 ps 0.8 pt 7 dt 1 lc rgb '#0072b2' title 'midpoint  x D a digit', \
  $line1 using 1:3 with linespoints lw 1.5 ps 0.8 pt 5 dt 1 lc rgb '#d55e00' title 'dop853  x D a digit'
unset multiplot
