#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# `mpirun vsprite`: the same bytes for any number of processes; a fault anywhere ends all.
. "$(dirname "$0")/lib.sh"
[ "$2" = with ] || { echo "SKIPPED: built without VSPRITE_MPI"; exit 77; }
command -v mpirun >/dev/null || { echo "SKIPPED: mpirun is missing"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
run="mpirun --oversubscribe"
spread() { local count=$1; shift; $run -n "$count" "$BIN/vsprite" "$@"; }
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

for options in "" "--directions 32" "--directions 16 --solver iterate"; do
  expect 0 vsprite solve --work c.work $options
  good=$(sum c.work/values.bin)
  for count in 1 2 3; do
    rm c.work/values.bin
    expect 0 spread $count solve --work c.work $options
    [ "$(grep -c '^  solve ' stdout)" = 1 ] || fail "one line of one process is due"
    [ "$(sum c.work/values.bin)" = "$good" ] || fail "solve $options: $count give other bytes"
  done
done
rm -r c.work c.vsp
expect 0 spread 3 build c.mp4 -o c.vsp --max-size 64 --mirror
[ "$(grep -c 'c.mp4 -> c.vsp' stdout)" = 1 ] || fail "one process speaks"
[ "$(sum c.vsp)" = "$pack" ] || fail "build gives another pack"

# A fault of the first process, of a setting, and of another process; one that is killed.
expect 66 spread 2 transitions --work nowhere
says "no film has been segmented here"; one_sentence
expect 2 spread 3 solve --work c.work --directions 32 --free-steps 10
says "with 32 directions at most 6"; one_sentence
rm c.work/transitions.bin
expect 66 $run -n 1 "$BIN/vsprite" transitions --work c.work : -n 1 "$BIN/vsprite" transitions --work nowhere
says "nowhere: no film has been segmented here"; one_sentence
build="build c.mp4 -o c.vsp --max-size 64 --mirror"
$run -n 1 "$BIN/vsprite" $build --force all : \
  -n 1 sh -c 'echo $$ >victim; exec "$@"' sh "$BIN/vsprite" $build --force all >stdout 2>stderr &
all=$!
for _ in $(seq 500); do [ -e c.work/keyed/origin ] && break; sleep 0.02; done
kill -KILL "$(cat victim)" || fail "there is no process to kill"
wait $all
[ $? != 0 ] || fail "a killed process goes unnoticed"
expect 0 spread 2 $build
[ "$(sum c.vsp)" = "$pack" ] || fail "another pack after a process was killed"
finish
