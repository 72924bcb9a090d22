# H25: a drive turns a crank that is longer than its rod: it locks at asin(0.15/0.35) = 0.442911 s, and that is told.
for scheme in $schemes rk4; do
    row $scheme told "stopped at t = 0.442.*'wrist' cannot be kept" <"$ROOT/tests/hard/locked-drive.yaml"
done
