#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A stranger's program against the installed tree.
# consumer_test.sh install|engine|draw|c|pkgconfig BUILD PREFIX [PACK]
set -u
kind=$1 build=$2 prefix=$3 pack=${4:-}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
room=$(mktemp -d "${TMPDIR:-/tmp}/vsprite-consumer.XXXXXX")
trap 'rm -rf "$room"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

if [ "$kind" = install ]; then
  rm -rf "$prefix"
  cmake --install "$build" --prefix "$room/first" >"$room/log" 2>&1 || fail "$(tail -5 "$room/log")"
  mv "$room/first" "$prefix" || fail "cannot be moved"  # nothing may remember where it was installed
  ! grep -rqIF "$room" "$prefix" || fail "a file names the folder that it was installed to"
  ! grep -rqIF "$build" "$prefix" || fail "a file names the folder that it was built in"
  exit 0
fi

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$(echo "$prefix"/lib/*/pkgconfig)
library=$(dirname "$(find "$prefix" -name libvsprite.so.0)")
tool=$prefix/bin/vsprite
due=$("$tool" steer "$pack" --keys "0 right" --frames 60 --json 2>/dev/null |
  sed -n 's/.*"states_hash": "\([0-9a-f]*\)".*/\1/p')
[ ${#due} = 16 ] || fail "the installed tool gives no states_hash"

by_cmake() {  # WANT
  cmake -S "$here" -B "$room/$1" -DWANT="$1" -DCMAKE_PREFIX_PATH="$prefix" >"$room/log" 2>&1 &&
    cmake --build "$room/$1" >>"$room/log" 2>&1 || fail "$1: $(tail -20 "$room/log")"
}
same() {  # WHAT COMMAND...: prints the tool's states
  local what=$1 found; shift
  found=$("$@" "$pack") || fail "$what does not run"
  [ "$found" = "$due" ] || fail "$what: states $found, the tool has $due"
}
case $kind in
  engine)
    by_cmake engine
    same "find_package, engine" "$room/engine/stranger"
    cmake -S "$here" -B "$room/wings" -DWANT=wings -DCMAKE_PREFIX_PATH="$prefix" >"$room/log" 2>&1 &&
      fail "a component that does not exist is found"
    tr -s ' \n' ' ' <"$room/log" | grep -q "there is no component wings" || fail "$(cat "$room/log")"
    ;;
  draw)
    by_cmake draw
    [ "$(env -u DISPLAY SDL_VIDEODRIVER=offscreen "$room/draw/stranger" "$pack")" = "3 frames" ] ||
      fail "find_package, draw: does not run"
    ;;
  c)
    by_cmake c
    same "find_package, c" env LD_LIBRARY_PATH="$library" "$room/c/stranger"
    # shellcheck disable=SC2046  # flags are words
    cc -std=c99 -Wall -Wextra -pedantic -Werror "$here/stranger.c" \
      $(pkg-config --cflags --libs vsprite-c) -o "$room/plain" || fail "pkg-config, C"
    same "pkg-config, C" env LD_LIBRARY_PATH="$library" "$room/plain"
    ;;
  pkgconfig)
    # shellcheck disable=SC2046
    c++ -std=c++20 "$here/engine.cpp" $(pkg-config --cflags --libs vsprite) -o "$room/plain" ||
      fail "pkg-config, C++"
    same "pkg-config, C++" "$room/plain"
    pkg-config --exists "vsprite = $("$tool" --version | grep -oE '[0-9]+\.[0-9]+\.[0-9]+')" ||
      fail "pkg-config and the tool are of two versions"
    ;;
esac
