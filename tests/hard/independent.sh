# independent.sh -- coordinates of loops that the deck names stay independent, and no others for their sake.
. tests/tools/lib.sh

# chosen NAME WANTED CHOICE DECK: what is said of CHOICE is WANTED.
chosen() {
    "$FMDSUB" check --no-trial -f json -s "partition.independent=$3" "$4" 2>"$work/err" | tr -d '\n\t ' |
        sed -n 's/.*"independent":\[\([^]]*\)\].*/\1/p' | tr -d '"' | tr , '\n' | sort >"$work/is"
    echo "$2" | tr ' ' '\n' | sort >"$work/wanted"
    same "$1" "$work/wanted" "$work/is"
}
modes() { for k in "$@"; do echo "rod.mode$k"; done; }

# A motor, an elbow and eleven modes of which one follows: the first, unless it is named.
crank=decks/flexible-crank.yaml
chosen "by itself" "$(modes 1 2 3 4 5 6 7 8 9 10 11)" "[rod.mode1]" $crank
chosen "an elbow: the first mode follows" "elbow.angle $(modes 2 3 4 5 6 7 8 9 10 11)" "[elbow]" $crank
chosen "an elbow and the first mode: the second follows" "elbow.angle $(modes 1 3 4 5 6 7 8 9 10 11)" "[elbow, rod.mode1]" $crank
chosen "an elbow and the first two: the third follows" "elbow.angle $(modes 1 2 4 5 6 7 8 9 10 11)" "[elbow.angle, rod.mode1, rod.mode2]" $crank
chosen "an elbow and the last: the first follows" "elbow.angle $(modes 2 3 4 5 6 7 8 9 10 11)" "[elbow, rod.mode11]" $crank
chosen "all of a body" "$(modes 1 2 3 4 5 6 7 8 9 10 11)" "[rod]" $crank

# A loop of rigid bodies: one coordinate of three, whichever is named.
for joint in shaft pivot elbow; do chosen "four-bar: $joint" "$joint.angle" "[$joint]" decks/four-bar.yaml; done
