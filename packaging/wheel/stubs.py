#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Stands in for libraries that are linked but never called in a wheel.

Usage: stubs.py FOLDER

Writes into FOLDER one shared object for each library in STUBS, of the same name (SONAME), with the
symbols that its users need; each function returns 0, each variable is 0. Bundled in a wheel in place of the real ones
they leave out more than a hundred libraries: GDAL with database clients and video codecs (OpenCV
reads maps with it, on request alone), GDCM (medical images), GLX (OpenCV's windows), Z3 (LLVM's static
analyser) and libxml2 with ICU (LLVM's manifests of Windows programs). EGL finds no display in its stub,
and the program says so: a driver of the system would give other pictures, and its libraries do not
mix with those of the wheel.
"""

import pathlib
import re
import subprocess
import sys

# Library: those that need it; none where all of its functions are.
STUBS = {
    "libgdal.so.32": ["libopencv_imgcodecs.so.406"],
    "libgdcmMSFF.so.3.0": ["libopencv_imgcodecs.so.406"],
    "libgdcmDSED.so.3.0": ["libopencv_imgcodecs.so.406"],
    "libEGL.so.1": [],
    "libGLX.so.0": ["libopencv_core.so.406"],
    "libz3.so.4": ["libLLVM-15.so.1"],
    "libxml2.so.2": ["libLLVM-15.so.1"],
}


def file_of(library):
    """The loader's file of a library."""
    text = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True, check=True).stdout
    match = re.search(rf"^\s*{re.escape(library)} \(libc6,x86-64.*=> (\S+)$", text, re.M)
    if not match:
        sys.exit(f"stubs.py: {library} is not installed")
    return match.group(1)


def symbols(library, kind):
    """{name: (version or "", type of nm, size)} of what a library defines or needs."""
    command = ["nm", "-D", "-S", "--with-symbol-versions", f"--{kind}-only", file_of(library)]
    found = {}
    for line in subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines():
        *numbers, letter, symbol = line.split()
        name, _, version = symbol.partition("@")
        found[name] = (version.lstrip("@"), letter, int(numbers[1], 16) if len(numbers) == 2 else 0)
    return found


def wanted(library, users):
    """{symbol: (version, size of a variable, 0 for a function)} of what the users need of a library."""
    defined = symbols(library, "defined")
    if not users:
        return {name: (version, 0) for name, (version, letter, _) in defined.items() if letter == "T"}
    needed = {}
    for user in users:
        for name, (version, letter, _) in symbols(user, "undefined").items():
            if name in defined and letter != "w":
                needed[name] = (version, defined[name][2] if defined[name][1] in "BDRV" else 0)
    return needed


def assembly(needed):
    lines = []
    for name, (_, size) in sorted(needed.items()):
        if size:
            lines += [".bss", f".globl {name}", ".balign 16", f".type {name}, @object",
                      f".size {name}, {size}", f"{name}:", f".zero {size}"]
        else:
            lines += [".text", f".globl {name}", f".type {name}, @function", f"{name}:", "xorl %eax, %eax", "ret"]
    return "\n".join([*lines, '.section .note.GNU-stack,"",@progbits', ""])


def version_script(needed):
    """Symbols by their versions, as the users' files name them."""
    blocks = {}
    for name, (version, _) in needed.items():
        if version:
            blocks.setdefault(version, []).append(name)
    return "".join(f"{version} {{ global: {'; '.join(names)}; }};\n" for version, names in blocks.items())


def write_stub(folder, library, needed):
    source, script = folder / f"{library}.s", folder / f"{library}.map"
    source.write_text(assembly(needed))
    command = ["gcc", "-shared", "-nostdlib", f"-Wl,-soname,{library}", "-o", folder / library, source]
    versions = version_script(needed)
    if versions:
        script.write_text(versions)
        command.append(f"-Wl,--version-script={script}")
    subprocess.run(command, check=True)
    source.unlink()
    script.unlink(missing_ok=True)


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for library, users in STUBS.items():
        needed = wanted(library, users)
        write_stub(folder, library, needed)
        print(f"{library}: {len(needed)} symbols")
    return 0


if __name__ == "__main__":
    sys.exit(main())
