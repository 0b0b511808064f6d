#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds libraries and tests with sanitizers, each in a separate build, and runs them, from single
# functions to complete mapping runs on images. Usage: sanitize.sh [PRESET]..., by default `fuzz` and
# `thread`:
#   fuzz     with clang: address and undefined behaviour, but for the checks for null and misaligned
#            pointers and the sizes of objects, which address errors and Eigen's own assertions tell
#            of, and which take most of the time; the tests of core, and the fuzzers of all readers,
#            6 s each
#   thread   what has threads in slam, but for the longest test; thread-long that one
#   address  all tests of core and slam but the longest, with the default compiler
#   sanitize everything, with all checks
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
presets=("$@")
[[ $# -gt 0 ]] || presets=(fuzz thread)
for preset in "${presets[@]}"; do
  echo "sanitizer: $preset"
  [[ $preset != fuzz ]] || tools/setup.sh --fuzz
  cmake --preset "$preset"
  cmake --build --preset "$preset"
  ctest --preset "$preset"
done
