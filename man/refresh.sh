#!/bin/sh
# refresh.sh -- writes the parts of the manual that come from the program's tables anew:
#
#     BUILD=build sh man/refresh.sh
#
# Such a part stands between `.\" from: fmdsub list page ...` and `.\" end`; BUILD names the folder of the program.
# tests/unit/t-page.c tells when a part is not what the program prints.
cd "$(dirname "$0")/.." || exit 2
PATH=${BUILD:-build}:$PATH
export PATH

for page in man/*.[157]; do
    awk '
        /^\.\\" end$/   { inside = 0 }
        !inside         { print }
        /^\.\\" from: / {
            inside = 1
            command = substr($0, length(".\\\" from: ") + 1)
            while ((command | getline line) > 0) print line
            if (close(command) != 0) { print FILENAME ": failed: " command > "/dev/stderr"; exit 1 }
        }' "$page" >"$page.new" || { rm -f "$page.new"; exit 1; }
    if cmp -s "$page" "$page.new"; then rm -f "$page.new"
    else mv "$page.new" "$page" && echo "refresh: $page"; fi
done
