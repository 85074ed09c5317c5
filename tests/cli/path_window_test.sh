#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A path drawn in a real window on a virtual display, with real mouse and key events.
# VSPRITE_SHOT=FILE.png: the screen, with the path drawn and the sprite on it.
shot=${VSPRITE_SHOT:+$(realpath "$VSPRITE_SHOT")}
. "$(dirname "$0")/window.sh"
"$BIN/make_film" circle ring.mp4 200 || fail "make_film"
expect 0 vsprite build ring.mp4 -o ring.vsp --max-size 64

# A picture of 640 x 480 in the window of 1280 x 760: 912 x 684 of it, 14 and 6 px from the corner.
start() {
  open_window log path ring.vsp --window --script drawn.txt --size 640x480 --beam 2000 "$@"
  sleep 1.5
}
points() { grep -vc '^#' drawn.txt; }
saved() {  # saved N WHAT: after the key S the file has so many points
  press s
  for _ in $(seq 40); do [ "$(points 2>/dev/null)" = "$1" ] && return; sleep 0.05; done
  fail "$2: $(points) points where $1 are due"
}

printf '# mine\n' >drawn.txt
start
click 100 100; click 700 100; click 700 600
saved 3 "three clicks"
click 400 100
saved 4 "a click on the line"
[ "$(sed -n 3p drawn.txt | cut -d' ' -f2)" = "$(sed -n 2p drawn.txt | cut -d' ' -f2)" ] ||
  fail "the point is not on the line"
before=$(cat drawn.txt)
at 700 600; xdotool mousedown 1; sleep 0.1
for y in 580 540 500 460; do at 650 $y; done
xdotool mouseup 1; sleep 0.1
saved 4 "a drag"
[ "$(cat drawn.txt)" != "$before" ] || fail "a drag moved nothing"
press u; saved 4 "undo"
[ "$(cat drawn.txt)" = "$before" ] || fail "one undo did not take the drag back"
press r; saved 4 "redo"
[ "$(cat drawn.txt)" != "$before" ] || fail "redo did nothing"
press ctrl+z; press ctrl+z; saved 3 "two undos by Ctrl+Z"
press ctrl+y; saved 4 "Ctrl+Y"
click 400 100 3; saved 3 "a right click on a point"
head -1 drawn.txt | grep -qx '# mine' || fail "the script's comments are gone"
# Scrubbed: the slider lies at the bottom.
click 500 725
if [ -n "$shot" ]; then sleep 2; ffmpeg -v error -y -f x11grab -i "$DISPLAY" -frames:v 1 "$shot"; fi
press Escape
wait $window || { cp log.err stderr; fail "the window did not end well"; }
expect 0 vsprite path ring.vsp --script drawn.txt --beam 2000

# What is not saved is asked about once, and then kept aside.
cp drawn.txt before.txt
start
click 300 400
press Escape
kill -0 $window 2>/dev/null || fail "an unsaved path was given up at the first Escape"
press Escape
wait $window || fail "it did not end"
cmp -s drawn.txt before.txt || fail "a path was saved unasked"
[ "$(grep -vc '^#' drawn.txt.unsaved)" = 4 ] || fail "what was not saved is gone"

# Without a person.
expect 0 vsprite path ring.vsp --window --script drawn.txt --headless --frames 20 --record shot.png --json
is_json /script /points /saved
[ "$(file -b shot.png | cut -d, -f2)" = " 1280 x 760" ] || fail "no picture of the window"
expect 2 vsprite path ring.vsp --window --script scene.toml; says "not scenes"; one_sentence
expect 3 vsprite path ring.vsp --window --script ring.mp4; one_sentence
expect 66 vsprite path absent.vsp --window; one_sentence
DISPLAY= expect 1 env -u DISPLAY -u WAYLAND_DISPLAY "$BIN/vsprite" path ring.vsp --window
says "no display"
finish
