#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs the libraries, builds the examples against them as separate projects, and runs these:
# feed_images (docs/library.md must show the same) on images of a plane, whose trajectory is checked,
# and replay_recording where the harness is built. With the program it is installed too, and finds
# its data from another folder. Usage: library_test.sh ROOT BUILD CMAKE PLANE_PICTURES [COMPONENT...]
set -euo pipefail
root=$1 build=$2 cmake=$3 plane_pictures=$4
work=$build/library
prefix=$work/prefix
rm -rf "$work"
mkdir -p "$work"

# The first C++ block is the example.
awk '/^```cpp$/ { inside = 1; next } inside && /^```$/ { exit } inside' "$root/docs/library.md" |
  diff - <(sed 1,2d "$root/examples/feed_images/feed_images.cpp") ||
  { echo "docs/library.md shows another example than examples/feed_images/feed_images.cpp" >&2; exit 1; }

shift 4
for component in slam "$@"; do
  "$cmake" --install "$build" --prefix "$prefix" --component "$component" >>"$work/install.log"
done
[[ $(find "$prefix/include" -name '*.h' | wc -l) -lt 90 ]] || { echo "installs too many headers" >&2; exit 1; }
"$cmake" -S "$root/examples/feed_images" -B "$work/example" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_BUILD_TYPE=Release
"$cmake" --build "$work/example"
# The package must not depend on the source tree.
if grep -rnF "$root" "$prefix/lib/cmake" --include=vinebench*.cmake | grep -vF "$prefix"; then
  echo "the package names the source tree" >&2
  exit 1
fi

"$plane_pictures" "$work/images"
"$work/example/feed_images" "$work/images" | tee "$work/poses.txt"
# 19 steps of 12 mm to the right, which is -y: -0.228 m. A tenth of a pixel is 0.6 mm.
awk 'END { exit !(NR == 20 && $3 < -0.2265 && $3 > -0.2295 && $2^2 + $4^2 < 4e-6) }' "$work/poses.txt"
[[ $(grep -vc '^#' "$work/images/trajectory.tum") -eq 20 ]]
# Without images, and without an argument.
mkdir -p "$work/empty"
[[ -z $("$work/example/feed_images" "$work/empty") ]]
if "$work/example/feed_images" 2>/dev/null; then exit 1; fi

# What is built of the rest.
if [[ " $* " == *" harness "* ]]; then
  "$cmake" -S "$root/examples/replay_recording" -B "$work/replay" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_BUILD_TYPE=Release
  "$cmake" --build "$work/replay"
  if "$work/replay/replay_recording" "$work/empty" 2>"$work/said"; then exit 1; fi
  grep -q "is not a recording" "$work/said"
fi
if [[ " $* " == *" program "* ]]; then
  cd "$work/empty"
  "$prefix/bin/vinebench" list scenarios >"$work/said"
  grep -q "^  occluded-camera " "$work/said"
  "$prefix/bin/vinebench" __complete -- run occl >"$work/said"
  grep -qx occluded-camera "$work/said"
  [[ -x $prefix/libexec/vinebench/vinebench_plugin_host ]]
  [[ -f $prefix/share/bash-completion/completions/vinebench ]]
  if "$prefix/bin/vinebench" run occluded-camera --set nonsense=1 2>"$work/said"; then exit 1; fi
  grep -q "nonsense: unknown key" "$work/said"
fi
