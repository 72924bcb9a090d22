# derivatives.sh -- columns by themselves: what is called a rate is the rate of what it is called after, works grow by their powers.
. tests/tools/lib.sh

rates() { # DECK STEP UNTIL APART PAIRS POWERS
    "$FMDSUB" run -q --units -c '*' -s integrate.step="$2" --until "$3" --every-steps 1 "tests/hard/units/$1.yaml" >"$work/out" 2>"$work/err"
    awk -v apart="$4" -v pairs="$5" -v powers="$6" -f tests/hard/derivatives.awk "$work/out" >"$work/differ" &&
        ok "$1: rates and works" || not_ok "$1: rates and works" "columns that are not, by how much" "$work/differ" "$work/err"
}
rates loop s/8192 0.03125 1e-4 43 "external=wind+brake"
rates drive s/8192 0.03125 1e-4 43 "drive=motor external=servo+shake"
rates spatial s/524288 0.0005 5e-3 82 "external=spin"
rates touch s/65536 0.002 1e-3 60 ""
