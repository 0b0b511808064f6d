# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Trajectories and their evaluation, against the program's."""
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import vinebench as vb
from support import PROGRAM, main


def straight(poses=61, metres=3.0):
    """Along x, looking along x, at 15 Hz."""
    rows = np.zeros((poses, 8))
    rows[:, 0] = np.arange(poses) / 15
    rows[:, 1] = np.linspace(0, metres, poses)
    rows[:, 7] = 1
    return rows


class EvaluationTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    # Every other position is 1 cm to the left. The alignment takes the mean of 5 mm away, so that
    # each is 5 mm off (a poses' worth less, for 61 is odd); aligned by the first, every other one
    # is 1 cm off.
    def test_errors_are_those_that_were_made(self):
        truth, estimate = straight(), straight()
        estimate[1::2, 2] += 0.01
        evaluation = vb.evaluate(truth, estimate)
        self.assertEqual(evaluation.poses, 61)
        self.assertAlmostEqual(evaluation.ate.rmse, 0.005, delta=2e-6)
        self.assertAlmostEqual(evaluation.ate_origin.max, 0.01, places=12)
        self.assertAlmostEqual(evaluation.ate_origin.rmse, 0.01 * np.sqrt(30 / 61), places=12)
        self.assertAlmostEqual(evaluation.worst_time_s, 1 / 15, places=9)
        self.assertEqual(evaluation.heading_max_deg, 0)
        # A metre is 20 steps of 5 cm: both ends of 41 segments are off alike. One more, which the
        # path's end makes 19 steps long, is 1 cm off.
        self.assertAlmostEqual(evaluation.rpe_trans_percent, 100 * 0.01 / 42, places=9)

    def test_another_map_frame_is_aligned(self):
        truth = straight()
        truth[:, 2] = 0.1 * truth[:, 1]**2
        estimate = truth.copy()
        estimate[:, 1], estimate[:, 2] = 5 - truth[:, 2], 7 + truth[:, 1]  # a quarter to the left
        estimate[:, 6:] = np.sqrt(0.5)
        evaluation = vb.evaluate(truth, estimate)
        self.assertLess(evaluation.ate.max, 1e-12)
        np.testing.assert_allclose(evaluation.T_world_map @ [5, 7, 0, 1], [0, 0, 0, 1], atol=1e-12)

    def test_arrays_files_and_the_program_agree(self):
        random = np.random.default_rng(1)
        truth, estimate = straight(), straight()
        estimate[:, 1:4] += random.normal(0, 0.01, (61, 3))
        files = self.folder / "truth.tum", self.folder / "estimate.tum"
        vb.write_tum(files[0], truth)
        vb.write_tum(files[1], estimate)
        by_files = vb.evaluate(*files)
        by_arrays = vb.evaluate(vb.read_tum(files[0]), vb.read_tum(str(files[1])))
        self.assertEqual(by_files.ate, by_arrays.ate)
        lines = subprocess.run([PROGRAM, "eval", *files], capture_output=True, text=True).stdout
        told = {key: float(value) for key, value in map(str.split, lines.splitlines())}
        for value, name in ((by_files.ate.rmse, "ate_rmse_m"), (by_files.ate.mean, "ate_mean_m"),
                            (by_files.ate.median, "ate_median_m"), (by_files.ate.max, "ate_max_m"),
                            (by_files.ate_origin.rmse, "ate_origin_rmse_m"),
                            (by_files.rpe_trans_percent, "rpe_trans_percent")):
            self.assertAlmostEqual(value, told[name], delta=5.1e-10)  # nine decimals

    def test_matrices_are_those_of_the_quaternions(self):
        rows = straight(2)
        rows[1, 4:] = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]  # a quarter to the left about z
        matrices = vb.to_matrices(rows)
        np.testing.assert_array_equal(matrices[0], np.eye(4))
        np.testing.assert_allclose(matrices[1] @ [1, 0, 0, 1], [3, 1, 0, 1], atol=1e-15)

    # The four branches of the conversion, by rotations near half a turn about each axis.
    def test_rows_and_matrices_are_inverse(self):
        from vinebench.trajectories import row_of
        random = np.random.default_rng(2)
        quaternions = np.vstack([np.eye(4), random.normal(size=(40, 4))])
        quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
        for q in quaternions:
            row = np.array([[2.5, 1, 2, 3, *q]])
            back = row_of(2_500_000_000, vb.to_matrices(row)[0])
            np.testing.assert_allclose(back[:4], row[0, :4])
            self.assertAlmostEqual(abs(back[4:] @ q), 1, places=12)  # q and -q are one rotation

    def test_bad_trajectories_are_named(self):
        good = straight()
        backwards, long = good.copy(), good.copy()
        backwards[5, 0] = 0
        long[5, 7] = 2
        cases = [
            (ValueError, r"truth: expected shape \(n, 8\), found \(61, 7\)",
             lambda: vb.evaluate(good[:, :7], good)),
            (ValueError, "estimate: expected ascending stamps", lambda: vb.evaluate(good, backwards)),
            (ValueError, "row 5: expected a quaternion of unit", lambda: vb.evaluate(good, long)),
            (TypeError, "expected an array", lambda: vb.evaluate(good, 3)),
            (TypeError, "found dtype", lambda: vb.evaluate(good, good.astype(str))),
            (vb.Error, "nowhere.tum: cannot be read", lambda: vb.evaluate(good, "nowhere.tum")),
            (vb.Error, "fewer than three", lambda: vb.evaluate(good, good[:2])),
            (ValueError, "expected finite", lambda: vb.evaluate(good, good * np.nan)),
        ]
        for kind, words, call in cases:
            with self.assertRaisesRegex(kind, words):
                call()


if __name__ == "__main__":
    main()
