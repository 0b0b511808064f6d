#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# From a clean clone to a verdict: sets up, builds, and runs the occluded-camera scenario. Further
# arguments go to `vinebench run`. Exits with the run's own code: 0 when its expectations hold.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
tools/setup.sh
[[ -f build/CMakeCache.txt ]] || cmake --preset release
cmake --build build --target vinebench
code=0
build/vinebench run scenarios/occluded-camera.yaml "$@" || code=$?
[[ $code -gt 1 ]] || echo "This is one seed: it shows that the run works, not how much it varies." \
  "--seeds 1..5 also judges the median."
exit $code
