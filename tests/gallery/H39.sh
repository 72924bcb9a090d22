# H39: ratios and steps that are none are refused; a ratio of 1 is the single rate, byte for byte.
for set in ratio=0 ratio=-1 step=0 step=-1 step=9 ratio=1000000000 step=5.0e-324; do
    fall 1.0e-2 1 | row subcycle told "${set%=*}" --set integrate.$set
done
"$FMDSUB" run -q --set integrate.scheme=midpoint "$ROOT/decks/chain.yaml" 2>/dev/null | cksum >single
"$FMDSUB" run -q --set integrate.scheme=subcycle --set integrate.ratio=1 --set partition.fast=[] "$ROOT/decks/chain.yaml" 2>err | cksum >one
line subcycle 0 0 "$(cmp -s single one; echo $?)"
