#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# The same film gives the same bytes at every thread count and with every instruction set.
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
finish
