#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Everything that must hold before a change is merged: sets up, builds (with warnings as errors where
# CI is set), checks the format, runs all tests, and where CI is set a replay with a build without the
# simulation, and fuzzers and tests with sanitizers (sanitize.sh). The outcome is in build/junit.xml
# too. Further arguments go to ctest, e.g. -L unit.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
tools/setup.sh ${CI:+--ros --browser --fuzz}
if [[ -n ${CI:-} ]]; then cmake --preset ci; else cmake --preset release; fi
cmake --build build
echo "checking the format"
git ls-files -z --cached --others --exclude-standard '*.h' '*.cpp' |
  xargs -0 clang-format --dry-run -Werror
ctest --test-dir build --output-on-failure --no-tests=error -j "$(nproc)" \
  --output-junit "$root/build/junit.xml" "$@"
# A suite that skips a test passes.
grep -ho '^\[  SKIPPED \] [A-Za-z0-9_/.]*$' build/Testing/Temporary/LastTest.log | sort -u || true
[[ -n ${CI:-} ]] || exit 0
echo "without the simulation"
cmake --preset no-sim
cmake --build --preset no-sim --target vinebench wall_recording
ctest --preset no-sim -R '^no_sim$' --no-tests=error
tools/sanitize.sh
