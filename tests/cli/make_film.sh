#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
#
# make_film.sh KIND FILE - small synthetic films for the tests of the tool.
#   circle   a soft comet swims in circles over an uneven, desaturated blue: every heading occurs
#   blank    the same screen, nobody there
#   two      two comets of one size
set -eu
kind=$1 file=$2
seconds=${3:-12}
w=160 h=120
# One comet: body and tail are discs whose coverage falls off over two pixels; p is its phase.
disc() { echo "clip(($3-hypot(X-($1),Y-($2)))/2+0.5,0,1)"; }
comet() {  # comet PHASE CX CY R -> coverage
  local p=$1 cx=$2 cy=$3 r=$4
  local head; head=$(disc "$cx+$r*cos($p)" "$cy+$r*sin($p)" 11)
  local neck; neck=$(disc "$cx+$r*cos($p-0.30)" "$cy+$r*sin($p-0.30)" 8)
  local tail; tail=$(disc "$cx+$r*cos($p-0.55)" "$cy+$r*sin($p-0.55)" 4)
  echo "max(max($head,$neck),$tail)"
}
phase="2*PI*T/3"
case $kind in
  circle) a=$(comet "$phase" 80 60 32) ;;
  two) a="max($(comet "$phase" 42 60 18),$(comet "$phase+2" 118 60 18))" ;;
  blank) a=0 ;;
  *) echo "make_film.sh: no film is called $kind" >&2; exit 2 ;;
esac
screen() { echo "$1+6*sin(X/50)+4*cos(Y/40)"; }
ffmpeg -v error -y -f lavfi -i "nullsrc=s=${w}x${h}:r=25:d=$seconds,format=gbrp,geq=\
r='st(0,$a);ld(0)*230+(1-ld(0))*($(screen 70))':\
g='st(0,$a);ld(0)*(150+40*sin(X/9))+(1-ld(0))*($(screen 95))':\
b='st(0,$a);ld(0)*40+(1-ld(0))*($(screen 150))',noise=alls=2:all_seed=7:allf=t" \
  -threads 1 -c:v libx264 -preset ultrafast -crf 14 -pix_fmt yuv420p "$file"
