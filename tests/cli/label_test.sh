#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A person's answers: taken, kept, used, moved about; and every way in which they can be wrong.
. "$(dirname "$0")/lib.sh"
"$BIN/make_film" circle c.mp4 150 || fail make_film
expect 0 vsprite build c.mp4 -o c.vsp --max-size 64
plain=$(sum c.work/classifier.toml)
pack=$(sum c.vsp)

# Taken, used, said so; taken away again everything is as it was.
printf 'i,j,acceptable\n3,90,1\n5,40,0\n90,3,0\n7,60,1\n' >a.csv
expect 0 vsprite label --work c.work --answers a.csv --json
is_json /added /answers /pairs /acceptable /repeated /disagreeing /gone
expect 0 vsprite train --work c.work
prints "3 pairs labelled by a person"; prints "1 of these said the opposite (the last counts)"
prints "few answers: 1 smooth, 2 visible jumps"
[ "$(sum c.work/classifier.toml)" != "$plain" ] || fail "answers changed nothing"
expect 0 vsprite dump --work c.work --what labels -o labels.csv
[ "$(grep -c ',1$' labels.csv)" = 3 ] || fail "the dump does not hold the three answers"
grep -q '^3,90,0,1$' labels.csv || fail "the last of two answers does not count"
expect 0 vsprite label --work c.work --export e.csv
[ "$(wc -l <e.csv)" = 5 ] || fail "four answers and a header are due"
rm c.work/labels.sqlite
expect 0 vsprite train --work c.work
prints "labelled by the film (bootstrap)"
[ "$(sum c.work/classifier.toml)" = "$plain" ] || fail "without answers another classifier"
expect 0 vsprite label --work c.work --answers e.csv
expect 0 vsprite label --work c.work --export again.csv
cmp -s e.csv again.csv || fail "an exported file does not read back as itself"
expect 0 vsprite label --work c.work --answers labels.csv
prints "rows that no person gave passed over"
rm c.work/labels.sqlite

# The line moved: shown, not written; written; kept by everything after it.
expect 0 vsprite train --work c.work
expect 0 vsprite train --work c.work --threshold 0.8
prints "nothing was written"; prints "film's own labels"
[ "$(sum c.work/classifier.toml)" = "$plain" ] || fail "a preview wrote"
expect 0 vsprite train --work c.work --threshold 0.8 --json
is_json /thresholds/0/transitions /thresholds/0/accepted_bad /asked /written
expect 0 vsprite train --work c.work --threshold 0.8 --save
grep -q '^moved = 0.8$' c.work/classifier.toml || fail "the move was not written"
expect 0 vsprite build c.mp4 -o c.vsp --max-size 64
grep -q '^moved = 0.8$' c.work/classifier.toml || fail "build lost the move"
expect 0 vsprite label --work c.work --answers a.csv
expect 0 vsprite train --work c.work
grep -q '^moved = 0.8$' c.work/classifier.toml || fail "new answers lost the move"
expect 0 vsprite train --work c.work --threshold 1 --save
rm c.work/labels.sqlite
expect 0 vsprite build c.mp4 -o c.vsp --max-size 64
[ "$(sum c.vsp)" = "$pack" ] || fail "moved there and back, another pack"
expect 2 vsprite train --work c.work --save
says "--threshold X --save is due"

# Nobody to ask, nothing to read, slips.
expect 1 env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER "$BIN/vsprite" label --work c.work
says "--answers FILE"
expect 2 vsprite label
expect 66 vsprite label --work nowhere
expect 66 vsprite label --work c.work --answers nothing.csv
expect 2 vsprite label --work c.work --bind "acept=a"
says "ACTION one of accept"
expect 2 vsprite label --work c.work --bind "accept=f"
says "F would both accept and flip"
expect 2 vsprite label --work c.work --bind "accept=blank"
printf 'i,j,acceptable\n3,90,1\n3,9000,1\n' >slip.csv
expect 3 vsprite label --work c.work --answers slip.csv
says "slip.csv:3:3: j: \`9000\`"; one_sentence
expect 0 vsprite label --work c.work --export none.csv
[ "$(wc -l <none.csv)" = 1 ] || fail "a file with a slip was taken in part"

# A newer version, other programs' files, damage.
expect 0 vsprite label --work c.work --answers a.csv
cp c.work/labels.sqlite good.sqlite
printf '\0\0\0\2' | dd of=c.work/labels.sqlite bs=1 seek=60 conv=notrunc 2>/dev/null
expect 3 vsprite label --work c.work --export x.csv
says "version 2"; says "labels.sqlite"; one_sentence
expect 3 vsprite train --work c.work
says "version 2"; one_sentence
echo "no database" >c.work/labels.sqlite
expect 3 vsprite train --work c.work
says "is no database of labels"; one_sentence
head -c 6000 good.sqlite >c.work/labels.sqlite
expect 3 vsprite train --work c.work
says "damaged"; one_sentence
cp good.sqlite c.work/labels.sqlite

# A full disk: nothing of the new file is there, everything old is. Two at once: the second waits.
if command -v strace >/dev/null; then
  before=$(vsprite label --work c.work --json --export /dev/null 2>/dev/null | grep '"answers"')
  for point in pwrite64:1 pwrite64:2 pwrite64:4 fdatasync:1 fdatasync:3; do
    expect 74 strace -f -qq -o /dev/null -e inject=${point%:*}:error=ENOSPC:when=${point#*:}+ \
      "$BIN/vsprite" label --work c.work --answers a.csv
    says "labels.sqlite"; one_sentence
    after=$(vsprite label --work c.work --json --export /dev/null 2>/dev/null | grep '"answers"')
    [ "$after" = "$before" ] || fail "a full disk at $point: $after where $before is due"
  done
  strace -f -qq -o /dev/null -e inject=fdatasync:delay_enter=1500000:when=1 \
    "$BIN/vsprite" label --work c.work --answers a.csv >/dev/null 2>&1 &
  slow=$!
  sleep 0.7
  expect 75 vsprite label --work c.work --answers a.csv
  says "is in use by process"; one_sentence
  wait $slow || fail "the first of two failed"
fi

# One sample, two samples: nothing to ask or to learn, and answers are kept.
for lines in 2 3; do
  cp -r c.work small.work
  head -$lines c.work/samples.csv >small.work/samples.csv
  expect 3 vsprite label --work small.work
  says "acceptable pair"; one_sentence
  expect 3 vsprite train --work small.work
  says "at least one of each kind is due"; one_sentence
  expect 0 vsprite label --work small.work --export few.csv
  prints "about samples that are not here"
  rm -rf small.work
done

# Answers of one kind only, about a film that has none of the other.
printf 'i,j,acceptable\n' >one.csv
for k in $(seq 1 40); do echo "$k,$((k + 40)),1"; done >>one.csv
rm c.work/labels.sqlite
expect 0 vsprite label --work c.work --answers one.csv
expect 0 vsprite train --work c.work
prints "few answers: 40 smooth, 0 visible jumps"
finish
