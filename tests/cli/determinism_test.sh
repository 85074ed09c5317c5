#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# The same film gives the same bytes at every thread count and with every instruction set that this
# CPU has: the pack, and every file of the work folder.
. "$(dirname "$0")/lib.sh"
"$BIN/make_film" shadow c.mp4 150 || fail make_film
"$BIN/make_film" walk w.mp4 60 1.2 1 30 || fail make_film
printf '[[clip]]\nfile = "c.mp4"\ntag = "swim"\n[[clip]]\nfile = "w.mp4"\ntag = "walk"\nvelocity = [90, 0]\nmirror = true\n' >cast.toml
whole() { (cd "$1" && find . -type f ! -name lock | LC_ALL=C sort | xargs sha256sum | sha256sum); }
expect 0 vsprite build c.mp4 -o c.vsp --jobs 1
good=$(sum c.vsp) files=$(whole c.work)
same() {  # same NAME VARIABLE=VALUE... -- OPTION...
  local name=$1 settings=(); shift
  while [ "$1" != -- ]; do settings+=("$1"); shift; done
  shift
  rm -rf c.vsp c.work
  expect 0 env "${settings[@]}" "$BIN/vsprite" build c.mp4 -o c.vsp "$@"
  [ "$(sum c.vsp)" = "$good" ] || fail "another pack with $name"
  [ "$(whole c.work)" = "$files" ] || fail "another work folder with $name"
}
for jobs in 2 3 4 8 16; do same "$jobs threads" A=1 -- --jobs $jobs; done
same "a plain libm" GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F -- --jobs 3
# The limit is in force: a name that it does not know stops the program.
expect 2 env LD_PRELOAD="$BIN/limit_targets.so" VSPRITE_TEST_TARGET=mmx "$BIN/vsprite"
says "no such target: mmx"
for target in avx3_dl avx3 avx2 sse4 ssse3 none; do
  same "vectors no better than $target" LD_PRELOAD="$BIN/limit_targets.so" \
    VSPRITE_TEST_TARGET=$target -- --jobs 2
done
# With what else a person may ask for; then a cast.
others() {
  rm -rf c.vsp c.work cast.vsp cast.work
  expect 0 vsprite build c.mp4 -o c.vsp --shadow --mirror --edge -0.5 --clip-black 0.1 --despill 1.5 --jobs "$1"
  expect 0 vsprite build cast.toml -o cast.vsp --shadow --draft --jobs "$1"
  made="$(sum c.vsp) $(whole c.work) $(sum cast.vsp) $(whole cast.work)"
}
others 1; due=$made
for jobs in 2 4 8; do
  others $jobs
  [ "$made" = "$due" ] || fail "other bytes of a cast or with options at $jobs threads"
done
finish
