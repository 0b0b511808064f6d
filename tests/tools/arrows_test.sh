#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Allowed includes: tools and python -> harness -> sim and slam -> core. Usage: arrows_test.sh ROOT
set -euo pipefail
cd "$1"
failed=0

# forbid WHO PATTERN: no source of folder WHO includes what matches PATTERN.
forbid() {
  local sources
  mapfile -t sources < <(find "$1" -name '*.h' -o -name '*.cpp' | sort)
  if [[ ${#sources[@]} -eq 0 ]]; then
    echo "arrows: $1 has no sources"
    failed=1
  elif grep -HnP "^\\s*#\\s*include\\s*[\"<]$2" "${sources[@]}"; then
    echo "arrows: $1 must not include the above"
    failed=1
  fi
}

forbid core '(slam/|sim/|harness/|tools/|python/|tests/)'
forbid slam '(sim/|harness/|tools/|python/|tests/|mujoco)'
forbid sim '(slam/|harness/|tools/|python/|tests/|ceres)'
forbid harness '(tools/|python/|tests/)'
forbid python '(tools/|tests/)'
forbid tools '(python/|tests/)'
# Relative includes would pass unseen.
for folder in core slam sim harness tools python; do forbid "$folder" '\.\.?/'; done
exit $failed
