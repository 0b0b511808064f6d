# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Loads the compiled part so that it computes as the program does.

The C library, OpenCV and Mesa choose code by the processor, and fused multiply-add rounds otherwise
than multiplication and addition. The program exports its own elementary functions, which the loader
finds before the C library's. Here _arithmetic.so exports them: it is loaded first, with all
libraries that compute for a run, and RTLD_DEEPBIND lets these look in it before the C library.
Python, NumPy and other modules keep their functions. The extension itself is loaded as usual and
has the functions linked in.
"""
import ctypes
import os
import pathlib
import warnings

__all__ = ["core"]

# Libraries that compute for a run. One that was loaded before keeps the C library's functions.
_COMPUTING = ("libopencv_core.", "libmujoco.", "libapriltag.", "libOSMesa.", "libLLVM", "libassimp.",
              "libcholmod.")


def _loaded_before() -> list[str]:
    """Names of our libraries that this process has loaded already."""
    try:
        maps = pathlib.Path("/proc/self/maps").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return []
    fields = (line.split(maxsplit=5) for line in maps.splitlines())
    files = {pathlib.Path(field[5].strip()) for field in fields if len(field) == 6}
    bundled = pathlib.Path(__file__).resolve().parent.with_name("vinebench.libs")
    if bundled.is_dir():  # in a wheel our libraries are no one else's
        return sorted(file.name for file in files if file.parent == bundled)
    return sorted({file.name for file in files if file.name.startswith(_COMPUTING)})


def _load_arithmetic() -> bool:
    """Whether all libraries that compute have the program's elementary functions now."""
    file = pathlib.Path(__file__).with_name("_arithmetic.so")
    if not file.exists():  # another processor architecture, or a build with sanitizers
        return False
    if os.environ.get("LD_PRELOAD"):  # an allocator, say, which would not be found first
        return False
    before = _loaded_before()
    ctypes.CDLL(str(file), mode=os.RTLD_NOW | os.RTLD_LOCAL | os.RTLD_DEEPBIND)
    if before:
        warnings.warn(
            f"{', '.join(before)}: loaded before vinebench, so that runs of this process may not "
            "have the program's hash; import vinebench first", RuntimeWarning, stacklevel=4)
    return not before


_pinned = _load_arithmetic()

import vinebench._core as core  # noqa: E402  (its libraries are loaded now)

core.pin_arithmetic(_pinned)
