# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Runs in Python against runs of the program."""
import json
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np

import vinebench as vb
from support import FRAMES, PROGRAM, CourtTest, draws_as_program, main


class RunTest(CourtTest):
    def program_run(self, scenario, *options):
        out = self.folder / "program"
        subprocess.run([PROGRAM, "run", scenario, "--out", out, *options], capture_output=True)
        return json.loads((out / "metrics.json").read_text()), out

    def assert_same_run(self, report, metrics):
        self.assertEqual(report.hash, metrics["hash"])
        environment = dict(report.hash_environment)
        self.assertEqual(environment, metrics["hash_environment"])
        self.assertEqual(report.metrics.ate_origin_rmse_m, metrics["ate_origin_rmse_m"])

    def test_a_run_is_the_programs_to_the_byte(self):
        metrics, out = self.program_run(self.court, "--seed", "7")
        report = vb.run(self.court, seed=7, out=self.folder / "python", threads=1)
        self.assert_same_run(report, metrics)
        self.assertEqual(report.seed, 7)
        self.assertEqual(report.frames, FRAMES)
        # Stamps and numbers of the text have nine decimals.
        np.testing.assert_allclose(report.trajectories.estimate, np.loadtxt(out / "estimate.tum"),
                                   rtol=0, atol=1e-9)
        np.testing.assert_allclose(report.trajectories.truth, np.loadtxt(out / "groundtruth.tum"),
                                   rtol=0, atol=1e-9)

    def test_a_rendered_run_is_the_programs_to_the_byte(self):
        metrics, _ = self.program_run("quick-loop", "--set", "duration=0.2")
        report = vb.run("quick-loop", set={"duration": 0.2})
        if draws_as_program():
            self.assert_same_run(report, metrics)
        self.assertFalse(report.passed)  # its end is not reached
        self.assertIn("FAILED", report.verdict)

    def test_a_driver_that_computes_otherwise_is_told(self):
        code = ("import json, vinebench\nreport = vinebench.run('quick-loop', set={'duration': 0.01})\n"
                "print(json.dumps(dict(report.hash_environment)))")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                              env={**os.environ, "VINEBENCH_GL": "egl"})
        if "EGL" in done.stderr:
            self.skipTest(done.stderr)
        self.assertEqual(done.returncode, 0, done.stderr)
        environment = json.loads(done.stdout)
        if environment["libm"].startswith("vinebench"):
            self.assertEqual(environment["driver"], environment["processor"])

    def test_the_report_is_that_of_the_folder(self):
        out = self.folder / "out"
        report = vb.run(self.court, out=out)
        self.assertEqual(report.raw, json.loads((out / "metrics.json").read_text()))
        self.assertEqual(report.folder, out)
        self.assertTrue((out / "scenario.resolved.yaml").exists())
        self.assertTrue(report.passed)
        self.assertEqual(report.verdict, "PASSED")
        self.assertEqual([check.kind for check in report.checks], ["expectation"] * 2)
        self.assertTrue(all(check.holds for check in report.checks))
        self.assertEqual(report.metrics.coverage, 1)
        self.assertEqual(set(report.metrics.inliers), {"left", "right"})
        self.assertEqual(report.trajectories.live.shape, (FRAMES, 8))
        self.assertIn("court (seed 5): PASSED", str(report))
        self.assertIsNone(report.failure)

    # Frames 5 to 7, of 0.33 to 0.47 s, have no images.
    def test_degraded_segments_have_their_cause(self):
        report = vb.run(self.court, set={"sensors.drops.bursts": [{"from": 0.3, "until": 0.5}]})
        segment, = report.degraded
        self.assertEqual(segment.cause, "dropped pictures")
        self.assertIn("left", segment.cameras)
        self.assertAlmostEqual(segment.begin, 5 / 15, places=6)
        self.assertAlmostEqual(segment.end, 7 / 15, places=6)
        self.assertEqual((segment.untracked, segment.inliers, segment.share), (3, 0, 1))
        self.assertGreater(segment.usual_inliers, 20)

    def test_the_core_frame_by_frame_gives_the_runs_trajectory(self):
        report = vb.run(self.court)
        scenario = vb.Scenario(self.court)
        slam = vb.Slam(scenario, threads=1)
        live = [slam.process(frame) for frame in scenario]
        np.testing.assert_array_equal(slam.finish().trajectory, report.trajectories.estimate)
        for estimate, truth in zip(live, report.trajectories.truth, strict=True):
            self.assertEqual(estimate.time, truth[0])
            self.assertEqual(estimate.status, vb.TrackingStatus.TRACKING)

    def test_the_gil_is_released(self):
        ticks, stop = [], threading.Event()

        def tick():
            while not stop.wait(0.002):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        vb.run(self.court, set={"duration": 2.0})
        end = time.monotonic()
        stop.set()
        thread.join()
        # A held GIL would leave one gap as long as the run.
        gaps = np.diff([begin, *(t for t in ticks if begin < t < end), end])
        self.assertLess(gaps.max(), (end - begin) / 4)

    def test_bad_input_is_one_error(self):
        cases = {
            "did you mean 'quick-loop'": lambda: vb.run("quick-lop"),
            "unknown key": lambda: vb.run(self.court, set={"world.sunn": 1}),
            "output folder": lambda: vb.run(self.court, out="/proc/none/out"),
            "duration": lambda: vb.run(self.court, set={"duration": -1}),
        }
        for words, call in cases.items():
            with self.assertRaisesRegex(vb.Error, words):
                call()
        with self.assertRaises(TypeError):
            vb.run(self.court, slam=object())
        with self.assertRaises(TypeError):
            vb.run(3)

    def test_names_are_the_programs(self):
        listed = subprocess.run([PROGRAM, "list", "scenarios"], capture_output=True, text=True)
        for name in ("quick-loop", "occluded-camera"):
            self.assertIn(name, vb.scenario_names())
            self.assertIn(name, listed.stdout)


class InterruptTest(CourtTest):
    def test_an_interrupt_ends_a_run_after_its_frame(self):
        out = self.folder / "interrupted"
        code = (f"import vinebench as vb\nvb.run({str(self.court)!r}, out={str(out)!r},"
                " set={'duration': 600.0, 'route.speed': 0.001}, progress=True, threads=1)")
        child = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True,
                                 env=os.environ)
        first = child.stderr.readline()  # of the progress
        child.send_signal(signal.SIGINT)
        _, rest = child.communicate(timeout=60)
        self.assertEqual(child.returncode, -signal.SIGINT, first + rest)
        self.assertIn("KeyboardInterrupt", rest)
        self.assertTrue((out / "estimate.tum").exists())  # of the frames until then
        self.assertFalse((out / "metrics.json").exists())


if __name__ == "__main__":
    main()
