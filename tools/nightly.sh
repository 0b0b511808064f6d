#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# All scenarios in full over the seeds 1 to 5: builds, makes the runs that this build has not made yet
# (they are kept in out/nightly), and writes the table into docs/results.md between its two markers.
# Then the program runs on damaged inputs (docs/robustness.md), others every day; those that end it
# are kept in out/nightly/mutations. Then recordings and runs are killed, and their file operations
# fail, at each operation in turn; tests run with sanitizers (sanitize.sh address thread-long); a
# sweep runs on a cluster of Slurm, where it is installed; and the packages are built and tested
# (packages.sh, where it can: as root with debootstrap). None of these where VINEBENCH names a program.
# Further arguments go to `vinebench run`, e.g. --jobs 4 or --force. Exit code 1 if an expectation fails
# or any of the rest finds something; the table is written in any case.
#   SEEDS=1..5  OUT=out/nightly  RESULTS=docs/results.md  SCENARIOS="scenarios/*.yaml"
#   MUTATIONS=2000  MUTATION_SEED=20260101
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seeds=${SEEDS:-1..5}
out=${OUT:-out/nightly}
results=${RESULTS:-docs/results.md}
mutations=${MUTATIONS:-2000}
mutation_seed=${MUTATION_SEED:-$(date +%Y%m%d)}
read -ra scenarios <<<"${SCENARIOS:-$(echo scenarios/*.yaml)}"
begin='<!-- results -->'
end='<!-- /results -->'

# Checked before hours of runs.
[[ -f $results ]] || { echo "nightly.sh: $results: is no file" >&2; exit 2; }
if [[ $(grep -cFx -- "$begin" "$results") -ne 1 || $(grep -cFx -- "$end" "$results") -ne 1 ]]; then
  echo "nightly.sh: $results: expected one line '$begin' and, after it, one '$end'" >&2
  exit 2
fi

if [[ -z ${VINEBENCH:-} ]]; then
  tools/setup.sh
  cmake --preset release
  cmake --build build --target vinebench fault_shim
  VINEBENCH=build/vinebench
  endings=(build/vinebench build/fault_shim.so .)
fi
mkdir -p "$out"
rm -f "$out/table.md"

code=0
"$VINEBENCH" run "${scenarios[@]}" --seeds "$seeds" --out "$out" --junit "$out/junit.xml" "$@" ||
  code=$?
[[ $code -le 2 && -s $out/table.md ]] || exit "$code" # interrupted: no table

partial=$(mktemp "$results.XXXXXX")
chmod --reference="$results" "$partial"
awk -v begin="$begin" -v end="$end" -v table="$out/table.md" '
  $0 == end { inside = 0 }
  !inside { print }
  $0 == begin { inside = 1; while ((getline line < table) > 0) print line }
' "$results" >"$partial"
mv "$partial" "$results"
echo "nightly.sh: the table is in $results"

if [[ $mutations -gt 0 ]]; then
  offences=0
  ${MUTATE:-python3 tests/tools/mutate.py} "$VINEBENCH" . --cases "$mutations" \
    --seed "$mutation_seed" --keep "$out/mutations" | tee "$out/mutations.md" || offences=1
  [[ $offences -eq 0 || $code -ne 0 ]] || code=1
fi

if [[ -n ${endings:-} ]]; then
  python3 tests/tools/kill_test.py "${endings[@]}" --every 1 --times 100 || code=1
  python3 tests/tools/fault_test.py "${endings[@]}" --every 1 || code=1
  tools/sanitize.sh address thread-long || code=1
  tests/tools/cluster/slurm_test.sh build/vinebench . || [[ $? -eq 77 ]] || code=1
  if command -v debootstrap >/dev/null && unshare --mount true 2>/dev/null; then
    tools/packages.sh || code=1
  else
    echo "nightly.sh: no packages: they need debootstrap, and root that may mount"
  fi
fi
exit "$code"
