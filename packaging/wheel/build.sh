#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the wheel with the system's Python, and puts the system's libraries into it with their
# licences. Usage: build.sh WHEELS OUT; WHEELS has the tools (requirements.txt), as no registry is
# asked here. tools/packages.sh executes it in a clean Debian 12.
set -euo pipefail
wheels=$1 out=$2
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
export PATH=$work/venv/bin:$PATH CC=cc CXX=c++
pip install -q --no-index --find-links "$wheels" -r packaging/wheel/requirements.txt
pip wheel -q --no-build-isolation --no-deps --no-index -w "$work/raw" .
python packaging/wheel/stubs.py "$work/stubs"
LD_LIBRARY_PATH=$work/stubs auditwheel repair --plat manylinux_2_36_x86_64 -w "$work/repaired" "$work"/raw/*.whl
python packaging/wheel/licences.py "$work"/repaired/*.whl "$out"
