# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
#
# What the tests of windows share beside lib.sh: a virtual display of their own, a mouse and keys.
# Sourced. The display outlives its windows: one that starts anew refuses who comes just then.
if ! command -v xvfb-run >/dev/null || ! command -v xdotool >/dev/null; then
  echo "SKIPPED: xvfb or xdotool is missing"; exit 77
fi
if [ -z "${VSPRITE_TEST_DISPLAY:-}" ]; then
  VSPRITE_TEST_DISPLAY=1 exec xvfb-run -a -s "-noreset -screen 0 1280x760x24" bash "$0" "$@"
fi
. "$(dirname "$0")/lib.sh"

# open_window LOG COMMAND... : runs `vsprite COMMAND...` beside the test, as process $window, until its window
# has the keys. What it prints comes to LOG.out and LOG.err.
open_window() {
  local log=$1 title="vsprite $2" id; shift
  "$BIN/vsprite" "$@" >"$log.out" 2>"$log.err" &
  window=$!
  for _ in $(seq 200); do
    id=$(xdotool search --name "^$title\$" 2>/dev/null | head -1)
    [ -n "$id" ] && xdotool windowfocus "$id" 2>/dev/null && return
    kill -0 $window 2>/dev/null || break
    sleep 0.05
  done
  cp "$log.err" "$room/stderr"; fail "the window did not open"; finish
}
at() { xdotool mousemove "$1" "$2"; sleep 0.25; }
click() { at "$1" "$2"; xdotool mousedown "${3:-1}"; sleep 0.25; xdotool mouseup "${3:-1}"; sleep 0.25; }
press() { for key in "$@"; do xdotool key "$key"; sleep 0.3; done; }
