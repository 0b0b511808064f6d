# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of the Python module have in common.

Usage: X_test.py VINEBENCH ROOT, with the package's folder in PYTHONPATH.
"""
import os
import pathlib
import sys
import tempfile
import unittest

PROGRAM, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])

RIG = """name: pair
rate_hz: 15
cameras:
  - {name: left, width: 376, height: 240, fx: 130, fy: 130, position: [0.15, 0.06, 0.5]}
  - {name: right, width: 376, height: 240, fx: 130, fy: 130, position: [0.15, -0.06, 0.5]}
stereo_pairs:
  - {name: front, left: left, right: right}
"""

WORLD = """name: triangles
ground_size: 8
rows: [{start: [-1, 2], end: [1, 2]}]
vines: {meshes: [vine.obj]}
tags: [{id: 3, position: [0.5, 1.5, 0.5], facing_deg: -90}]
"""

SCENARIO = """name: court
seed: 5
world: world.yaml
rover: {model: %s/models/csl-rover/rover.xml, rig: rig.yaml}
route:
  acceleration: 2
  waypoints: [{position: [0, 0]}, {position: [1, 0]}]
renderer: {engine: fake}
duration: 0.6
expectations: {coverage_min: 1, ate_origin_rmse_max: 0.02}
"""

FRAMES = 10  # of 0.6 s at 15 Hz


def write_court(folder):
    """A scenario of ten frames without OpenGL and plants, whose cameras see enough to be tracked."""
    folder = pathlib.Path(folder)
    (folder / "vine.obj").write_text("v -0.4 0 0\nv 0.4 0 0\nv 0 0 1.5\nf 1 2 3\n")
    (folder / "world.yaml").write_text(WORLD)
    (folder / "rig.yaml").write_text(RIG)
    scenario = folder / "court.yaml"
    scenario.write_text(SCENARIO % ROOT)
    return scenario


class CourtTest(unittest.TestCase):
    """With the court in a folder of its own."""

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.court = write_court(cls.folder)


def draws_as_program():
    """Whether images are the program's to the byte: not by EGL, whose driver looks elsewhere, and not
    in builds that have no arithmetic of their own (sanitizers)."""
    import vinebench
    loaded = pathlib.Path("/proc/self/maps").read_text(errors="replace")
    return (vinebench.arithmetic()["libm"].startswith("vinebench") and "libOSMesa" in loaded
            and os.environ.get("VINEBENCH_GL") != "egl")


def main():
    unittest.main(argv=sys.argv[:1])
