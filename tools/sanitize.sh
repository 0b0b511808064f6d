#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the SLAM library and its tests with sanitizers, each in a separate build, and runs them,
# from single functions to complete mapping runs on images. Usage: sanitize.sh [PRESET]..., by
# default `address` (with undefined behaviour; without the long drives, and without the checks for
# null and misaligned pointers and the sizes of objects, which address errors and Eigen's own
# assertions tell of, and which take most of the time) and `thread` (what has threads). The preset
# `sanitize` leaves nothing out; `fuzz` builds the fuzzers of all readers and runs each for 20 s.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
presets=("$@")
[[ $# -gt 0 ]] || presets=(address thread)
for preset in "${presets[@]}"; do
  echo "sanitizer: $preset"
  [[ $preset != fuzz ]] || tools/setup.sh --fuzz
  cmake --preset "$preset"
  cmake --build --preset "$preset"
  ctest --preset "$preset"
done
