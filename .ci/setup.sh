# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# What ./play and ./test share: install what is missing, build, say how long each step took.

here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$here/build/release"

play_packages="g++ cmake ninja-build pkg-config libsdl2-dev libgl-dev libpng-dev libzstd-dev
  libxxhash-dev libavformat-dev libavcodec-dev libswscale-dev libeigen3-dev libtbb-dev libhwy-dev
  libcli11-dev libtomlplusplus-dev libpugixml-dev nlohmann-json3-dev libsqlite3-dev libimgui-dev fonts-dejavu-core ffmpeg"
test_packages="$play_packages libgtest-dev liblinear-dev strace xvfb xauth xdotool luajit love python3
  python3-pil godot3-server"

say() { printf '\033[1m==>\033[0m %s\n' "$*"; }
[ -t 1 ] && [ -z "${NO_COLOR:-}" ] || say() { printf '==> %s\n' "$*"; }
die() { printf '%s: error: %s\n' "$(basename "$0")" "$1" >&2; exit "${2:-1}"; }

# step NAME COMMAND...: runs it and prints the seconds it took.
step() {
  local name=$1 start=$SECONDS; shift
  "$@" || return
  say "$name: $((SECONDS - start)) s"
}

# install_missing PACKAGE...: only what is absent, nothing recommended.
install_missing() {
  local missing=() package
  command -v dpkg-query >/dev/null ||
    die "this script installs Debian packages, and dpkg is not here: install $* (or what your system calls them), then build with cmake --preset release"
  for package in "$@"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null ||
      die "missing packages need root, and sudo is not here: as root, run apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  say "installing ${#missing[@]} packages: ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update && "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
         apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
    tail -n 15 "$log" >&2
    die "apt-get could not install the packages above (whole log: $log)"
  fi
  rm -f "$log"
}

# build_targets "CMAKE OPTIONS" TARGET...: configures when needed, builds quietly, shows errors whole.
build_targets() {
  local options=$1 log; shift
  log=$(mktemp)
  # shellcheck disable=SC2086  # options are words
  if ! { cmake -S "$here" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release $options &&
         cmake --build "$build" ${1:+--target "$@"}; } >"$log" 2>&1; then
    grep -E -A 12 'error|Error|FAILED' "$log" | head -n 60 >&2
    die "the build failed (whole log: $log)"
  fi
  rm -f "$log"
}
