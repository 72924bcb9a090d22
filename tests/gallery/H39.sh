# H39: ratios and steps that are none are refused; a ratio of 1 is the single rate, byte for byte.
for set in step=0 step=-1 step=9 step=5.0e-324; do
    for scheme in $schemes; do fall 1.0e-2 1 | row $scheme told step --set integrate.$set; done
done
for set in ratio=0 ratio=-1 ratio=1000000000; do
    for scheme in subcycle miao; do fall 1.0e-2 1 | row $scheme told ratio --set integrate.$set; done
done
for pair in subcycle:midpoint miao:newmark; do
    begun=$(date +%s%N)
    "$FMDSUB" run -q --set integrate.scheme=${pair#*:} "$ROOT/decks/chain.yaml" 2>/dev/null | cksum >single
    "$FMDSUB" run -q --set integrate.scheme=${pair%:*} --set integrate.ratio=1 --set partition.fast=[] "$ROOT/decks/chain.yaml" 2>err | cksum >one
    line ${pair%:*} 0 0 "$(cmp -s single one; echo $?)"
done
