#!/bin/sh
# blade.sh -- makes blade.json, one blade of the airscrew as a reduced body.
#
# usage: sh blade.sh FOLDER      works in FOLDER, which is made; needs gmsh, ccx (Debian: gmsh, calculix-ccx) and
#                                fmdsub-reduce in PATH
#
# The screw turns about z, the blade lies along x from the hub, 0.05 m, to the tip, 0.45 m.  s = 0 ... 1 along it:
#
#     chord       0.090 (1 - 0.45 s) m             thickness at mid-chord  0.016 (1 - 0.6 s) m
#     pitch       50 - 35 s degrees about x, from the plane of rotation
#     section     thickness t (1 - 0.75 c^2), c = -1 ... 1 across the chord
#     aluminium   70 GPa, 0.3, 2780 kg/m3
set -eu
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
cd "$1"

calculix() {
    ccx -i "$1" >"$1.log" 2>&1 || true
    grep -q 'Job finished' "$1.log" || { echo "blade.sh: CalculiX failed, see $1.log" >&2; exit 1; }
}

gmsh -3 "$here/box.geo" -o box.inp -format inp >gmsh.log
awk 'BEGIN { FS = "[ ,]+"; pi = atan2(0, -1) }
    /^\*ELEMENT, type=CPS8/ { skip = 1; next }
    /^\*/ { skip = 0; node = /^\*NODE/; sub(/type=C3D20,/, "type=C3D20R,"); print; next }
    skip { next }
    node {
        s = $2; c = $3; d = $4
        y = c * 0.045 * (1 - 0.45 * s)
        z = d * 0.008 * (1 - 0.6 * s) * (1 - 0.75 * c * c)
        a = (50 - 35 * s) * pi / 180
        printf "%d, %.10g, %.10g, %.10g\n", $1, 0.05 + 0.4 * s, y * cos(a) - z * sin(a), y * sin(a) + z * cos(a)
        next
    }
    { print }' box.inp >blade.inp

head='*INCLUDE,INPUT=blade.inp
*MATERIAL,NAME=aluminium
*ELASTIC
7e10,0.3
*DENSITY
2780
*SOLID SECTION,ELSET=blade,MATERIAL=aluminium'
clamp='*BOUNDARY
root,1,3'
store='*FREQUENCY,SOLVER=MATRIXSTORAGE
*END STEP'

printf '%s\n' "$head" '*STEP' "$store" >free.inp
calculix free
for end in sti mas dof; do cp "free.$end" "blade.$end"; done

# What CalculiX itself finds: frequencies at rest, stress at 8000 rpm (837.758 rad/s), linear and not, frequencies there,
# without and with Coriolis forces (enough modes for those of stretch, which they couple with bending).
load='*DLOAD
blade,CENTRIF,701838.5,0.,0.,0.,0.,0.,1.'
spin="*STEP
*STATIC
$load"
printf '%s\n' "$head" "$clamp" '*STEP' '*FREQUENCY' 8 '*END STEP' >rest.inp
calculix rest
printf '%s\n' "$head" "$clamp" "$spin" '*NODE FILE' U '*EL FILE' S '*END STEP' >spin.inp
calculix spin
printf '%s\n' "$head" "$clamp" "$spin" '*END STEP' '*STEP,PERTURBATION' '*FREQUENCY' 8 '*END STEP' >spun.inp
calculix spun
printf '%s\n' "$head" "$clamp" '*STEP,NLGEOM' '*STATIC' "$load" '*NODE FILE' U '*EL FILE' S '*END STEP' >large.inp
calculix large
printf '%s\n' "$head" "$clamp" "$spin" '*END STEP' '*STEP,PERTURBATION' '*FREQUENCY,STORAGE=YES' 60 '*END STEP' \
    '*STEP,PERTURBATION' '*COMPLEX FREQUENCY,CORIOLIS' 60 "$load" '*END STEP' >coriolis.inp
calculix coriolis

# Points at the root, at mid-chord: nodes of the box at c = 0, d = 1 and -1.
node() { awk -v c="$1" -v d="$2" 'BEGIN { FS = "[ ,]+" } /^\*/ { node = /^\*NODE/ } node && $2 == 0 && ($3 - c)^2 < 1e-9 && ($4 - d)^2 < 1e-9 { print $1; exit }' box.inp; }
front=$(node 0 1) back=$(node 0 -1)

fmdsub-reduce -i root=root@0.05,0,0 -i tip=tip@0.45,0,0:average -n 8 --load-mode spin-zz --load-mode accel-x \
    --material 7e10,0.3 --stress front="$front" --stress back="$back" --stiffening -o blade.json blade
