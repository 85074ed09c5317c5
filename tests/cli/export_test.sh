#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# A pack for other places: what goes into it, what other programs read of it, and every way to ask
# for it wrong. The page in a browser: tests/web.
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"
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
expect 0 vsprite export tiny.vsp --to html --template large.in --budget 12 -o b.html
echo nothing >empty.in
expect 3 vsprite export tiny.vsp --to html --template empty.in; says "@VSPRITE_PACK@ is due"; one_sentence
expect 66 vsprite export tiny.vsp --to html --template absent.in; one_sentence
expect 66 vsprite export absent.vsp --to html --template page.in; one_sentence
expect 3 vsprite export page.in --to html --template page.in; one_sentence
expect 2 vsprite export tiny.vsp --template page.in; says "--to is due: html|"; one_sentence
expect 2 vsprite export tiny.vsp --to gift; says "|gif|"; one_sentence
expect 2 vsprite export --to html; says "a pack is due"; one_sentence
expect 73 export_page -o absent/c.html; one_sentence

"$BIN/make_film" circle ring.mp4 200 || fail "make_film"
expect 0 vsprite build ring.mp4 -o ring.vsp --max-size 64
expect 0 vsprite export ring.vsp --to table --samples 0 -o folder --json
is_json /to /samples /pages /folder
for file in character.json page-0.png; do [ -s folder/$file ] || fail "no $file"; done
expect 0 vsprite export ring.vsp --to png-seq; prints "ring-png-seq: "
[ -s ring-png-seq/sample-000000.png ] || fail "no pictures"

# The pages in LÖVE, steered by the player in Lua: the pictures that `png-seq` wrote.
if command -v love >/dev/null && command -v ffmpeg >/dev/null; then
  cp -r folder love && cp "$here/export_love.lua" love/main.lua
  cp "$here/../../assets/players/vsprite.lua" love/player.lua
  expect 0 vsprite export ring.vsp --to png-seq --samples 0 -o all
  expect 0 env -u DISPLAY -u WAYLAND_DISPLAY SDL_VIDEODRIVER=offscreen XDG_DATA_HOME="$room/saved" timeout 100 love love
  pixels() { ffmpeg -v error -i "$1" -pix_fmt rgba -f md5 -; }
  shown=0
  for picture in $(find saved -name 'sample-*.png'); do
    [ "$(pixels "$picture")" = "$(pixels "all/${picture##*/}")" ] || fail "LÖVE shows another ${picture##*/}"
    shown=$((shown + 1))
  done
  [ $shown -ge 20 ] || fail "LÖVE shows $shown pictures"
  echo "$shown pictures in LÖVE are the pack's"
else
  echo "skipped: no love or ffmpeg here, the table is not played in LÖVE"
fi

# A page within a budget: samples are left out, what stays is a pack.
whole=$(stat -c %s ring.vsp); budget=$(awk "BEGIN { print 0.8 * $whole * 4 / 3 / 1e6 }")
expect 0 vsprite export ring.vsp --to html --template page.in --budget "$budget" -o small.html --json
is_json /samples /samples_before /turn_median /bytes
sed -n 's,.*<script>\(.*\)</script>,\1,p' small.html | base64 -d >small.vsp
expect 0 vsprite validate small.vsp
[ "$(stat -c %s small.vsp)" -le $((whole * 8 / 10)) ] || fail "over the budget"
expect 3 vsprite export ring.vsp --to html --template page.in --budget 0.01; says "raise --budget"; one_sentence

# What plays itself: read back by other programs, against the pack's own pictures.
for format in sheet+aseprite-json texturepacker-json godot-tres apng gif webm mkv-ffv1; do
  expect 0 vsprite export ring.vsp --to $format --json; is_json /to /samples /runs /folder
done
python=
for p in python3 /usr/bin/python3; do "$p" -c 'import PIL' 2>/dev/null && python=$p && break; done
if [ -n "$python" ] && command -v ffmpeg >/dev/null; then
  expect 0 "$python" "$here/export_read.py" ring-png-seq ring-sheet+aseprite-json \
    ring-texturepacker-json --films ring-apng ring-gif ring-webm ring-mkv-ffv1
  cat stdout
else
  echo "skipped: no python3-pil or ffmpeg here, sheets and films are not read back"
fi
expect 0 vsprite export ring.vsp --to mkv-ffv1 -o again
cmp -s ring-mkv-ffv1/runs.json again/runs.json || fail "other runs"
for film in ring-mkv-ffv1/*.mkv; do cmp -s "$film" "again/${film##*/}" || fail "$film differs"; done
expect 0 vsprite export ring.vsp --to sheet+aseprite-json --order film --samples 0 -o film
grep -q '"name":"film"' film/page-0.json || fail "no film in its order"
expect 0 vsprite export ring.vsp --to godot-tres --godot 3 -o godot
if command -v godot3-server >/dev/null; then
  echo 'config_version=4' >godot/project.godot
  cat >godot/read.gd <<'END'
extends SceneTree
func _init():
	var frames = load("res://character.tres")
	for name in frames.get_animation_names():
		var picture = frames.get_frame(name, 0)
		print("animation ", name, " ", frames.get_frame_count(name), " ", picture.get_width())
	print("velocity ", frames.get_meta("velocities")["right"].size())
	quit()
END
  expect 0 env HOME="$room" timeout 100 godot3-server --path godot -s read.gd
  frames=$(sed -n 's/^animation right \([0-9]*\) .*/\1/p' stdout)
  [ "${frames:-0}" -ge 2 ] || fail "Godot 3 sees no animation"
  prints "velocity $frames"
else
  echo "skipped: no godot3-server here, character.tres is not opened"
fi
expect 2 vsprite export ring.vsp --to godot-tres --godot 5; says "4|3"; one_sentence
expect 2 vsprite export ring.vsp --to gif --order backwards; says "directions|film"; one_sentence
expect 1 env PATH=/nowhere "$BIN/vsprite" export ring.vsp --to gif -o none; says "apt install ffmpeg"; one_sentence

expect 2 vsprite export ring.vsp --to tabel; says "html|table|png-seq|"; one_sentence
expect 73 vsprite export ring.vsp --to table -o absent/folder; one_sentence
expect 66 vsprite export absent.vsp --to table; one_sentence

# The smoothest loops.
expect 0 vsprite loops ring.vsp --json; is_json /loops/0/name /loops/0/ticks /loops/0/seam /loops/0/samples
expect 0 vsprite loops ring.vsp --length 24..30 --direction right --to apng -o loops
prints "right "; prints "loops: apng"
grep -q '"seam":' loops/runs.json || fail "no seam in runs.json"
[ -s loops/right.apng ] || fail "no loop"
expect 3 vsprite loops ring.vsp --length 1 --direction right; says "no loop of 1 ticks for right"; one_sentence
expect 2 vsprite loops ring.vsp --tag jump; says "no such tag"; one_sentence
expect 2 vsprite loops tiny.vsp --tag swin; says "did you mean \`swim\`"; one_sentence
expect 0 vsprite loops tiny.vsp --tag swim --length 13; prints "swim "; prints "13 ticks"
for length in 0 1001 30..20 20.. x; do expect 2 vsprite loops ring.vsp --length $length; one_sentence; done
expect 2 vsprite loops ring.vsp --direction up+down; one_sentence
expect 2 vsprite loops ring.vsp --to table; says "holds no loops"; one_sentence
expect 2 vsprite loops ring.vsp -o x; says "--to FORMAT is due"; one_sentence
expect 2 vsprite loops; one_sentence
expect 66 vsprite loops absent.vsp; one_sentence
expect 73 vsprite loops ring.vsp --to gif -o absent/folder; one_sentence

# A pack without frames, one with 100,000, and places that cannot be written.
"$BIN/draw_puppets" art && expect 0 vsprite fit art/face.toml -o face.vsp
for format in table gif; do expect 3 vsprite export face.vsp --to $format; one_sentence; done
"$BIN/tiny_pack" long.vsp 100000 || fail "tiny_pack"
expect 0 vsprite export long.vsp --to texturepacker-json --order film --samples 0
prints "100000 samples of 100000"
expect 3 vsprite export long.vsp --to table; says "raise --samples, or 0 for all"; one_sentence
echo file >occupied
expect 73 vsprite export ring.vsp --to table -o occupied; one_sentence
expect 73 vsprite export ring.vsp --to webm -o occupied; one_sentence
mkdir taken taken/character.json taken/right.gif
expect 74 vsprite export ring.vsp --to table -o taken; one_sentence
expect 74 vsprite export ring.vsp --to gif -o taken; one_sentence
no_temporaries
finish
