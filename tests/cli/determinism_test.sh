#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# The same film gives the same bytes at every thread count and with every instruction set that this
# CPU has.
. "$(dirname "$0")/lib.sh"
"$BIN/make_film" circle c.mp4 150 || fail make_film
expect 0 vsprite build c.mp4 -o c.vsp --jobs 1
good=$(sum c.vsp)
same() {  # same NAME VARIABLE=VALUE... -- OPTION...
  local name=$1 settings=(); shift
  while [ "$1" != -- ]; do settings+=("$1"); shift; done
  shift
  rm -rf c.vsp c.work
  expect 0 env "${settings[@]}" "$BIN/vsprite" build c.mp4 -o c.vsp "$@"
  [ "$(sum c.vsp)" = "$good" ] || fail "another pack with $name"
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
finish
