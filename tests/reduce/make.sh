#!/bin/sh
# make.sh -- remakes the data of this folder: needs gmsh and ccx (Debian: gmsh, calculix-ccx) and fmdsub-reduce.
#
# usage: sh make.sh FMDSUB_REDUCE       in a copy of this folder; leaves the files named in README
set -eu
reduce=$1
calculix() { ccx -i "$1" >"$1.log" 2>&1 && grep -q 'Job finished' "$1.log"; }

gmsh -3 bar.geo -o raw.inp -format inp >/dev/null
# The volume's elements only; places that are zero but for round-off.
awk '/^\*ELEMENT, type=CPS8/ { skip = 1; next } /^\*/ { skip = 0 } !skip' raw.inp |
    sed 's/type=C3D20,/type=C3D20R,/; s/-*[0-9.]*e-1[0-9]\b/0/' >bar.inp

material='*INCLUDE,INPUT=bar.inp
*MATERIAL,NAME=aluminium
*ELASTIC
7e10,0.3
*DENSITY
2780
*SOLID SECTION,ELSET=bar,MATERIAL=aluminium'
clamp='*BOUNDARY
root,1,3'
store='*FREQUENCY,SOLVER=MATRIXSTORAGE
*END STEP'

printf '%s\n' "$material" '*STEP' "$store" >free.inp
calculix free
cp free.sti bar.sti
cp free.dof bar.dof
awk '$3 != 0' free.mas >bar.mas

printf '%s\n' "$material" "$clamp" '*STEP' '*FREQUENCY' 10 '*END STEP' >clamped.inp
calculix clamped

# 100 N along z, the same on every node of the tip.
force=$(awk '/NSET=tip/ { on = 1; next } /^\*/ { on = 0 } on { n += gsub(/[0-9]+/, "") } END { printf "%.12g", 100 / n }' bar.inp)
printf '%s\n' "$material" "$clamp" '*STEP' '*STATIC' '*CLOAD' "tip,3,$force" '*NODE PRINT,NSET=tip' U \
    '*NODE FILE' U '*EL FILE' S '*END STEP' >static.inp
calculix static

# Spin about z through the root, 100 rad/s: CENTRIF brings its softening.
printf '%s\n' "$material" "$clamp" '*STEP' '*STATIC' '*DLOAD' 'bar,CENTRIF,1.e4,0.,0.,0.,0.,0.,1.' '*END STEP' \
    '*STEP,PERTURBATION' '*FREQUENCY' 10 '*END STEP' >spun.inp
calculix spun

# Prestressed matrices, under the loads that fmdsub-reduce writes.
$reduce -i root=root -i tip=tip --loads load bar 2>loads.txt
for kind in accel-x accel-y accel-z spin-xx spin-yy spin-zz spin-xy spin-xz spin-yz twist-x twist-y twist-z force-x-tip force-y-tip force-z-tip; do
    printf '%s\n' "$material" "$clamp" '*STEP' '*STATIC' "*INCLUDE,INPUT=load-$kind.inp" '*END STEP' \
        '*STEP,PERTURBATION' "$store" >"bar-$kind.inp"
    calculix "bar-$kind"
    rm "bar-$kind.mas"
done
