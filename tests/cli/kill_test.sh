#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Killed VSPRITE_KILLS times, at random writes, syncs, renames and removals: a plain rerun ends in the
# same bytes and leaves nothing behind.
. "$(dirname "$0")/lib.sh"
if ! command -v strace >/dev/null; then echo "SKIPPED: strace is missing"; exit 77; fi
"$BIN/make_film" circle c.mp4 90 || fail make_film
kills=${VSPRITE_KILLS:-20}
RANDOM=${VSPRITE_SEED:-1}

expect 0 vsprite build c.mp4 -o c.vsp
good=$(sum c.vsp); rm -rf c.vsp c.work
# How often each call is made by the process itself; its decoder children write frames only.
strace -qq -o calls "$BIN/vsprite" build c.mp4 -o c.vsp >/dev/null 2>&1; rm -rf c.vsp c.work
most() { local n; n=$(grep -c "^$1(" calls); echo $((n > 0 ? n : 1)); }

struck=0
runs=0
# A run may end before its call comes, because several threads share the calls: it does not count.
while [ $struck -lt "$kills" ] && [ $runs -lt $((2 * kills)) ]; do
  runs=$((runs + 1))
  calls_of=(write fsync rename fsync rename unlink mkdir)
  call=${calls_of[RANDOM % ${#calls_of[@]}]}
  at=$((RANDOM % ($(most $call) / 2 + 1) + 1))
  rm -rf c.vsp c.work
  { strace -f -qq -o /dev/null -e inject=$call:signal=KILL:when=$at "$BIN/vsprite" build c.mp4 -o c.vsp; } >/dev/null 2>&1
  [ $? = 137 ] && struck=$((struck + 1))
  expect 0 vsprite build c.mp4 -o c.vsp
  [ "$(sum c.vsp)" = "$good" ] || fail "killed at $call $at: the rerun's pack differs"
  no_temporaries
done
echo "$struck of $runs runs were killed on their way"
[ "$struck" = "$kills" ] || fail "only $struck of $kills kills struck in $runs runs"
finish
