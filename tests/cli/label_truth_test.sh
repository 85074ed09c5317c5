#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# label_truth_test.sh BIN FILM: what answers are worth, against the bundled film's true pose.
. "$(dirname "$0")/lib.sh"
expect 0 vsprite segment "$2" --work g.work
"$BIN/labeltrial" g.work 3 || fail "a goal is missed"
finish
