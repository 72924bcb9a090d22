#!/bin/sh
# hard.sh TABLE CASE... -- man/fmdsub-hard.7 from the table that `make hard-table` prints, without its seconds, which are the
# machine's, and what the first line of each case says of it.
table=$1
shift
cat <<'PAGE'
.Dd November 22, 2026
.Dt FMDSUB-HARD 7
.Os
.Sh NAME
.Nm fmdsub-hard
.Nd hard cases, scheme by scheme
.Sh DESCRIPTION
Cases that break simulators, each judged by a number:
.Li right
where the run ends and the figure is within its limit,
.Li told
where it stopped, or ended with a status and a reason,
.Li silent
where a wrong number came without a word.
Schemes stand side by side where they apply.
Where the limit says
.Li told
the case must be told, where it says
.Li or-told
it may.
Scheme
.Li deck
stands where a deck is refused while it is read or put together, before any scheme begins, and so by none in particular.
The cases are in
.Pa tests/gallery ;
.Li make hard-table
runs them and writes this page.
.Bl -tag -width H01
PAGE
head -qn 1 "$@" | sed -n 's/^# \([HCL][0-9]*\): /\1 /p' | while read -r case_ words; do printf '.It %s\n%s\n' "$case_" "$words" | sed 's/\\/\\e/g'; done
cat <<'PAGE'
.El
.Bd -literal
PAGE
awk '!/^[0-9]/ { sub(/ +[^ ]+$/, ""); print }' "$table"
cat <<'PAGE'
.Ed
.Sh SEE ALSO
.Xr fmdsub 1 ,
.Xr fmdsub-deck 5
PAGE
