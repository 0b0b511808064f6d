# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
#
# Sourced by tests of commands: $vinebench runs, its output is in stdout and stderr of the working folder.
failures=0

report() {
  echo "FAILED: $1"
  sed 's/^/    /' stdout stderr
  failures=$((failures + 1))
}

# expect CODE NAME WORDS -- ARGUMENTS...: exit code, and words on stderr (on stdout for other than 2),
# which has one message of the program at most.
expect() {
  local code=$1 name=$2 words=$3
  shift 4
  "$vinebench" "$@" >stdout 2>stderr </dev/null
  local got=$?
  [[ $got -eq $code ]] || report "$name: exit code $got, expected $code"
  local where=stdout
  [[ $code -eq 2 ]] && where=stderr
  grep -qF -- "$words" "$where" || report "$name: $where lacks '$words'"
  [[ $(grep -c '^vinebench: ' stderr) -le 1 ]] || report "$name: more than one message"
}
