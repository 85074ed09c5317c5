# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
#
# What the tests of the tool share. Sourced: BIN is the folder of the programs.
set -u
BIN=$1
vsprite() { "$BIN/vsprite" "$@"; }
room=$(mktemp -d "${TMPDIR:-/tmp}/vsprite-cli.XXXXXX")
trap 'cd /; rm -rf "$room"' EXIT
cd "$room" || exit 1
export CI=1
failed=0

fail() { echo "FAILED: $*" >&2; sed 's/^/    /' "$room/stderr" 2>/dev/null | tail -5 >&2; failed=1; }

# expect CODE COMMAND... : runs it, keeps stdout and stderr, compares the exit code.
expect() {
  local due=$1 got=0; shift
  "$@" >"$room/stdout" 2>"$room/stderr" || got=$?
  [ "$got" = "$due" ] || fail "exit $got where $due is due: $*"
}
# says TEXT : the last command's stderr holds TEXT.
says() { grep -qF -- "$1" "$room/stderr" || fail "stderr does not say: $1"; }
# prints TEXT : its stdout holds TEXT.
prints() { grep -qF -- "$1" "$room/stdout" || fail "stdout does not hold: $1"; }
# is_json POINTER... : its stdout is one JSON document that has these.
is_json() { "$BIN/json_check" "$@" <"$room/stdout" || fail "not the JSON that is due"; }
one_sentence() {
  [ "$(grep -c 'error:' "$room/stderr")" = 1 ] || fail "one error line is due"
  grep 'error:' "$room/stderr" | grep -q '\.$' && fail "an error ends in a full stop"
}
sum() { sha256sum "$1" | cut -d' ' -f1; }
no_temporaries() {
  local left; left=$(find . -name '*.tmp.*' -o -name keyed)
  [ -z "$left" ] || fail "left behind: $left"
}
finish() { [ "$failed" = 0 ] && echo "all as due"; exit "$failed"; }
