#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Three Debian packages, the same bytes each time, from another folder too.
# package_test.sh BUILD SOURCE
set -u
build=$1 source=$2
for program in cpack dpkg-deb dpkg-shlibdeps; do
  command -v $program >/dev/null || { echo "SKIPPED: no $program on this machine"; exit 77; }
done
room=$(mktemp -d "${TMPDIR:-/tmp}/vsprite-package.XXXXXX")
trap 'rm -rf "$room"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
pack() {  # BUILD FOLDER OPTIONS...
  local from=$1 to=$2; shift 2
  (cd "$from" && cpack -B "$to" "$@" >"$room/log" 2>&1) || fail "$(tail "$room/log")"
}

pack "$build" "$room/one"
sleep 1.1  # another second in every time stamp
pack "$build" "$room/two"
packages=$(cd "$room/one" && ls ./*.deb)
[ "$(wc -w <<<"$packages")" = 3 ] || fail "three packages are due: $packages"
for package in $packages; do
  cmp "$room/one/$package" "$room/two/$package" || fail "$package: other bytes the second time"
  dpkg-deb -W --showformat='${Package} ${Version}: ${Depends}, ${Installed-Size} KiB\n' "$room/one/$package"
done
contents() { dpkg-deb -c "$room"/one/"$1"_*.deb | awk '{print $6}'; }
depends() { dpkg-deb -f "$room"/one/"$1"_*.deb Depends; }
contents libvsprite0 | grep -q 'libvsprite\.so\.0$' || fail "the runtime has no library"
contents libvsprite0 | grep -qE '\.(h|a|cmake)$|\.so$|/bin/' && fail "the runtime has more than the library"
contents libvsprite-dev | grep -q 'include/vsprite/c_api\.h$' || fail "no headers in the dev package"
contents vsprite-tools | grep -q 'bin/vsprite$' || fail "no tool in the tools"
for package in libvsprite0 libvsprite-dev vsprite-tools; do
  contents $package | grep -q "doc/$package/copyright$" || fail "$package has no notices"
done
depends libvsprite0 | grep -q 'libpng16' || fail "the runtime does not depend on what it links"
depends libvsprite0 | grep -qE 'libav|libsdl|opencv|libsqlite' && fail "the runtime pulls in the tool's libraries"
depends libvsprite-dev | grep -q 'libvsprite0 (= ' || fail "the dev package does not need the runtime"
depends vsprite-tools | grep -q 'libavcodec' || fail "the tools do not need FFmpeg's libraries"

# The engine alone, built elsewhere: the same package. (Another generator links in another order.)
start=$SECONDS
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
cmake -G "$generator" -S "$source" -B "$room/other" -DCMAKE_BUILD_TYPE=Release -DVSPRITE_PRECOMPUTE=OFF -DVSPRITE_DRAW=OFF \
  -DVSPRITE_GAMES=OFF -DVSPRITE_TESTS=OFF >"$room/log" 2>&1 &&
  cmake --build "$room/other" -j "$(nproc)" >>"$room/log" 2>&1 || fail "$(tail "$room/log")"
echo "the engine alone: built in $((SECONDS - start)) s"
pack "$room/other" "$room/three" -D CPACK_COMPONENTS_ALL=runtime
cmp "$room"/one/libvsprite0_*.deb "$room"/three/libvsprite0_*.deb || fail "libvsprite0: other bytes from another folder"
