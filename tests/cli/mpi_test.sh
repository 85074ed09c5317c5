#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# `mpirun vsprite transitions`: the same bytes for 1, 2, 3 and 4 processes.
. "$(dirname "$0")/lib.sh"
[ "$2" = with ] || { echo "SKIPPED: built without VSPRITE_MPI"; exit 77; }
command -v mpirun >/dev/null || { echo "SKIPPED: mpirun is missing"; exit 77; }
spread() {
  local count=$1; shift
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    mpirun --oversubscribe -n "$count" "$BIN/vsprite" "$@"
}
# 1,800 samples are four tiles.
"$BIN/make_film" circle c.mp4 900 || fail make_film
expect 0 vsprite build c.mp4 -o c.vsp --max-size 64 --mirror
good=$(sum c.work/transitions.bin); pack=$(sum c.vsp)
for count in 1 2 3 4; do
  rm c.work/transitions.bin
  expect 0 spread $count transitions --work c.work
  prints "pairs"
  [ "$(sum c.work/transitions.bin)" = "$good" ] || fail "$count processes give other bytes"
done
expect 0 spread 3 transitions --work c.work
prints "as is"
expect 0 vsprite build c.mp4 -o c.vsp --max-size 64 --mirror
[ "$(sum c.vsp)" = "$pack" ] || fail "another pack"
expect 66 spread 2 transitions --work nowhere
says "no film has been segmented here"
finish
