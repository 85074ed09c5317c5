#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# renderer_alone.sh LIBRARY: the renderer calls no window system and links no OpenGL: what it needs of
# OpenGL comes by the game's loader.
set -uo pipefail
symbols=$(nm -u "$1") || exit 2
found=$(awk '/^[a-z0-9_]+\.cpp\.o:/ {object = $1; next}
  object !~ /^sdl(_pictures)?\.cpp\.o:$/ && $2 ~ /^(SDL_|epoxy_|e?gl[A-Z])/ {print object, $2}
  {++seen} END {if (seen < 20) print "no symbols were read"}' <<<"$symbols")
[ -z "$found" ] || { echo "$found"; exit 1; }
