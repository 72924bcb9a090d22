# costs.gp -- share of the time of 1:1 over the price of a slow sweep in fast ones: what is counted, and what is printed.
if (form eq "png") set term pngcairo size 900,560 font ",11"; else set term svg size 900,560 font "Helvetica,13" background "white"
set output out
set title "Time of n:1 over that of 1:1, same minor step: counted at any price of a slow sweep, and as printed"
set logscale x
set xrange [0.1:1000]
set yrange [0:1.45]
set grid lc rgb "#dddddd"
set xlabel "price of a sweep over the slow bodies, in sweeps over the fast ones"
set ylabel "share of the time of 1:1"
set key top right
slow(n) = real(system(sprintf("awk '$1 == %d { print $2 }' %s/costs.dat", n, data)))
fast(n) = real(system(sprintf("awk '$1 == %d { print $3 }' %s/costs.dat", n, data)))
s1 = slow(1); f1 = fast(1); s5 = slow(5); f5 = fast(5); s10 = slow(10); f10 = fast(10)
share(s, f, r) = (s * r + f) / (s1 * r + f1)
at(s, f, y) = (f - y * f1) / (y * s1 - s)
r5 = at(s5, f5, .54)
r10 = at(s10, f10, .202)
set arrow from r5, 0 to r5, .54 nohead dt 2 lc rgb "#d62728"
set arrow from r10, 0 to r10, .202 nohead dt 2 lc rgb "#9467bd"
set label sprintf("%.1f", r5) at r5 * 1.08, .04 tc rgb "#d62728"
set label sprintf("%.0f", r10) at r10 * 1.08, .04 tc rgb "#9467bd"
plot share(s5, f5, x) with lines lw 2 lc rgb "#d62728" title "miao 5:1, counted", \
     share(s10, f10, x) with lines lw 2 lc rgb "#9467bd" title "miao 10:1, counted", \
     .54 with lines dt 2 lw 2 lc rgb "#d62728" title "5:1 in print: 118 s of 218 s", \
     .202 with lines dt 2 lw 2 lc rgb "#9467bd" title "10:1 in print: 44 s of 218 s"
