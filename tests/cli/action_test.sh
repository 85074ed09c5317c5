#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Actions of a cast: shown in time, replayed to the tick, measured for every tag.
. "$(dirname "$0")/lib.sh"
film() { "$BIN/make_film" "$@" || fail "make_film $*"; }

film idle idle.mp4 24
film walk walk.mp4 30
film jump jump.mp4 40
cat >hero.toml <<END
[[clip]]
file = "idle.mp4"
tag = "idle"
[[clip]]
file = "walk.mp4"
tag = "walk"
velocity = [60, 0]
events = [{ frame = 7, name = "step" }, { frame = 22, name = "step" }]
[[clip]]
file = "jump.mp4"
frames = [0, 9]
tag = "jump.start"
[[clip]]
file = "jump.mp4"
frames = [10, 27]
tag = "jump.air"
[[clip]]
file = "jump.mp4"
frames = [28, 39]
tag = "jump.end"
END
expect 0 vsprite build hero.toml -o hero.vsp
expect 0 vsprite validate hero.vsp
expect 0 vsprite info hero.vsp --json
for section in ACTN EVNT BODY; do grep -q "\"$section\"" "$room/stdout" || fail "the pack has no section $section"; done

# 25 ticks a second. The tag shows at the latest at the n-th step after the request at tick 25; after
# the release at tick 75 it lands, and goes on as commanded.
tag_column=$(head -1 hero.work/samples.csv | tr , '\n' | grep -n '^tag$' | cut -d: -f1)
shown() {
  awk -F, -v c="$tag_column" 'FNR == 1 { f++; next } f == 1 { t[$1] = $c; next } { print t[$2] }' \
    hero.work/samples.csv trace.csv
}
for within in 0 2 4 8; do
  expect 0 vsprite steer hero.vsp --keys "0 right; 1 play jump $within; 3 release 4" --frames 150 --trace trace.csv
  late=$((25 + (within > 1 ? within : 1)))
  shown | head -"$late" | grep -qx jump.start || fail "jump.start is not shown by tick $late"
  shown | sed -n 70p | grep -qx jump.air || fail "it does not stay in the air"
  shown | sed -n 76,79p | grep -qx jump.end || fail "it does not land within 4"
  shown | tail -1 | grep -q '^jump' && fail "it does not go on"
done
expect 2 vsprite steer hero.vsp --keys "0 play fly"
says 'no action "fly", the pack has idle, walk, jump'; one_sentence
expect 2 vsprite steer hero.vsp --keys "0 play jump soon"
one_sentence

# A run repeats to the tick; one that does not is named.
script="0 right; 0.7 play jump 4; 1.5 release; 2 hold walk; 3 queue idle; 3.1 release; 4 rest"
expect 0 vsprite steer hero.vsp --keys "$script" --frames 200 --json --record run.vsr
hash=$(grep -o '"states_hash": "[0-9a-f]*"' "$room/stdout")
expect 0 vsprite steer hero.vsp --replay run.vsr --json
is_json /frames /states_hash /divergence /same_pack
[ "$(grep -o '"states_hash": "[0-9a-f]*"' "$room/stdout")" = "$hash" ] || fail "the replay has other states"
sed 's/\[60, 0\]/[50, 0]/' hero.toml >other.toml
expect 0 vsprite build other.toml
expect 3 vsprite steer other.vsp --replay run.vsr
says "run.vsr: goes another way at tick "; says "recorded with another pack"; one_sentence
head -c 500 run.vsr >cut.vsr
expect 3 vsprite steer hero.vsp --replay cut.vsr
one_sentence
expect 3 vsprite steer hero.vsp --replay hero.toml
says "not a replay"; one_sentence
expect 66 vsprite steer hero.vsp --replay none.vsr

# Measured for every tag and deadline; none late.
expect 0 vsprite steer hero.vsp --bench --keys "0 right; 1 left" --frames 60 --json
is_json /actions/0/tag /actions/24/frames/median /actions/24/transition_cost/mean /follow/slip/median
grep '"late"' "$room/stdout" | grep -vq '"late": 0' && fail "an action came late"

# Bad events: one sentence.
sed 's/frame = 22/frame = "22"/' hero.toml >bad.toml
expect 3 vsprite build bad.toml
says "bad.toml:8:"; says "events: a list of frames"; one_sentence
sed 's/frame = 22/frame = 30/' hero.toml >bad.toml
expect 3 vsprite segment bad.toml
says 'bad.toml:8:41: events: `step` at frame 30, the last of walk.mp4 is 29'; one_sentence

# What is shorter than the cast says, and events at frames that were left out, are told.
film line line.mp4 90
cat >short.toml <<END
[[clip]]
file = "line.mp4"
frames = [20, 400]
events = [{ frame = 50, name = "kept" }, { frame = 72, name = "gone" }]
[[clip]]
file = "line.mp4"
frames = [0, 60]
events = [{ frame = 0, name = "early" }]
END
expect 0 vsprite segment short.toml
prints "line.mp4: frames = [20, 400], but the film has 90 frames"
prints 'line.mp4: event `gone`: frame 72 was left out, it happens at frame 58'
prints 'line.mp4: event `early`: frame 0 was left out, and all before it: it never happens'
[ "$(grep -c warning: stdout)" = 3 ] || fail "more was warned of than is due"
no_temporaries
finish
