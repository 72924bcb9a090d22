#!/bin/sh
# hard.sh -- man/fmdsub-hard.7 from the table that `make gallery` prints, without its seconds, which are the machine's.
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
The decks are in
.Pa tests/tools/gallery.sh ;
.Li make gallery
runs them and writes this page.
.Pp
H10 an inertia that no body can have; H11 two pendulums of a mass ratio of 1e8, energy over 10 s; H12 an oscillator of 1e6 rad/s in steps of
1e-3 s, its phase; H15 a free body near its unstable axis, energy; H17, H18, H19 two sliders coupled by stiffness, by mass, and in steps near half a
period, 10:1: largest energy over that at the start; H20 a pendulum from 2 rad over 1e5 steps: energy error of all over that of the first
10 s; H21 free fall in steps of 1e-9 s, and of 1e-17 s; H22 the time of the last record; H34 dampers of -1 and 1e9; H35 a force 1/x that meets 0;
H39 ratios and steps that are none.
.Bd -literal
PAGE
awk '!/^silent/ { sub(/ +[^ ]+$/, ""); print }' "$1"
cat <<'PAGE'
.Ed
.Sh SEE ALSO
.Xr fmdsub 1 ,
.Xr fmdsub-deck 5
PAGE
