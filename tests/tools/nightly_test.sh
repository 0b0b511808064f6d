#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# tools/nightly.sh with a fake vinebench program. Usage: nightly_test.sh ROOT
set -uo pipefail
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
check() { # check NAME COMMAND...
  if ! "${@:2}"; then
    echo "FAILED: $1"
    failures=$((failures + 1))
  fi
}

# Writes a table as `vinebench run` does, records its arguments and exits with $CODE.
cat >"$work/fake" <<'END'
#!/usr/bin/env bash
printf '%s\n' "$@" >"$OUT/arguments"
[[ $CODE -le 2 ]] && printf '| new |\n| &\\1 |\n' >"$OUT/table.md"
exit "$CODE"
END
# Records the arguments of the damaged inputs and exits with $OFFENCES.
cat >"$work/mutate" <<'END'
#!/usr/bin/env bash
printf '%s\n' "$@" >"$OUT/mutate-arguments"
echo "| inputs |"
exit "${OFFENCES:-0}"
END
chmod +x "$work/fake" "$work/mutate"

# nightly CODE ARGUMENTS...: its exit code is in $got.
nightly() {
  env CODE="$1" VINEBENCH="$work/fake" MUTATE="$work/mutate" MUTATION_SEED=7 OUT="$work/out" RESULTS="$work/results.md" \
    "$root/tools/nightly.sh" "${@:2}" >"$work/messages" 2>&1
  got=$?
}

check "a missing file is an error" test "$(nightly 0; echo $got)" -eq 2
printf '%s\n' "# Results" "<!-- results -->" "| old |" "<!-- /results -->" "the end" \
  >"$work/results.md"
printf '%s\n' "# Results" "<!-- results -->" "| new |" '| &\1 |' "<!-- /results -->" "the end" \
  >"$work/expected.md"

cp "$work/results.md" "$work/before.md"
nightly 130
check "an interruption's exit code" test $got -eq 130
check "an interruption leaves the table" cmp "$work/results.md" "$work/before.md"

nightly 1 --jobs 3
check "the exit code of a failed expectation" test $got -eq 1
check "the table between the markers" cmp "$work/results.md" "$work/expected.md"
nightly 0
check "the exit code of a good night" test $got -eq 0
check "the same table again" cmp "$work/results.md" "$work/expected.md"
for argument in scenarios/quick-loop.yaml 1..5 "$work/out/junit.xml"; do
  check "the argument $argument" grep -qFx -- "$argument" "$work/out/arguments"
done

for argument in --cases 2000 --seed 7 "$work/out/mutations"; do
  check "the argument $argument of the damaged inputs" \
    grep -qFx -- "$argument" "$work/out/mutate-arguments"
done
check "the counts of the damaged inputs" grep -qFx "| inputs |" "$work/out/mutations.md"
OFFENCES=1 nightly 0
check "a damaged input that ends the program fails the night" test $got -eq 1
rm "$work/out/mutate-arguments"
MUTATIONS=0 nightly 0
check "no damaged inputs where none are asked for" test ! -e "$work/out/mutate-arguments"

sed -i '/^<!-- .results -->/d' "$work/results.md"
nightly 0
check "a missing marker is an error" test $got -eq 2
check "a missing marker is named" grep -qF "expected one line" "$work/messages"
exit $((failures > 0))
