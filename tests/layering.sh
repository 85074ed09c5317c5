#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Who may include whom. Nothing points the other way.
cd "$1" || exit 2
bad=0
# forbid PATTERN IN-FILES... : no include that matches PATTERN
forbid() {
  local pattern=$1; shift
  if grep -nE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($pattern)" "$@" /dev/null; then
    echo "^ must not include ($pattern)"; bad=1
  fi
}
src() { find "$@" -name '*.h' -o -name '*.cpp' | sort; }
forbid 'libav|libsw|film/|similarity/|control/|synthesis/|tool/|window/|Eigen|nlohmann|CLI|spdlog|toml|tbb' $(src engine)
forbid 'SDL|epoxy|GL|png|zstd|xxh|hwy' $(find engine/include -name '*.h' ! -name sdl.h)
forbid 'SDL|vsprite/sdl' $(src engine/src | grep -vxE 'engine/src/(sdl|sdl_pictures).cpp')
forbid 'GL' $(src engine/src | grep -vx engine/src/gl.cpp)
forbid 'epoxy' $(src engine precompute games)
forbid 'png\.h' $(find engine/src precompute games -name '*.cpp' ! -path engine/src/png.cpp -o -name '*.h' -path '*precompute*')
forbid 'opencv' $(src engine precompute games | grep -v precompute/bench/keyer_bench.cpp)  # there a rival only
forbid 'libav|libsw' $(src precompute games | grep -vE 'precompute/film/(container|decoder|sender)\.')
forbid 'similarity/|control/|tool/|window/' $(src precompute/film)
forbid 'control/|tool/|window/' $(src precompute/similarity)
forbid 'tool/|window/' $(src precompute/control)
forbid 'SDL|imgui|vsprite/(draw|session|sdl|window)\.h' $(src precompute/film precompute/similarity precompute/control precompute/tool)
forbid 'film/|similarity/|control/|tool/|window/|\.\./engine|src/' $(src games)
exit $bad
