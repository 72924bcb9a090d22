# motion.gp -- one coordinate of the bar-slider: n:1 beside 1:1, and what each is away from the reference.
# From figures.sh: form, data, out, n, which (its column), errors (that of the difference), what, unit.
if (form eq "png") set term pngcairo size 900,760 font ",11"; else set term svg size 900,760 font "Helvetica,13" background "white"
set output out
set datafile separator ","
set multiplot
set lmargin 13
set rmargin 4
set grid lc rgb "#dddddd"
set key top left samplen 2
set xrange [0:2]
set title what
set size 1,0.58
set origin 0,0.42
set ylabel unit
set format x ""
near(name) = data . "/" . name . ".near.csv"
plot data . "/reference-constant.csv" using 1:which with lines lw 1 lc rgb "#aaaaaa" title "torque 100 N m (the other reading)", \
     near("newmark-1") using 1:which with lines lw 3 lc rgb "#1f77b4" title "torque 100 N m/s t, newmark 1:1", \
     near("miao-" . n) using 1:which every 5 with points pt 6 ps .7 lc rgb "#d62728" title "miao " . n . ":1", \
     near("subcycle-" . n) using 1:which every 5::2 with points pt 2 ps .7 lc rgb "#2ca02c" title "subcycle " . n . ":1"
unset title
set size 1,0.42
set origin 0,0
set format x "%g"
set xlabel "t [s]"
set ylabel "difference from the reference"
set format y "%.1e"
set key top left horizontal samplen 2
set offsets 0, 0, graph .18, graph .03
plot near("newmark-1") using 1:errors with lines lw 2 lc rgb "#1f77b4" title "newmark 1:1", \
     near("miao-" . n) using 1:errors with lines lw 2 lc rgb "#d62728" title "miao " . n . ":1", \
     near("subcycle-" . n) using 1:errors with lines lw 2 lc rgb "#2ca02c" title "subcycle " . n . ":1"
unset multiplot
