# H21: free fall in steps of 1e-9 s, its acceleration; steps that time cannot resolve are refused.
for scheme in $schemes; do
    fall 1.0e-9 1.0e-6 | row $scheme 1e-9 'NR > 1 { see($2 + 9.81) } END { printf "%.2g", worst }'
done
fall 1.0e-17 1 | row deck told 'vanishes beside'
