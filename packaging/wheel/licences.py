#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Puts the licences of the Debian packages whose libraries are in a wheel into it.

Usage: licences.py WHEEL FOLDER

Writes the wheel into FOLDER, with PACKAGE.copyright of each in vinebench-*.dist-info/licenses/.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from stubs import STUBS


def package_of(library):
    """Debian's package of a library, by its name in a wheel: auditwheel adds a part of its hash."""
    name = re.sub(r"-[0-9a-f]{8}(?=\.so)", "", library)
    if name in STUBS:
        return None
    run = subprocess.run(["dpkg", "-S", f"*/{name}"], capture_output=True, text=True)
    match = re.match(r"([^:,\s]+)", run.stdout)
    if not match:
        sys.exit(f"licences.py: {library}: of no package")
    return match.group(1)


def main():
    wheel, folder = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([sys.executable, "-m", "wheel", "unpack", "-d", work, wheel], check=True,
                       stdout=subprocess.DEVNULL)
        (content,) = pathlib.Path(work).iterdir()
        (info,) = content.glob("*.dist-info")
        (info / "licenses").mkdir(exist_ok=True)
        packages = {package_of(file.name) for file in (content / "vinebench.libs").iterdir()} - {None}
        packages.add("libjs-three")
        for package in sorted(packages):
            shutil.copy(f"/usr/share/doc/{package}/copyright", info / "licenses" / f"{package}.copyright")
        subprocess.run([sys.executable, "-m", "wheel", "pack", "-d", folder, content], check=True,
                       stdout=subprocess.DEVNULL)
    print(f"licences of {len(packages)} packages")
    return 0


if __name__ == "__main__":
    sys.exit(main())
