#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# The same pack and key script give the same states through every door as in the tool, which is C++,
# and a picture. A page makes the same run in tests/web.
# door_test.sh c|python|luajit|love BIN LIBRARY PACK GAMES
door=$1 bin=$2 pack=$4 games=$5
export VSPRITE_LIB=$3
room=$(mktemp -d "${TMPDIR:-/tmp}/vsprite-door.XXXXXX")
trap 'rm -rf "$room"' EXIT
script=$(cd "$(dirname "$0")" && pwd)/door.keys frames=240
fail() { echo "FAILED: $*" >&2; exit 1; }
need() { command -v "$1" >/dev/null || { echo "SKIPPED: no $1 on this machine"; exit 77; }; }

due=$("$bin/vsprite" steer "$pack" --keys "$script" --frames $frames --json 2>/dev/null |
  sed -n 's/.*"states_hash": "\([0-9a-f]*\)".*/\1/p')
[ ${#due} = 16 ] || fail "the tool gives no states_hash"

drawn=$room/drawn.png
"$bin/steer_c" "$pack" "$script" $frames "$drawn" >"$room/c" || fail "the C program"
case $door in
  c)
    found=$(cat "$room/c")
    "$bin/steer_c" no-such.vsp "$script" 1 2>"$room/error" && fail "a missing pack is no error"
    grep -q 'steer: error: no-such.vsp: no such file' "$room/error" || fail "$(cat "$room/error")"
    ;;
  python)
    need python3
    found=$(python3 "$games/python/steer.py" "$pack" "$script" $frames "$room/python.png")
    cmp "$drawn" "$room/python.png" || fail "Python draws another picture than C"
    python3 "$games/python/steer.py" "$pack" "0 sideways" 1 2>"$room/error" && fail "a bad script is no error"
    grep -q 'unknown direction' "$room/error" || fail "$(cat "$room/error")"
    ;;
  luajit)
    need luajit
    found=$(cd "$games/love" && luajit - "$pack" "$script" $frames "$room/run.vsr" <<'LUA'
local v, ffi = require("vsprite"), require("ffi")
local sprite = v.make("sprite", "load_pack", arg[1])
local keys, hash = v.make("keys", "load_keys", sprite, arg[2]), v.make("hash", "make_hash")
local actor = ffi.new("vsprite_actor")
assert(ffi.sizeof(actor) == 64)
v.call("make_actor", sprite, 0, 0, 0, 0, actor)
local recording = v.make("recording", "make_recording", sprite, actor, 1)
for _ = 1, tonumber(arg[3]) do
  v.call("record_keys", recording, 0, actor, keys)
  v.call("step", sprite, actor)
  v.call("record_tick", recording, actor, 1)
  v.call("add_to_hash", hash, actor)
end
v.call("save_recording", recording, arg[4])
local fine, said = pcall(v.make, "sprite", "load_pack", "no-such.vsp")
assert(not fine and said:find("no such file"), said)
print(v.digest(hash))
LUA
    )
    "$bin/vsprite" steer "$pack" --replay "$room/run.vsr" --json >"$room/again" || fail "the tool makes another run of it"
    grep -q "\"states_hash\": \"$due\"" "$room/again" || fail "the recording: $(cat "$room/again")"
    ;;
  love)
    need love
    found=$(env -u DISPLAY -u WAYLAND_DISPLAY SDL_VIDEODRIVER=offscreen XDG_DATA_HOME="$room" \
      timeout 100 love "$games/love" "$pack" "$script" $frames 2>"$room/error") || fail "$(cat "$room/error")"
    shot=$(find "$room" -name vsprite.png)
    [ -n "$shot" ] || fail "LÖVE kept no screenshot"
    # LÖVE blends the encoded values, the canvas in linear light: soft edges differ. The middle alone.
    likeness=$(ffmpeg -i "$shot" -i "$drawn" -lavfi "[0]crop=32:32[a];[1]crop=32:32[b];[a][b]psnr" \
      -f null - 2>&1 | sed -n 's/.*average:\([0-9a-z]*\).*/\1/p')
    [ "$likeness" = inf ] || [ "${likeness:-0}" -ge 25 ] ||
      fail "LÖVE's picture is not that of the canvas: ${likeness:-no} dB"
    ;;
esac
[ "$found" = "$due" ] || fail "$door: states $found, the tool has $due"
echo "$door: states $found"
