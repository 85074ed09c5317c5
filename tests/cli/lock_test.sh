#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# One writer at a time; a full disk costs nothing that earlier stages made.
. "$(dirname "$0")/lib.sh"
"$BIN/make_film" circle c.mp4 150 || fail make_film
if ! command -v strace >/dev/null; then echo "SKIPPED: strace is missing"; exit 77; fi

# The first process stands still at its first sync for three seconds.
strace -f -qq -o /dev/null -e inject=fsync:delay_enter=3000000:when=1 "$BIN/vsprite" build c.mp4 -o c.vsp >/dev/null 2>first &
slow=$!
for _ in $(seq 100); do [ -e c.work/lock ] && break; sleep 0.05; done
sleep 0.2
expect 75 vsprite train --work c.work
says "is in use by process"; one_sentence
wait $slow || fail "the first process failed"
expect 0 vsprite build c.mp4 -o c.vsp
good=$(sum c.vsp)

# No space left, at each kind of call.
for point in write:2 write:3 fsync:1 rename:1 fsync:2; do
  rm -f c.work/values.bin
  before=$(sum c.work/transitions.bin)
  expect 74 strace -f -qq -o /dev/null -e inject=${point%:*}:error=ENOSPC:when=${point#*:} "$BIN/vsprite" solve --work c.work --progress none
  says "No space left on device"
  [ "$(sum c.work/transitions.bin)" = "$before" ] || fail "an earlier stage's file has changed"
done
expect 0 vsprite build c.mp4 -o c.vsp
[ "$(sum c.vsp)" = "$good" ] || fail "after a full disk the pack differs"
no_temporaries
finish
