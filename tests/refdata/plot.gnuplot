set terminal svg size 970,480 font 'Arial,13' background 'white'
set output 'picture.svg'
$file0 << END
0 0.1 1 0
0.5 0.2 0.5 NaN
1 0.15 0.25 1e-9
END
set xrange [0:1]
set border 3 lc rgb '#404040'
set tics nomirror out
set key at graph 1.02,1 left top Left reverse noenhanced samplen 2 spacing 1.2
set grid lt 1 lc rgb '#e4e4e4'
set lmargin at screen 0.1134
set rmargin at screen 0.8041
set multiplot layout 2,1
set tmargin at screen 0.9750
set bmargin at screen 0.5813
set format x ''
set ylabel '' noenhanced
plot $file0 using 1:2 with lines lw 1.6 dt 1 lc rgb '#0072b2' title 'arm.angle', \
  $file0 using 1:3 with lines lw 1.6 dt 1 lc rgb '#d55e00' title 'arm.x'
set tmargin at screen 0.5375
set bmargin at screen 0.1438
set format x
set xlabel 't' noenhanced
set ylabel 'energy.residual' noenhanced
plot $file0 using 1:4 with lines lw 1.6 dt 1 lc rgb '#0072b2' title 'energy.residual'
unset multiplot
