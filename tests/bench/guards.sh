# guards.sh -- what the guards cost that watch every run, in instructions by callgrind, counted apart: the first sign of a lost
# balance, dead points, turns in a step, spins, tilts, idle turns, inertias, deflections, ends that meet.  Beside them the energies
# and their balance, which records ask for, too.
#
#     BUILD=build sh tests/bench/guards.sh
#
# Ends with 1 where the guards take more than 2 percent of the stepping.
. tests/tools/lib.sh
guards='guard_look rotations_note spins_note tilts_note idle_note inertias_note deflections_note passes_check factor_ratio factor_weakest'
balance='system_energy_at ledger_look ledger_add system_note_closure'
for deck in chain double-pendulum four-bar andrews bar-slider flexible-crank heavy-top free-top stiff-leaf-chain windows suspension; do
    valgrind --tool=callgrind --callgrind-out-file="$work/out" "$FMDSUB" run -q -o "$work/records" decks/$deck.yaml >/dev/null 2>&1
    callgrind_annotate --inclusive=yes --threshold=100 "$work/out" 2>/dev/null |
        awk -v deck=$deck -v guards="$guards" -v balance="$balance" '
            BEGIN { n = split(guards, g, " "); m = split(balance, b, " ") }
            match($0, /:[a-z_]+ /) { name = substr($0, RSTART + 1, RLENGTH - 2); x = $1; gsub(",", "", x); if (!(name in c)) c[name] = x }
            END { for (i = 1; i <= n; i++) guard += c[g[i]]; for (i = 1; i <= m; i++) energy += c[b[i]]
                  all = c["steps_take"]
                  if (!all) { print deck ": not counted"; exit 1 }
                  printf "%-18s %12d instructions of stepping, guards %.2f %%, energies and balance %.2f %%\n", deck, all, 100 * guard / all, 100 * energy / all
                  exit guard > .02 * all }' || bad=1
done
exit ${bad:-0}
