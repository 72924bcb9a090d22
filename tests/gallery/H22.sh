# H22: the last record stands at until, whatever the step: its time, less that.
for scheme in $schemes; do
    for until in 0.3 0.7 1; do fall 0.1 $until | row $scheme 0 'END { printf "%.2g", abs($1 - '$until') }'; done
    fall 0.03 1 | row $scheme 0 'END { printf "%.2g", abs($1 - 1) }'
done
for scheme in subcycle miao; do fall 0.02 0.34 | row $scheme 0 'END { printf "%.2g", abs($1 - 0.34) }' --set integrate.ratio=5; done
