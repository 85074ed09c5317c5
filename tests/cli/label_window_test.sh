#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# label_window_test.sh BIN [WORK]: a real window on a virtual display, real key events, the process
# killed on the way: every answer that the window acknowledged is in the file.
# VSPRITE_LABEL_PAIRS answers (60) by keyboard, VSPRITE_LABEL_KILLS kills (6) spread over them.
given=$(realpath "${2:-/nowhere}")
. "$(dirname "$0")/window.sh"
pairs=${VSPRITE_LABEL_PAIRS:-60} kills=${VSPRITE_LABEL_KILLS:-6}
RANDOM=${VSPRITE_SEED:-1}
if [ -d "$given" ]; then
  cp -r "$given" c.work; rm -f c.work/labels.sqlite
else
  "$BIN/make_film" circle c.mp4 150 || fail make_film
  expect 0 vsprite segment c.mp4 --work c.work --max-size 64
  expect 0 vsprite train --work c.work
fi

kept() { cat log.*.err 2>/dev/null | grep -c 'kept:'; }
start() { open_window "log.$1" label --work c.work --verbose; }  # start NUMBER
answer() {  # answer KEPT KEY: until one more answer is acknowledged
  local before=$1 key=$2
  for _ in $(seq 20); do
    xdotool key "$key"
    for _ in $(seq 100); do
      [ "$(kept)" -gt "$before" ] && return
      sleep 0.01
    done
  done
  cp "log.$run.err" stderr; fail "key $key was not answered"; finish
}

run=0
start $run
sleep 0.5
for ((n = 0; n < pairs; ++n)); do
  answer "$(kept)" "$([ $((RANDOM % 3)) = 0 ] && echo f || echo space)"
  if [ $run -lt $kills ] && [ $n -ge $(((run + 1) * pairs / (kills + 1))) ]; then
    xdotool key space &  # one more is on its way, or not
    sleep 0.00$((RANDOM % 10))
    kill -9 $window
    wait $window 2>/dev/null
    wait
    run=$((run + 1))
    start $run
    sleep 0.5
  fi
done
# Undo and redo, a long way back, then the end.
before=$(vsprite dump --work c.work --what labels -o d.csv >/dev/null 2>&1; grep -c ',1$' d.csv)
for _ in $(seq 5); do xdotool key u; sleep 0.15; done
for _ in $(seq 5); do xdotool key r; sleep 0.15; done
xdotool key Escape
wait $window || { cp "log.$run.err" stderr; fail "the window did not end well"; }

expect 0 vsprite dump --work c.work --what labels -o d.csv
acknowledged=$(kept)
[ "$(grep -c ',1$' d.csv)" = "$before" ] || fail "undo and redo lost an answer"
missing=0
while read -r pair what; do
  value=$([ "$what" = smooth ] && echo 1 || echo 0)
  grep -q "^$pair,$value,1$" d.csv || { missing=$((missing + 1)); echo "lost: $pair $what"; }
done < <(cat log.*.err | sed -n 's/.*kept: //p')
expect 0 vsprite label --work c.work --export e.csv
echo "$pairs keys, $run kills: $acknowledged acknowledged, $(($(wc -l <e.csv) - 1)) in the file, $missing lost"
[ "$acknowledged" -ge "$pairs" ] && [ $missing = 0 ] || fail "an acknowledged answer was lost"
finish
