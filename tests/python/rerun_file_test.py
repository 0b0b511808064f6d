# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Files of `python -m vinebench.rerun`, read back with the SDK of Rerun. Skipped where that is not
installed (python/rerun-requirements.txt), or is one that does not read files as tables."""
import io
import json
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from made_run import SITE, STAMPS, STEP, write_recording, write_run
from support import main

import vinebench.rerun as command

try:
    import rerun
    from PIL import Image
    from rerun import dataframe
except ImportError as error:
    print(f"rerun-sdk 0.23 is not installed ({error}): skipped")
    sys.exit(77)

BODY = "/world/truth/body"


def write_image(file):
    """A ramp from left to right, of the rig's size."""
    ramp = np.tile(np.linspace(0, 255, 376).astype(np.uint8), (240, 1))
    Image.fromarray(ramp).save(file)


class RerunFileTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.made = write_run(cls.folder / "run")
        cls.data = write_recording(cls.folder / "data", write_image)
        cls.whole = cls.write("whole", "--recording", cls.data)

    @classmethod
    def write(cls, name, *arguments):
        out = cls.folder / f"{name}.rrd"
        done = subprocess.run([sys.executable, "-m", "vinebench.rerun", cls.made, "--out", out,
                               *map(str, arguments)], capture_output=True, text=True)
        if done.returncode or done.stderr:
            raise AssertionError(done.stdout + done.stderr)
        return dataframe.load_recording(str(out))

    def column(self, recording, entity, component, index="time"):
        """Times (ns or frames) and values of a component, row by row."""
        table = recording.view(index=index, contents=entity).select().read_all()
        times = table.column(index).cast("int64").to_pylist()
        values = table.column(f"{entity}:{component}").to_pylist()
        return zip(*[(t, v) for t, v in zip(times, values, strict=True) if v is not None], strict=True)

    def static(self, recording, entity, component):
        table = recording.view(index="time", contents=entity).select_static().read_all()
        return table.column(f"{entity}:{component}").to_pylist()[0]

    def test_it_has_the_entities(self):
        found = {str(column.entity_path) for column in self.whole.schema().component_columns()}
        expected = {"/events", "/summary", BODY, f"{BODY}/left", f"{BODY}/right", "/world/truth/path",
                    "/world/map", "/world/map/estimate/body", "/world/map/estimate/path",
                    "/world/map/keyframes", "/world/map/landmarks", "/world/map/far_landmarks",
                    "/world/map/loops", "/world/live_map", "/world/live_map/body",
                    "/world/live_map/path", "/world/live_map/covariance", "/world/tags",
                    "/world/posts", "/world/rows", "/world/objects", "/imu/rate_z", "/imu/force_z",
                    "/plots/error_mm/corrected", "/plots/error_mm/live", "/plots/drift_percent/live",
                    "/plots/sigma_mm/live", "/plots/status/status", "/plots/inliers/left",
                    "/plots/features/right", "/plots/occluded/left"}
        self.assertEqual(expected - found, set())
        self.assertEqual({column.name for column in self.whole.schema().index_columns()},
                         {"time", "frame"})

    def test_poses_are_those_of_the_files(self):
        times, positions = self.column(self.whole, BODY, "Translation3D")
        self.assertEqual(times, STAMPS)
        np.testing.assert_allclose([p[0] for p in positions],
                                   [[1, 2 + STEP * k, 0] for k in range(4)], atol=1e-6)
        rotation = list(self.column(self.whole, BODY, "RotationQuat"))[1][3][0]
        np.testing.assert_allclose(rotation, [0, 0, 0.5**0.5, 0.5**0.5], atol=1e-6)
        frames, positions = self.column(self.whole, "/world/live_map/body", "Translation3D", "frame")
        self.assertEqual(frames, (0, 1, 3))
        np.testing.assert_allclose(positions[2][0], [1.5, 0.02, 0], atol=1e-6)  # in the map
        np.testing.assert_allclose(self.static(self.whole, "/world/map", "Translation3D")[0],
                                   [1, 2, 0], atol=1e-6)

    # The corrected estimate is 10 mm off, the live one 20 mm, after 1.5 m.
    def test_errors_and_drift(self):
        errors = list(self.column(self.whole, "/plots/error_mm/corrected", "Scalar"))[1]
        np.testing.assert_allclose([e[0] for e in errors], [0, 0, 0, 10], atol=1e-4)
        frames, drift = self.column(self.whole, "/plots/drift_percent/live", "Scalar", "frame")
        self.assertEqual(frames, (3,))
        self.assertAlmostEqual(drift[0][0], 100 * 0.02 / 1.5, delta=1e-4)

    def test_counts_and_status_leave_out_what_is_unknown(self):
        frames, inliers = self.column(self.whole, "/plots/inliers/left", "Scalar", "frame")
        self.assertEqual((frames, [i[0] for i in inliers]), ((0, 1, 3), [200, 210, 230]))
        status = list(self.column(self.whole, "/plots/status/status", "Scalar"))[1]
        self.assertEqual([s[0] for s in status], [3, 3, 0, 3])
        sigmas = list(self.column(self.whole, "/plots/sigma_mm/live", "Scalar"))[1]
        np.testing.assert_allclose([s[0] for s in sigmas], [3, 3, 3], rtol=1e-9)

    # 9 mm may be ten times as large before it passes 0.1 m.
    def test_ellipsoids_of_three_standard_deviations_ten_times_as_large(self):
        half_sizes = list(self.column(self.whole, "/world/live_map/covariance", "HalfSize3D"))[1]
        self.assertEqual(len(half_sizes), 3)
        np.testing.assert_allclose(half_sizes[0][0], [0.03, 0.06, 0.09], rtol=1e-6)
        self.assertIn("enlarged 10 times", self.static(self.whole, "/summary", "Text")[0])

    def image(self, content):
        return Image.open(io.BytesIO(np.array(content[0], np.uint8).tobytes()))

    def test_images_and_their_camera(self):
        frames, blobs = self.column(self.whole, f"{BODY}/left", "Blob", "frame")
        self.assertEqual(frames, (0, 1, 2, 3))
        image = self.image(blobs[3])
        self.assertEqual((image.size, image.mode, image.format), ((376, 240), "L", "JPEG"))
        self.assertAlmostEqual(image.getpixel((188, 100)), 127, delta=3)  # of JPEG
        self.assertEqual(next(iter(self.column(self.whole, f"{BODY}/right", "Blob", "frame"))),
                         (0, 1, 3))
        # Column by column; the principal point is half a pixel further than ours.
        matrix = self.static(self.whole, f"{BODY}/left", "PinholeProjection")[0]
        np.testing.assert_allclose(matrix, [130, 0, 0, 0, 130, 0, 188, 120, 1], atol=1e-4)
        np.testing.assert_allclose(self.static(self.whole, f"{BODY}/left", "Translation3D")[0],
                                   [0.15, 0.06, 0.5], atol=1e-6)

    def test_fewer_and_smaller_images(self):
        small = self.write("small", "--recording", self.data, "--every", 2, "--height", 120,
                           "--cameras", "left")
        frames, blobs = self.column(small, f"{BODY}/left", "Blob", "frame")
        self.assertEqual(frames, (0, 2))
        self.assertEqual(self.image(blobs[0]).size, (188, 120))
        np.testing.assert_allclose(self.static(small, f"{BODY}/left", "PinholeProjection")[0],
                                   [65, 0, 0, 0, 65, 0, 94, 60, 1], atol=1e-4)
        paths = {str(column.entity_path) for column in small.schema().component_columns()}
        self.assertNotIn(f"{BODY}/right", paths)

    def test_events_as_texts(self):
        frames, texts = self.column(self.whole, "/events", "Text", "frame")
        self.assertEqual(frames, (0, 2, 3))
        self.assertEqual(texts[1][0], "lost: dead_reckoning False")
        levels = list(self.column(self.whole, "/events", "TextLogLevel"))[1]
        self.assertEqual([level[0] for level in levels], ["INFO", "WARN", "ERROR"])

    def test_a_run_alone_has_the_pictures_that_it_kept(self):
        frames = self.made / "frames"
        frames.mkdir(exist_ok=True)
        write_image(frames / "000003_left.png")
        found, blobs = self.column(self.write("alone"), f"{BODY}/left", "Blob", "frame")
        self.assertEqual((found, self.image(blobs[0]).size), ((3,), (376, 240)))

    def test_a_film_is_taken_apart(self):
        film = self.made / "film"
        film.mkdir()
        strip = Image.new("RGB", (188, 60))
        strip.paste((250, 250, 250), (94, 0, 188, 60))
        strip.save(film / "000001.jpg")
        (film / "film.json").write_text(json.dumps({
            "width": 188, "height": 60, "pictures": [{"frame": 1, "features": [], "tags": []}],
            "cells": [{"camera": "left", "x": 0, "width": 94},
                      {"camera": "right", "x": 94, "width": 94}]}))
        recording = self.write("film")
        (film / "film.json").unlink()
        frames, blobs = self.column(recording, f"{BODY}/right", "Blob", "frame")
        image = self.image(blobs[0]).convert("L")
        self.assertEqual((frames, image.size), ((1,), (94, 60)))
        self.assertGreater(image.getpixel((47, 30)), 240)

    def test_without_truth_the_cameras_are_on_the_estimate(self):
        truth = self.made / "groundtruth.tum"
        text = truth.read_text()
        truth.unlink()
        recording = self.write("untrue", "--recording", self.data)
        truth.write_text(text)
        paths = {str(column.entity_path) for column in recording.schema().component_columns()}
        self.assertIn("/world/map/estimate/body/left", paths)
        self.assertNotIn(BODY, paths)
        self.assertNotIn("/plots/error_mm/live", paths)

    def test_the_viewer_reads_it(self):
        done = subprocess.run([sys.executable, "-m", "rerun", "rrd", "verify",
                               self.folder / "whole.rrd"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def refused(self, words, *arguments, most=resource.RLIM_INFINITY):
        """`most` bytes fit on the disk."""
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))

        out = self.folder / "refused.rrd"
        done = subprocess.run([sys.executable, "-m", "vinebench.rerun", self.made, "--out", out,
                               *map(str, arguments)], capture_output=True, text=True,
                              preexec_fn=limit)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertRegex(done.stderr, rf"^vinebench.rerun: {words}")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual([file for file in self.folder.iterdir() if "refused" in file.name], [])

    def test_a_full_disk_and_bad_input_leave_no_file(self):
        self.refused(".*refused.rrd: cannot be written \\(File too large\\)", most=20000)
        broken = write_recording(self.folder / "broken", lambda file: file.write_bytes(b"PNG"))
        self.refused(".*000.png: not an image", "--recording", broken)
        site = self.made / "site.json"
        site.write_text(json.dumps({**SITE, "tags": [{"id": 3}]}))
        try:
            self.refused(".*site.json: not as vinebench writes it")
        finally:
            site.write_text(json.dumps(SITE))

    def test_a_package_of_the_same_name_is_told(self):
        scalars = rerun.Scalars
        del rerun.Scalars
        try:
            with self.assertRaisesRegex(command.core.Error, "rerun is not rerun-sdk 0.23 or newer"):
                command.load_sdk()
        finally:
            rerun.Scalars = scalars


if __name__ == "__main__":
    main()
