# reactions.sh -- reactions in the joint's own axes: the same forces, and none along what slides or about what turns.
. tests/tools/lib.sh

run() { # DECK COLUMNS [--set ...]
    run_deck=$1 run_columns=$2
    shift 2
    "$FMDSUB" run -q --until 0.2 --every 0.1 --columns "$run_columns" "$@" "$run_deck" 2>"$work/err" | sed 1d | cut -d , -f 2-
}

# sizes agree to 1e-9 line by line; column WHICH of the second is nothing
agree() { # NAME WHICH FILE FILE
    expect "$1" fine "$(paste -d , "$3" "$4" | awk -F , -v which="$2" '
        { n = NF / 2; a = b = 0
          for (i = 1; i <= n; i++) { a += $i * $i; b += $(n + i) * $(n + i) }
          if (a > most) most = a
          if ((a - b) ^ 2 > 1e-18 * a * a + 1e-24) bad = "sizes " a " and " b
          if ($(n + which) ^ 2 > 1e-18 * a + 1e-24) bad = "not nothing: " $(n + which) }
        END { print !(most > 0) ? "no forces" : bad ? bad : "fine" }')" "$3" "$4" "$work/err"
}

run decks/bar-slider.yaml guide.fx,guide.fy >"$work/world"
run decks/bar-slider.yaml guide.fx,guide.fy -s constraints.guide.frame=joint >"$work/joint"
agree "reactions: a slider in the plane" 1 "$work/world" "$work/joint"
run decks/bricard.yaml pin2.mx,pin2.my,pin2.mz >"$work/world"
run decks/bricard.yaml pin2.mx,pin2.my,pin2.mz -s constraints.pin2.frame=joint >"$work/joint"
agree "reactions: a hinge in space" 3 "$work/world" "$work/joint"
run decks/bricard.yaml pin4.mx,pin4.my,pin4.mz >"$work/world"
run decks/bricard.yaml pin4.mx,pin4.my,pin4.mz -s constraints.pin4.frame=joint >"$work/joint"
agree "reactions: a hinge that closes a loop" 3 "$work/world" "$work/joint"
