# L01: with LONG=1, a million steps that nothing drives: how far the energy drifts, over how far it swings; chain, top, airscrew.
drift='NR > 1 { n++; t[n] = $1; x[n] = $2; st += $1; sx += $2; stt += $1 * $1; stx += $1 * $2 }
    END { b = (n * stx - st * sx) / (n * stt - st * st); a = (sx - b * st) / n; for (i = 1; i <= n; i++) { r = x[i] - a - b * t[i]; s += r * r }
        printf "%.3g", (n > 900 ? abs(b * (t[n] - t[1])) / (sqrt(s / n) + 1e-12) : 9e9) }'
if [ -n "${LONG:-}" ]; then
    # With W at the start of steps (symmetric: false) the chain's drifts by 0.09 J of 79 J in these 200 s.
    row subcycle 1 "$drift" --until 200 --columns energy.residual --every 0.2 --set integrate.symmetric=true <"$ROOT/decks/stiff-leaf-chain.yaml"
    row midpoint 1 "$drift" --until 200 --columns energy.residual --every 0.2 --set integrate.newton_tolerance=1.0e-13 <"$ROOT/decks/stiff-leaf-chain.yaml"
    row midpoint 1 "$drift" --until 1000 --columns energy.residual --every 1 <"$ROOT/decks/free-top.yaml"
    row newmark 1 "$drift" --until 1000 --columns energy.residual --every 1 <"$ROOT/decks/free-top.yaml"
    cp -r "$ROOT/decks/airscrew" .
    cd airscrew
    for symmetric in false true; do
        sed '/^forces:/,/^partition/{/^partition/!d}' airscrew.yaml >free.yaml
        row subcycle 1 "$drift" --until 20 --columns energy.residual --every 0.02 --set initial.shaft.angle_rate=100 --set integrate.symmetric=$symmetric <free.yaml
    done
    cd ..
fi
