#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the documents as a site in out/site, with MkDocs in an environment of its own (from PyPI,
# versions in docs/requirements.txt; needs python3-venv on Debian). `tools/docs.sh serve` shows it at
# localhost while it is edited. PYTHON names another Python, VINEBENCH the program that the reference of
# keys and commands is made from (build/vinebench; it must be of this source).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
vinebench=${VINEBENCH:-build/vinebench}
if [[ ! -x $vinebench ]]; then
  echo "docs.sh: $vinebench: expected the program, for the reference: build it, or name it as VINEBENCH" >&2
  exit 2
fi
environment=${VINEBENCH_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/vinebench}/docs
wanted=$(sha256sum docs/requirements.txt)
if [[ $(cat "$environment/made-for" 2>/dev/null) != "$wanted" ]]; then
  rm -rf "$environment"
  "${PYTHON:-python3}" -m venv "$environment"
  "$environment/bin/pip" install --quiet --disable-pip-version-check -r docs/requirements.txt
  echo "$wanted" >"$environment/made-for"
fi
"$environment/bin/python" tools/reference.py "$vinebench" . docs/reference
case ${1:-build} in
  build) exec env NO_MKDOCS_2_WARNING=1 "$environment/bin/mkdocs" build --strict --quiet ;;
  serve) exec "$environment/bin/mkdocs" serve ;;
  *)
    echo "docs.sh: $1: expected build or serve" >&2
    exit 2
    ;;
esac
