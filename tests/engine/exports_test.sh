#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# The shared library exports what c_api.h declares, and nothing else.
# exports_test.sh LIBRARY HEADER
exported=$(nm -D --defined-only "$1" | awk '{print $3}' | sort) || exit 1
declared=$(grep -oE '\bvsprite_[a-z_]+\(' "$2" | tr -d '(' | sort -u)
for name in $declared; do  # a name in a comment is no declaration
  grep -qE "^(VSPRITE_API .*|  +)$name\(|^VSPRITE_API [a-z0-9_ ]+\*? ?$name\(" "$2" || declared=$(grep -vx "$name" <<<"$declared")
done
if ! diff <(echo "$declared") <(echo "$exported"); then
  echo "< declared but not exported, > exported but not declared"; exit 1
fi
echo "$(wc -l <<<"$exported") symbols, all of them declared"
