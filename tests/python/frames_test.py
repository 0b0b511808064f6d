# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The Python module against what `vinebench record` writes of the same frames, and against itself."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

import vinebench
from support import PROGRAM, ROOT, draws_as_program, main

SCENARIO = ROOT / "scenarios/quick-loop.yaml"
CAMERAS = ["back_left", "side"]
TRUTH = ["depth", "labels", "instances", "normals", "things", "flow"]


def open_frames(**arguments):
    return vinebench.Scenario(SCENARIO, cameras=CAMERAS, frames=(30, 38), every=4, **arguments)


def message_of(call):
    try:
        call()
    except vinebench.Error as error:
        return str(error)
    return ""


class FramesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = open_frames(truth=TRUTH)
        cls.frames = list(cls.scenario)
        cls.folder = tempfile.TemporaryDirectory()
        cls.recording = pathlib.Path(cls.folder.name) / "recording"
        subprocess.run([PROGRAM, "record", SCENARIO, "--format", "depth32,tum", "--frames", "30..38",
                        "--every", "4", "--cameras", ",".join(CAMERAS), "--out", cls.recording],
                       check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_frames_are_those_asked_for(self):
        self.assertEqual(len(self.scenario), 3)
        self.assertEqual([f.number for f in self.frames], [0, 1, 2])
        self.assertEqual([f.index for f in self.frames], [30, 34, 38])
        for frame in self.frames:
            self.assertEqual(sorted(frame.images), CAMERAS)
            self.assertEqual(frame.images["side"].shape, (1080, 1920, 3))
            self.assertEqual(frame.images["back_left"].dtype, np.uint8)
            self.assertEqual(frame.time, frame.stamp * 1e-9)

    def test_plants_that_cannot_be_kept_are_a_warning(self):
        bare = {"world.vines.templates": 1, "world.vines.bbch": 0}
        with unittest.mock.patch.dict(os.environ, VINEBENCH_CACHE="/proc/none"):
            with self.assertWarnsRegex(RuntimeWarning, "plants are not kept: /proc/none"):
                open_frames(set=bare)

    def test_depth_and_poses_are_the_recorded_ones(self):
        poses = np.loadtxt(self.recording / "tum/body.txt")
        for frame, pose in zip(self.frames, poses, strict=True):
            for camera in CAMERAS:
                file = self.recording / "depth32" / camera / f"{frame.number:06}.npy"
                recorded = np.load(file)
                if draws_as_program():
                    np.testing.assert_array_equal(frame.depth[camera], recorded)
                    continue
                # A step of the depth buffer is 1e-4 of the farthest depths; a few pixels at edges
                # may show what is behind.
                close = np.isclose(frame.depth[camera], recorded, rtol=3e-4, atol=0)
                self.assertGreater(np.mean(close), 0.999)
            # TUM's text has nine digits.
            np.testing.assert_allclose(frame.T_world_body[:3, 3], pose[1:4], rtol=0, atol=1e-8)
            self.assertAlmostEqual(frame.time, pose[0], places=6)

    def test_images_of_an_earlier_frame_stay(self):
        # Three frames of a moving camera, held at once, are three different images.
        first, second, third = (f.images["back_left"] for f in self.frames)
        self.assertFalse(np.array_equal(first, second))
        self.assertFalse(np.array_equal(second, third))
        alone = next(open_frames())
        np.testing.assert_array_equal(alone.images["back_left"], first)

    def test_truth_only_where_it_was_asked_for(self):
        frame = next(open_frames())
        self.assertEqual(frame.depth, {})
        self.assertIn('truth "things"', message_of(lambda: frame.things("side")))

    def test_flow_is_the_motion_of_the_points_of_depth(self):
        before, after = self.frames[:2]
        camera = next(c for c in self.scenario.true_cameras if c.name == "back_left")
        flow, visible = before.flow_to(after, "back_left")
        depth = before.depth["back_left"].astype(float)
        # Static pixels: not the rover, and not the sky, which has no depth.
        still = (depth > 0) & (before.labels["back_left"] != 11) & (visible == 255)
        v, u = np.nonzero(still)
        z = depth[v, u]
        rays = np.linalg.inv(camera.K) @ np.stack([u, v, np.ones_like(u)])
        points = np.vstack([rays * z, np.ones_like(z)])
        T_before = before.T_world_body @ camera.T_body_camera
        T_after = after.T_world_body @ camera.T_body_camera
        moved = camera.K @ (np.linalg.inv(T_after) @ T_before @ points)[:3]
        expected = (moved[:2] / moved[2] - np.stack([u, v])).T
        self.assertGreater(len(z), 10000)
        # px: single-precision depth and flow.
        np.testing.assert_allclose(flow[v, u], expected, rtol=0, atol=0.01)

    def test_things_cover_what_labels_and_instances_say(self):
        frame = self.frames[0]
        for camera in CAMERAS:
            labels = frame.labels[camera]
            covered = np.zeros(labels.shape, int)
            for thing in frame.things(camera):
                self.assertEqual(thing["mask"].dtype, bool)
                rows, columns = np.nonzero(thing["mask"])
                box = (columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1)
                self.assertEqual(thing["box"], box)
                if thing["category"] == "plant":  # includes the pixels of its parts
                    continue
                numbers = frame.instances[camera][thing["mask"]]
                same = numbers if thing["category"] == "bunch" else numbers & ~255
                self.assertTrue((same == thing["number"]).all())
                covered += thing["mask"]
            countable = ["trunk", "cane", "leaf", "bunch", "post", "tag", "box", "rover", "person"]
            names = np.array([vinebench.label_names[i] for i in range(len(vinebench.label_names))])
            np.testing.assert_array_equal(covered, np.isin(names[labels], countable))

    def test_normals_are_unit_and_face_the_camera(self):
        normals = self.frames[0].normals["back_left"]
        solid = self.frames[0].depth["back_left"] > 0
        np.testing.assert_allclose(np.linalg.norm(normals[solid], axis=1), 1, atol=1e-3)

    def test_readings_follow_each_other_without_a_gap(self):
        readings = np.vstack([f.imu for f in self.frames])
        np.testing.assert_allclose(np.diff(readings[:, 0]), 1 / 200, atol=1e-9)  # the rover's 200 Hz
        self.assertAlmostEqual(np.median(readings[:, 6]), 9.81, delta=0.1)       # m/s^2, at rest
        self.assertEqual(self.frames[0].wheels.shape[1], 9)

    def test_threads_change_no_byte(self):
        for one, two in zip(open_frames(threads=1), self.frames):
            np.testing.assert_array_equal(one.images["back_left"], two.images["back_left"])

    def test_settings_reach_the_world(self):
        dark = next(open_frames(set={"world.sun.elevation_deg": 5, "renderer.shadow_map_size": 0}))
        self.assertFalse(np.array_equal(dark.images["side"], self.frames[0].images["side"]))

    def test_bad_requests_are_one_error(self):
        cases = {
            "none.yaml": lambda: vinebench.Scenario("none.yaml"),
            "unknown 'colour'": lambda: open_frames(truth=["colour"]),
            "no camera named 'top'": lambda: vinebench.Scenario(SCENARIO, cameras=["top"]),
            "has no camera named 'top'": lambda: self.frames[0].things("top"),
            "world.sunn": lambda: open_frames(set={"world.sunn": 1}),
            "expected 0 <= first": lambda: vinebench.Scenario(SCENARIO, frames=(5, 2)),
            "a frame and the next one": lambda: self.frames[0].flow_to(self.frames[2], "side"),
        }
        for words, call in cases.items():
            self.assertIn(words, message_of(call))

    def test_the_example_of_the_documentation_runs(self):
        text = (ROOT / "docs/python.md").read_text().split("## Frames")[1]
        code = text.split("```python\n")[1].split("```")[0]
        self.assertLessEqual(len(code.strip().splitlines()), 20)
        done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"frame \d+: bunch \d+, \d+ x \d+ px, \d\.\d\d m away")


if __name__ == "__main__":
    main()
