#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Points placed in a real window on a virtual display, with real mouse and key events; the process
# killed while it saves. VSPRITE_SHOT=FILE.png: the screen in the middle of a drag.
shot=${VSPRITE_SHOT:+$(realpath "$VSPRITE_SHOT")}
. "$(dirname "$0")/window.sh"
expect 0 "$BIN/draw_puppets" art
cd art || exit 1

start() { open_window "$room/log" points face.toml --window; sleep 1.5; }
# points VIEW: how many stand in the file for it.
row() { grep '^points' -A40 face.toml | awk -v n="$1" '/^points/ { k++ } k == n' ; }
points() { awk -v n="$1" '/^\[\[view\]\]/ { k++ } k == n' face.toml | grep -o '\[[-0-9.]*, [-0-9.]*\]' | wc -l; }
saved() {  # saved N WHAT: after the key S every view has so many points
  press s
  for _ in $(seq 60); do
    [ "$(points 1)" = "$1" ] && [ "$(points 5)" = "$1" ] && return
    sleep 0.05
  done
  fail "$2: $(points 1) and $(points 5) points where $1 are due"
}

n=$(points 1)
first=$(cat face.toml)
start
click 330 370                      # somewhere in the face: a point more, in every view
saved $((n + 1)) "a click"
added=$(cat face.toml)
at 330 370; xdotool mousedown 1; sleep 0.2
for x in 336 344 352 360; do at $x 362; done
if [ -n "$shot" ]; then sleep 1; ffmpeg -v error -y -f x11grab -i "$DISPLAY" -frames:v 1 "$shot"; fi
xdotool mouseup 1; sleep 0.2
saved $((n + 1)) "a drag"
moved=$(cat face.toml)
[ "$moved" != "$added" ] || fail "a drag moved nothing"
[ "$(diff <(echo "$moved") <(echo "$added") | grep -c '^<')" -le 4 ] ||
  fail "a drag in one view changed others"
press u; saved $((n + 1)) "undo"
[ "$(cat face.toml)" = "$added" ] || fail "one undo did not take the drag back"
press ctrl+y; saved $((n + 1)) "redo"
[ "$(cat face.toml)" = "$moved" ] || fail "redo did nothing"
click 360 362 3                    # a right click on it
saved $n "a right click"
press ctrl+z; press ctrl+z; press ctrl+z; saved $n "undo to the start"
[ "$(cat face.toml)" = "$first" ] || fail "undone to the start it is not the file it was"
press Escape
wait $window || { cp "$room/log.err" "$room/stderr"; fail "the window did not end well"; }
expect 0 vsprite fit face.toml -o face.vsp

# Not saved: asked once, then kept aside.
start
click 330 370
press Escape
kill -0 $window 2>/dev/null || fail "unsaved points were given up at the first Escape"
press Escape
wait $window || fail "it did not end"
[ "$(cat face.toml)" = "$first" ] || fail "points were saved unasked"
[ -s face.toml.unsaved ] || fail "what was not saved is gone"

# Killed at any moment the file is one of the two states, whole.
for run in 1 2 3 4; do
  start
  click 330 370
  xdotool key s &
  sleep 0.0$((run * 2))
  kill -9 $window; wait $window 2>/dev/null; wait
  expect 0 vsprite fit face.toml -o face.vsp
  [ "$(points 1)" = "$n" ] || [ "$(points 1)" = $((n + 1)) ] || fail "half a file after kill -9"
  printf '%s\n' "$first" >face.toml
done
finish
