# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What vinebench.rerun reads and computes, and its errors; without the SDK of Rerun."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from made_run import CLOUD, STAMPS, write_recording, write_run
from support import main

import vinebench as vb
from vinebench._point_cloud import read_cloud
from vinebench._rerun_pictures import View, pictures_of_recording, scaled, site_views
from vinebench._rerun_scene import alignment, position_errors
from vinebench._run_folder import Path, nearest, read_run, read_timeline

T_WORLD_MAP = np.array([[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1.0]])


class MadeRunTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.run_folder = write_run(self.folder / "run")


class ReadingTest(MadeRunTest):
    def test_the_timeline(self):
        timeline = read_timeline(self.run_folder / "timeline.csv")
        self.assertEqual(timeline.stamps.tolist(), list(STAMPS))
        self.assertEqual(timeline.status, ["tracked", "tracked", "lost", "tracked"])
        np.testing.assert_array_equal(timeline.covariance[0], np.diag([1e-6, 4e-6, 9e-6]))
        self.assertTrue(np.isnan(timeline.covariance[2]).all())
        np.testing.assert_array_equal(timeline.counts["inliers"]["left"], [200, 210, np.nan, 230])
        # Before the first frame, at and between frames, after the last one.
        at = np.array([-1, 66666667, 100000000, 10**9], np.int64)
        self.assertEqual(timeline.frames_at(at).tolist(), [0, 1, 1, 3])

    def test_pairs_are_nearest_and_at_most_10_ms_apart(self):
        stamps = np.array([0, 10**8, 2 * 10**8], np.int64)
        wanted = np.array([-2 * 10**7, 6 * 10**6, 10**8 + 10**7, 10**8 + 10**7 + 1], np.int64)
        self.assertEqual([pair.tolist() for pair in nearest(stamps, wanted)], [[1, 2], [0, 1]])
        self.assertEqual([pair.tolist() for pair in nearest(stamps[:1], wanted[:2])], [[1], [0]])
        self.assertEqual(len(nearest(stamps[:0], wanted)[0]), 0)

    def test_the_map_is_placed_by_the_first_pose(self):
        run = read_run(self.run_folder)
        np.testing.assert_allclose(alignment(run.truth, run.estimate, "first"), T_WORLD_MAP,
                                   rtol=0, atol=1e-8)  # m; files have nine decimals
        # By the second pose too, which is not the map's origin: up to there there is no error.
        later = Path(run.estimate.stamps[1:], run.estimate.rows[1:])
        np.testing.assert_allclose(alignment(run.truth, later, "first"), T_WORLD_MAP, rtol=0,
                                   atol=1e-8)
        np.testing.assert_array_equal(alignment(run.truth, run.estimate, "none"), np.eye(4))
        stamps, errors = position_errors(run.truth, run.live, T_WORLD_MAP)
        self.assertEqual(stamps.tolist(), [STAMPS[0], STAMPS[1], STAMPS[3]])
        np.testing.assert_allclose(errors, [0, 0, 0.02], rtol=0, atol=1e-8)

    def test_by_all_poses_the_errors_are_smaller(self):
        run = read_run(self.run_folder)
        T_world_map = alignment(run.truth, run.estimate, "all")
        errors = position_errors(run.truth, run.estimate, T_world_map)[1]
        self.assertAlmostEqual(np.sqrt(np.mean(errors**2)),
                               vb.evaluate(run.truth.rows, run.estimate.rows).ate.rmse, delta=1e-9)
        self.assertLess(errors.max(), 0.01)

    def test_a_smaller_image_has_its_principal_point_at_the_same_place(self):
        view = View("left", 376, 240, np.array([[130, 0, 187.5], [0, 130, 119.5], [0, 0, 1]]),
                    np.eye(4))
        half = scaled(view, 120)
        self.assertEqual((half.width, half.height), (188, 120))
        # Its middle: (188 - 1) / 2 and (120 - 1) / 2.
        np.testing.assert_allclose(half.K, [[65, 0, 93.5], [0, 65, 59.5], [0, 0, 1]], atol=1e-12)
        self.assertIs(scaled(view, 240), view)

    def test_the_cameras_of_the_site_are_those_of_the_rig(self):
        run = read_run(self.run_folder)
        recorded = pictures_of_recording(write_recording(self.folder / "data"), run)
        self.assertEqual(recorded.imu.shape, (41, 7))
        for mine, theirs in zip(site_views(run), recorded.views, strict=True):
            self.assertEqual((mine.name, mine.width, mine.height),
                             (theirs.name, theirs.width, theirs.height))
            np.testing.assert_allclose(mine.K, theirs.K, atol=1e-12)
            np.testing.assert_allclose(mine.T_body_camera, theirs.T_body_camera, atol=1e-12)

    def test_clouds_as_text_and_in_either_byte_order(self):
        expected = [[1, 0.5, 0.25], [-90, 0, 0]]
        header = CLOUD[:CLOUD.index("end_header")] + "end_header\n"
        for name, order in (("little", "<"), ("big", ">")):
            vertices = np.array([(*point, 10, 20, 30) for point in expected], np.dtype(
                [(axis, order + "f4") for axis in "xyz"] + [(c, "u1") for c in "rgb"]))
            file = self.folder / f"{name}.ply"
            file.write_bytes(header.replace("ascii", f"binary_{name}_endian").encode()
                             + vertices.tobytes())
            cloud = read_cloud(file)
            np.testing.assert_array_equal(cloud.points, expected)
            np.testing.assert_array_equal(cloud.colours[1], [10, 20, 30])
        text = read_cloud(self.run_folder / "landmarks.ply")
        np.testing.assert_array_equal(text.points, expected)
        np.testing.assert_array_equal(text.colours, [[10, 20, 30], [40, 50, 60]])


class CommandTest(MadeRunTest):
    def refused(self, words, *arguments):
        """One line on standard error, exit code 2, and no file."""
        code = ("import sys\nsys.modules['rerun'] = None\nfrom vinebench.rerun import main\n"
                "sys.exit(main(sys.argv[1:]))")
        out = self.folder / "run.rrd"
        done = subprocess.run([sys.executable, "-c", code, self.run_folder, "--out", out,
                               *map(str, arguments)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertRegex(done.stderr, rf"^vinebench.rerun: {words}")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertFalse(out.exists())

    def test_without_rerun_it_says_what_to_install(self):
        self.refused(r"rerun cannot be imported \(.*\): install python/rerun-requirements.txt")

    def test_a_folder_that_is_no_run(self):
        (self.run_folder / "timeline.csv").unlink()
        self.refused(".*run: expected the results folder of a run, with timeline.csv")

    def damaged(self, name, old, new, words):
        file = self.run_folder / name
        text = file.read_text()
        self.assertIn(old, text)
        file.write_text(text.replace(old, new, 1))
        self.refused(rf".*{name}{words}")
        file.write_text(text)

    def test_damaged_files_are_named_with_the_line(self):
        self.damaged("timeline.csv", "200,0,0,0", "200", ":2: expected 16 columns, found 13")
        self.damaged("timeline.csv", "910", "many", ":3: expected a number, found 'many'")
        self.damaged("timeline.csv", "0.066666667", "0", ":3: expected ascending times")
        self.damaged("timeline.csv", "keyframe", "key", ":1: expected the columns t, frame")
        self.damaged("timeline.csv", "lost", '"lost', ":")
        self.damaged("estimate.tum", "0.066666667", "x", ":2: ")
        self.damaged("events.jsonl", '"lost"', '"lost', ":2: not valid JSON")
        self.damaged("events.jsonl", '"event": "lost"', '"kind": 1', ":2: expected an event")
        self.damaged("events.jsonl", '"t": 0.2', '"t": NaN', ":3: expected an event")
        self.damaged("timeline.csv", "0.200000000,3", "0.200000000,1e30", ":5: expected ascending")
        self.damaged("site.json", '376', '0', ": cameras: .*a number out of range")
        self.damaged("site.json", '"fx"', '"f"', ": cameras: expected name, width, height, fx")
        self.damaged("site.json", "{", "[", ": not valid JSON")
        self.damaged("metrics.json", "{", "3 #", ": not valid JSON")
        self.damaged("landmarks.ply", "vertex 2", "vertex 3", ": not a point cloud in PLY format")
        self.damaged("landmarks.ply", "float z", "float w", ": not a point cloud in PLY format")

    def test_what_is_asked_for_is_not_there(self):
        self.refused(".*none.ply: No such file", "--cloud", self.folder / "none.ply")
        self.refused("--cameras: expected some of left, right, found 'top'", "--cameras", "left,top")
        self.refused(".*: expected a recording in EuRoC format", "--recording", self.folder)

    def test_the_recording_of_another_run(self):
        data = write_recording(self.folder / "data")
        truth = data / "euroc/mav0/state_groundtruth_estimate0/data.csv"
        text = truth.read_text()
        truth.write_text(text.replace(",2.5,", ",2.6,"))
        self.refused(".*: the recording of another run than .* differ by up to 0.1 m", "--recording", data)
        truth.write_text(text.replace(",2.5,", ",2.5.1,"))
        self.refused(r".*data.csv:3: expected numbers", "--recording", data)
        for camera in data.glob("euroc/mav0/cam*/data.csv"):
            camera.write_text("900000000,a.png\n")
        self.refused(".*: no image has the time of a frame", "--recording", data)


if __name__ == "__main__":
    main()
