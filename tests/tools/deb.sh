# deb.sh -- the package, built once more from the tarball in a folder of another name: the same bytes; and what lintian says.
. tests/tools/lib.sh
first=$(ls "$BUILD"/fmdsub_*.deb | head -n 1)
mkdir "$work/elsewhere"
tar -xzf "$BUILD"/fmdsub-*.tar.gz -C "$work/elsewhere"
epoch=$(git log -1 --format=%ct)
(cd "$work"/elsewhere/fmdsub-* && SOURCE_DATE_EPOCH=$epoch CC="${CC:-gcc}" BUILD=build .ci/deb "$work/made") >"$work/second" 2>"$work/err"
expect "a second build" 0 $? "$work/err"
sha256sum "$first" "$(cat "$work/second")" | awk '{ print $1 }'
same "the same bytes" "$first" "$(cat "$work/second")"
if command -v lintian >/dev/null; then
    lintian --fail-on error,warning "$first" >"$work/lintian" 2>"$work/err"
    expect "lintian" "0 0" "$? $(wc -l <"$work/lintian")" "$work/lintian"
else
    skip "lintian" "it is not installed"
fi
