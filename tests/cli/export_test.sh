#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A pack as a page: what goes into it, and every way to ask for it wrong. The page in a browser:
# tests/web.
. "$(dirname "$0")/lib.sh"
"$BIN/tiny_pack" tiny.vsp || fail "tiny_pack"
printf '<title>@VSPRITE_TITLE@</title>\n<script>@VSPRITE_PACK@</script>\n' >page.in
export_page() { vsprite export tiny.vsp --to html --template page.in "$@"; }

expect 0 export_page -o a.html --json
is_json /file /to /bytes /pack_bytes
grep -q '<title>tiny</title>' a.html || fail "no title"
sed -n 's,.*<script>\(.*\)</script>,\1,p' a.html | base64 -d | cmp -s - tiny.vsp || fail "not the pack"
expect 0 export_page; prints "tiny.html: "
cmp -s a.html tiny.html || fail "not the same page"

head -c 8000000 /dev/zero | tr '\0' ' ' >large.in; cat page.in >>large.in
expect 0 vsprite export tiny.vsp --to html --template large.in -o large.html
head -c 3000000 /dev/zero | tr '\0' ' ' >>large.in
expect 3 vsprite export tiny.vsp --to html --template large.in -o b.html; says "at most 10.0 MB"; one_sentence
expect 0 vsprite export tiny.vsp --to html --template large.in --limit 12 -o b.html
echo nothing >empty.in
expect 3 vsprite export tiny.vsp --to html --template empty.in; says "@VSPRITE_PACK@ is due"; one_sentence
expect 66 vsprite export tiny.vsp --to html --template absent.in; one_sentence
expect 66 vsprite export absent.vsp --to html --template page.in; one_sentence
expect 3 vsprite export page.in --to html --template page.in; one_sentence
expect 2 vsprite export tiny.vsp --template page.in; says "--to is due"; one_sentence
expect 2 vsprite export tiny.vsp --to gif; one_sentence
expect 2 vsprite export --to html; says "a pack is due"; one_sentence
expect 73 export_page -o absent/c.html; one_sentence

"$BIN/make_film" circle ring.mp4 200 || fail "make_film"
expect 0 vsprite build ring.mp4 -o ring.vsp --max-size 64
expect 0 vsprite export ring.vsp --to table --samples 0 -o folder --json
is_json /to /samples /pages /folder
for file in character.json page-0.png; do [ -s folder/$file ] || fail "no $file"; done
expect 0 vsprite export ring.vsp --to png-seq; prints "ring-png-seq: "
[ -s ring-png-seq/sample-000000.png ] || fail "no pictures"
expect 2 vsprite export ring.vsp --to tabel; says "html|table|png-seq"; one_sentence
expect 73 vsprite export ring.vsp --to table -o absent/folder; one_sentence
expect 66 vsprite export absent.vsp --to table; one_sentence
no_temporaries
finish
