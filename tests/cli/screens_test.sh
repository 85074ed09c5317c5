#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Help screens, and every way to get the command line wrong.
. "$(dirname "$0")/lib.sh"

expect 0 vsprite
prints "usage: vsprite build FILM -o PACK"
[ "$(awk 'length > 100' "$room/stdout" | wc -l)" -le 1 ] || fail "the screen is too wide"
expect 0 vsprite --version
prints "vsprite 0.1.0"
for verb in segment label train transitions solve pack build steer path info report validate loops export dump doctor; do
  expect 0 vsprite help $verb
  prints "example:"
  expect 0 vsprite $verb --help
  prints "--json"
done
expect 0 vsprite help solve
prints "--alpha A"
prints "0.0..<1.0; default 0.97"

expect 2 vsprite bulid film.mp4
says "did you mean \`build\`"; one_sentence
expect 2 vsprite report
expect 2 vsprite help nothing
expect 2 vsprite --nothing
expect 2 vsprite build film.mp4 --max-szie 100
says "did you mean \`--max-size\`"; one_sentence
expect 2 vsprite build film.mp4 --max-size 5
says "a whole number from 16 to 4096 is due"
expect 2 vsprite solve --work w --alpha 1
says "--alpha 1: a number from 0.0 to below 1.0 is due"
expect 2 vsprite solve --work w --alpha nan
expect 2 vsprite build film.mp4 --key purple
expect 2 vsprite build film.mp4 other.mp4
expect 2 vsprite build
expect 2 vsprite info
expect 2 vsprite build film.mp4 --set max-sise=3
says "did you mean \`max-size\`"
expect 2 vsprite build film.mp4 --max-size
one_sentence

echo 'max-size = 100' >good.toml
printf 'alpha = 0.9\nmax-sise = 100\n' >unknown.toml
printf 'alpha = = 1\n' >broken.toml
printf 'alpha = 7\n' >range.toml
expect 0 vsprite build film.mp4 --config good.toml --dump-config
prints "max-size = 100"
expect 0 vsprite build film.mp4 --config good.toml --set max-size=90 --dump-config
prints "max-size = 90"
expect 0 vsprite build film.mp4 --config good.toml --set max-size=90 --max-size 80 --dump-config
prints "max-size = 80"
vsprite build film.mp4 --dump-config >again.toml
expect 0 vsprite build film.mp4 --config again.toml --dump-config
diff -q again.toml stdout >/dev/null || fail "a dumped configuration does not read back as itself"
expect 3 vsprite build film.mp4 --config unknown.toml
says "unknown.toml:2:1"; says "did you mean \`max-size\`"
expect 3 vsprite build film.mp4 --config broken.toml
says "broken.toml:1:"
expect 3 vsprite build film.mp4 --config range.toml
expect 66 vsprite build film.mp4 --config absent.toml

expect 2 vsprite info --json
is_json /error/code /error/message
[ "$(vsprite >/dev/full 2>/dev/null; echo $?)" = 74 ] || fail "a full standard output is not reported"
finish
