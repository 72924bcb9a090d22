# examples.awk -- the literal blocks of a manual page (mdoc) as files to try.
#
#     awk -v out=FOLDER/NAME -f examples.awk PAGE
#
# A block between .Bd -literal and .Ed whose first line starts with `$ ` is a session: FOLDER/NAME.K.sh.
# One whose first line is `fmdsub: 1` is a deck: FOLDER/NAME.K.yaml.  A comment line before the block
# changes what is expected:  .\" exit 3   or   .\" not run: REASON
function plain(s) {
    gsub(/\\e/, "\001", s); gsub(/\\-/, "-", s); gsub(/\\&/, "", s)
    gsub(/\\\(aq/, "'", s); gsub(/\\\(dq/, "\"", s); gsub(/\\\(ti/, "~", s); gsub(/\\\(ha/, "^", s); gsub(/\\\(ga/, "`", s)
    gsub(/\001/, "\\", s)
    return s
}
/^\.\\" exit [0-9]+/  { status = $3; next }
/^\.\\" not run:/     { dropped = 1; next }
/^\.Bd .*-literal/    { inside = 1; first = 1; file = ""; next }
/^\.Ed/               { if (file) close(file); inside = 0; status = 0; dropped = 0; next }
inside {
    line = plain($0)
    if (first && !dropped) {
        if (line ~ /^\$ /) file = out "." ++count ".sh"
        else if (line ~ /^fmdsub: 1/) file = out "." ++count ".yaml"
        if (file) print status + 0 > (file ".status")
        if (file) close(file ".status")
    }
    first = 0
    if (file) print line > file
}
