#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# The screen's colour and the four sliders in a real window on a virtual display, with real mouse and
# key events: the command line that the window shows cuts out what the window showed, byte by byte.
# VSPRITE_SHOT=FILE.png: the screen; of the film VSPRITE_FILM instead of a drawn one, where given.
shot=${VSPRITE_SHOT:+$(realpath "$VSPRITE_SHOT")}
film=${VSPRITE_FILM:+$(realpath "$VSPRITE_FILM")}
. "$(dirname "$0")/window.sh"
"$BIN/make_film" circle ring.mp4 100 || fail "make_film"

# start FILM OPTION... : a window that shows the film keyed
start() { open_window log segment "$@" --window; sleep 1.5; }
# saved: after the key S, what the window says of the cut-out that it saved; in `picture` its file,
# in `command` the command line.
saved() {
  local before; before=$(grep -c 'saved: ' log.err)
  for _ in $(seq 40); do
    xdotool key s
    for _ in $(seq 10); do
      [ "$(grep -c 'saved: ' log.err)" -gt "$before" ] && break 2
      sleep 0.05
    done
  done
  picture=$(sed -n 's/.*saved: \([^;]*\);.*/\1/p' log.err | tail -1)
  command=$(sed -n 's/.*saved: [^;]*; //p' log.err | tail -1)
  [ -s "$picture" ] || { cp log.err stderr; fail "no cut-out was saved"; finish; }
}
pixels() { ffmpeg -v error -i "$1" -vf "format=rgba${2:+,crop=$2}" -f rawvideo - | sha256sum; }
# repeats WHAT: the command line that was shown cuts the same pixels out of the film.
repeats() {
  local frame=${picture%.png}; frame=${frame##*.}
  rm -rf again.work
  (eval "${command/vsprite/"$BIN/vsprite"} --work again.work --max-size 4096 --force segment") \
    >stdout 2>stderr || { fail "$1: $command"; return; }
  local name left top width height
  IFS=, read -r name left top width height < <(awk -F, -v f="$frame" '
    /^sample,/ { for (i = 1; i <= NF; ++i) at[$i] = i }
    $at["frame"] == f { printf "%06d,%s,%s,%s,%s\n", $1, $at["left"], $at["top"], $at["width"], $at["height"] }
  ' again.work/samples.csv)
  [ -n "$width" ] || { fail "$1: frame $frame is no sample"; return; }
  [ "$(pixels "again.work/sprites/$name.png")" = "$(pixels "$picture" "$width:$height:$left:$top:exact=1")" ] ||
    fail "$1: the window showed other pixels than $command makes"
}

if [ -n "$shot" ] && [ -n "$film" ]; then
  start "$film"; sleep 4
  press 3 Down Down Down Down 1 Up Up Up Up Up; sleep 2
  ffmpeg -v error -y -f x11grab -i "$DISPLAY" -frames:v 1 "$shot"
  press Escape; wait $window; finish
fi

start ring.mp4
saved; repeats "as measured"
[ "$command" = "vsprite segment ring.mp4" ] || fail "untouched: $command"
plain=$(pixels "$picture")
press 1 Up Up Up Up Up 2 Down Down Down Down 3 Down Down Down Down Down 4 Up Up
saved; repeats "four sliders by keys"
[ "$command" = "vsprite segment ring.mp4 --clip-black 0.05 --clip-white 0.96 --edge -1.25 --despill 1.1" ] ||
  fail "four sliders: $command"
[ "$(pixels "$picture")" != "$plain" ] || fail "four sliders changed nothing"
# The other setting is as it was, at once and after a copy.
press Tab; saved
[ "$command" = "vsprite segment ring.mp4" ] || fail "B: $command"
[ "$(pixels "$picture")" = "$plain" ] || fail "B is not as measured"
press Tab x Tab; saved
[ "${command%despill*}" != "$command" ] || fail "a copy: $command"
press r; saved
[ "$command" = "vsprite segment ring.mp4" ] || fail "as measured: $command"
# The eyedropper, another frame, and a slider by mouse.
press e; click 60 60
saved; repeats "the eyedropper"
[[ "$command" == "vsprite segment ring.mp4 --key '#"* ]] || fail "the eyedropper: $command"
before=$picture
press Right; saved
[ "$picture" != "$before" ] || fail "Right shows no other frame"
click 300 728; saved; repeats "scrubbed"
[ "$picture" != "$before" ] || fail "the time line shows no other frame"
click 1000 236; saved; repeats "a slider by mouse"
[[ "$command" == *"--clip-"* ]] || fail "a slider by mouse: $command"
press u; saved
[[ "$command" != *"--key"* ]] || fail "auto: $command"
if [ -n "$shot" ]; then ffmpeg -v error -y -f x11grab -i "$DISPLAY" -frames:v 1 "$shot"; fi
# Escape says the command line; Enter runs it.
press Escape
wait $window || { cp log.err stderr; fail "the window did not end well"; }
grep -qxF "$command" log.out || fail "the command line is not printed: $(cat log.out)"
[ -e ring.work ] && fail "a window made a work folder"
start ring.mp4 --edge 0.5 --max-size 64
press 3 Up; saved
[ "$command" = "vsprite segment ring.mp4 --edge 0.75 --max-size 64" ] || fail "given settings: $command"
press Return
wait $window || { cp log.err stderr; fail "Enter did not cut the film"; }
grep -q '"edge": 0.75' ring.work/manifest.json || fail "the film was cut with other settings"

# Of a film that does not fit in memory too: any frame, from the key frame before it.
ffmpeg -v error -stream_loop 1 -i ring.mp4 -vf scale=1920:1080:flags=neighbor -c:v libx264 -preset ultrafast \
  -pix_fmt yuv420p -g 50 large.mp4 || fail "no large film"
start large.mp4
saved; first=${picture%.png}; first=${first##*.}
for step in 1 2 3 4; do
  press Right; saved
  [ "$picture" = "large.$((first + step)).png" ] || fail "step $step from $first shows $picture"
done
repeats "a frame that was fetched"
press Escape
wait $window || fail "the window of a large film did not end well"

# Without a person.
expect 0 vsprite segment ring.mp4 --window --headless --record shot.png --json --despill 0
is_json /film /command
prints "vsprite segment ring.mp4 --despill 0.0"
[ "$(file -b shot.png | cut -d, -f2)" = " 1280 x 760" ] || fail "no picture of the window"
expect 2 vsprite segment ring.mp4 --window --edge 9; one_sentence
expect 2 vsprite segment ring.mp4 --window --headless --clip-black 0.6 --clip-white 0.5; one_sentence
printf 'not a film' >bad.mp4
expect 3 vsprite segment bad.mp4 --window --headless; one_sentence
expect 66 vsprite segment absent.mp4 --window; one_sentence
DISPLAY= expect 1 env -u DISPLAY -u WAYLAND_DISPLAY "$BIN/vsprite" segment ring.mp4 --window
says "no display"
finish
