#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# moving.sh BUILD PACK: a recorded run of the aquarium as assets/readme/aquarium.webp, an animated
# picture that a README can show: ten seconds, 15 frames a second, 480x270.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
keys="0 left; 1.6 left+down; 2.8 right+down; 4 right; 5.8 right+up; 7 up; 8 left+up; 9.4 left"
"$1/bin/aquarium" "$2" --headless --frames 330 --size 960x540 --seed 3 --keys "$keys" --record "$folder/run.mp4"
ffmpeg -nostdin -v error -y -ss 1 -i "$folder/run.mp4" -vf "fps=15,scale=480:270:flags=area" -c:v libwebp_anim \
  -quality 62 -compression_level 6 -loop 0 "$(dirname "${BASH_SOURCE[0]}")/aquarium.webp"
