# pages.sh -- BUILD/pages/index.html: every shipped deck with a still, the lines that say what it shows, and what it costs.
#
# Pictures are files beside the page, which a browser reads when they come into sight.  Costs are counts: evaluations of all
# bodies, steps; and the balance of energy.  A deck whose motion is not drawn in a minute is named without a picture.
. tests/tools/lib.sh
to=$BUILD/pages
rm -rf "$to"
mkdir -p "$to"

html() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
fact() { awk -v name="$1" '$1 == name { print $2 }' "$work/stats"; }

{
    cat <<'HTML'
<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Decks of fmdsub</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 82rem; padding: 0 1rem; color: #222; background: #fafafa }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(19rem, 1fr)); gap: 1.2rem }
figure { margin: 0; background: #fff; border: 1px solid #ddd; border-radius: 6px; overflow: hidden; display: flex; flex-direction: column }
img { display: block; width: 100%; height: auto; aspect-ratio: 8/5; object-fit: contain; background: #fff }
figcaption { padding: .7rem .9rem; border-top: 1px solid #eee } h2 { font-size: 1rem; margin: 0 } p { margin: .3rem 0 }
.cost { color: #666; font-size: .85rem } .none { aspect-ratio: 8/5; display: grid; place-items: center; color: #999 }
</style></head><body><h1>Decks of fmdsub</h1>
<p>Each with five of its postures, the last one whole, those before paler; what it shows; and what its run takes, in counts
that are the same on every machine.</p>
<main>
HTML
    for deck in decks/*.yaml; do
        name=${deck##*/}
        name=${name%.yaml}
        timeout 60 "$FMDSUB" run -q --stats="$work/stats" "$deck" >"$work/run.csv" 2>"$work/err" </dev/null || { echo "pages: $name does not run" >&2; echo "$name" >>"$work/failed"; continue; }
        echo "<figure>"
        if timeout 60 "$FMDSUB" animate -q -o "$to/$name.svg" "$deck" 2>"$work/err" </dev/null; then
            printf '<img alt="" loading="lazy" width="800" height="500" src="%s.svg">\n' "$name"
        else echo '<div class="none">no picture</div>'; fi
        sentence=$(awk '/^#/ { sub(/^# ?/, ""); printf "%s ", $0; next } { exit }' "$deck" | html)
        [ -n "$sentence" ] || { echo "pages: $name says nothing of itself" >&2; echo "$name" >>"$work/failed"; }
        echo "<figcaption><h2>$(sed -n 's/^title: *//p' "$deck" | head -n 1 | tr -d '"' | html)</h2>"
        echo "<p>$sentence</p>"
        echo "<p class=\"cost\"><code>$deck</code>: $(fact major_steps) major and $(fact minor_steps) minor steps, $(fact slow_evaluations) slow and $(fact fast_evaluations) fast evaluations, energy off by $(fact energy_share | awk '{ printf "%.0e", $1 }') of what was exchanged</p></figcaption></figure>"
    done
    echo "</main></body></html>"
} >"$to/index.html"
[ ! -s "$work/failed" ] && echo "pages: $(grep -c '^<figure>' "$to/index.html") decks, $(grep -c '^<img' "$to/index.html") pictures, $(du -sk "$to" | cut -f 1) kB, $to/index.html"
