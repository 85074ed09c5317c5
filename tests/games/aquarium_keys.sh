#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# aquarium_keys.sh AQUARIUM PACK: a real window on a virtual display, real key events: an arrow key
# starts the round, Escape ends the program. 77: xvfb or xdotool is missing.
command -v xvfb-run >/dev/null && command -v xdotool >/dev/null || { echo "skipped: xvfb or xdotool is missing"; exit 77; }
if [ -z "$AQUARIUM_DISPLAY" ]; then
  AQUARIUM_DISPLAY=1 exec xvfb-run -a -s "-noreset -screen 0 320x180x24" bash "$0" "$@"
fi
log=$(mktemp)
XDG_DATA_HOME=/proc/nowhere SDL_AUDIODRIVER=dummy "$1" "$2" --size 320x180 --frames 9000 >"$log" 2>&1 &
game=$!
for _ in $(seq 100); do
  xdotool search --name '^aquarium$' >/dev/null 2>&1 && break
  sleep 0.2
done
# The window is there before its first frame: press until the program has had time to see it.
for _ in $(seq 20); do
  xdotool keydown Right
  sleep 0.3
  xdotool keyup Right
done
xdotool key Escape
wait $game
code=$?
cat "$log"
[ $code -eq 0 ] && grep -q ' playing, ' "$log"
result=$?
rm -f "$log"
exit $result
