# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""SLAM systems written in Python, judged by the bench."""
import numpy as np

import vinebench as vb
from support import FRAMES, CourtTest, main


class Standing:
    """Stays where it began, and remembers what it was given."""

    def __init__(self):
        self.setup, self.frames = None, []

    def start(self, setup):
        self.setup = setup

    def process(self, frame):
        self.frames.append(frame)
        return np.eye(4)


class Answers:
    """Gives this at frame 2, and its place at others."""

    def __init__(self, answer):
        self.answer = answer

    def process(self, frame):
        return self.answer(frame) if frame.index == 2 else np.eye(4)


def raising(error):
    def answer(frame):
        raise error

    return Answers(answer)


class SystemTest(CourtTest):
    def failure_of(self, system):
        report = vb.run(self.court, slam=system)
        self.assertFalse(report.passed)
        return report.failure

    def test_it_is_judged_as_others_are(self):
        system = Standing()
        report = vb.run(self.court, slam=system)
        self.assertEqual(len(system.frames), FRAMES)
        self.assertEqual(report.frames, FRAMES)
        self.assertEqual(report.metrics.coverage, 1)
        self.assertIsNone(report.failure)
        # It stands, so that its error aligned by the first pose is the true path.
        truth = report.trajectories.truth[:, 1:4]
        expected = np.sqrt(np.mean(np.sum((truth - truth[0])**2, axis=1)))
        self.assertAlmostEqual(report.metrics.ate_origin_rmse_m, expected, places=9)
        self.assertFalse(report.passed)  # 2 cm
        self.assertIn("Standing", report.raw["timing_ms"])

    def test_it_is_given_no_truth(self):
        system = Standing()
        vb.run(self.court, slam=system)
        frame = system.frames[3]
        self.assertIsInstance(frame, vb.SensorFrame)
        for name in ("T_world_body", "depth", "labels", "things"):
            self.assertFalse(hasattr(frame, name), name)
        self.assertEqual(frame.index, 3)
        self.assertEqual(frame.stamp, 200_000_000)
        self.assertEqual(sorted(frame.images), ["left", "right"])
        self.assertEqual(frame.imu.shape[1], 7)
        self.assertEqual(frame.wheels.shape[1], 9)
        own = next(f for f in vb.Scenario(self.court, frames=(3, 3)))
        np.testing.assert_array_equal(frame.images["left"], own.images["left"])

    def test_it_is_given_the_setup(self):
        system = Standing()
        vb.run(self.court, slam=system, threads=2)
        self.assertEqual(system.setup.rig.name, "pair")
        self.assertEqual(system.setup.rig.stereo_pairs, [("left", "right")])
        self.assertEqual(system.setup.wheels.radius, 0.10)
        self.assertEqual(system.setup.threads, 2)
        tag, = system.setup.tags
        self.assertEqual((tag.family, tag.id, tag.size), ("tag36h11", 3, 0.161))
        # Its face looks to -y: into the tag is +y.
        np.testing.assert_allclose(tag.T_world_tag[:3, 2], [0, 1, 0], atol=1e-12)
        np.testing.assert_allclose(tag.T_world_tag[:3, 3], [0.5, 1.5, 0.5])

    def test_estimates_of_the_core_through_the_door_are_the_cores(self):
        class Wrapped:
            def start(self, setup):
                self.core = vb.Slam(setup.rig, settings={
                    "dead_reckoning.wheels": {"radius": setup.wheels.radius,
                                              "half_track": setup.wheels.half_track,
                                              "half_wheelbase": setup.wheels.half_wheelbase}})

            def process(self, frame):
                return self.core.process(frame)

            def finish(self):
                return self.core.finish()

        ours, theirs = vb.run(self.court), vb.run(self.court, slam=Wrapped())
        # A matrix has no room for the last bit of a quaternion.
        np.testing.assert_allclose(theirs.trajectories.estimate, ours.trajectories.estimate,
                                   rtol=0, atol=1e-12)
        self.assertAlmostEqual(theirs.metrics.ate_rmse_m, ours.metrics.ate_rmse_m, places=12)
        self.assertEqual(theirs.metrics.inliers, ours.metrics.inliers)
        self.assertEqual(theirs.metrics.keyframes, ours.metrics.keyframes)
        self.assertTrue(theirs.passed)

    # It believes to stand, so that the position loop drives on faster than it should.
    def test_its_estimates_may_steer_the_rover(self):
        usual = vb.run(self.court, slam=Standing())
        steered = vb.run(self.court, slam=Standing(), set={"route.steering": "estimate"})
        ends = [report.trajectories.truth[-1, 1] for report in (usual, steered)]
        self.assertGreater(ends[1], ends[0] + 0.005)

    def test_none_is_no_pose(self):
        report = vb.run(self.court, slam=Answers(lambda frame: None))
        self.assertEqual(report.metrics.lost_frames, 1)
        self.assertEqual(report.metrics.losses, 1)
        self.assertAlmostEqual(report.metrics.coverage, 1 - 1 / FRAMES)

    def test_an_exception_is_a_failure_of_the_run(self):
        failure = self.failure_of(raising(KeyError("no map")))
        self.assertRegex(failure.cause, r"^Answers.process: KeyError: 'no map' \(.*system_test.py:\d+\)$")
        self.assertEqual(failure.frame, 2)
        self.assertIsInstance(failure.exception, KeyError)

    def test_an_answer_that_cannot_be_is_a_failure(self):
        cases = {
            r"expected shape \(4, 4\), found \(3, 3\)": np.eye(3),
            "expected a rigid transform": 2 * np.eye(4),
            "mirror.*|expected a rigid transform": np.diag([1.0, 1.0, -1.0, 1.0]),
            "could not convert|invalid|float": "here",
            r"covariance: expected shape \(6, 6\)": vb.Estimate(np.eye(4), covariance=np.eye(3)),
            "covariance: expected finite": vb.Estimate(np.eye(4), covariance=np.full((6, 6), np.nan)),
            "T_world_map: expected a rigid": vb.Estimate(np.eye(4), T_world_map=2 * np.eye(4)),
            "9 is not a valid TrackingStatus": vb.Estimate(np.eye(4), status=9),
        }
        for words, answer in cases.items():
            failure = self.failure_of(Answers(lambda frame, answer=answer: answer))
            self.assertRegex(failure.cause, words)
            self.assertEqual(failure.frame, 2)

    def test_a_system_may_say_that_it_failed(self):
        failure = self.failure_of(raising(vb.SystemFailed("no licence")))
        self.assertEqual(failure.cause, "Answers: no licence")

    def test_it_may_end_the_run(self):
        class Brief(Standing):
            @property
            def stopped(self):
                return len(self.frames) == 3

        report = vb.run(self.court, slam=Brief())
        self.assertEqual(report.frames, 3)
        self.assertIsNone(report.failure)

    # After the answer, so that no system can use it.
    def test_the_truth_is_told_after_each_answer(self):
        system, told = Standing(), []

        def on_truth(stamp, T_world_body):
            self.assertEqual(system.frames[-1].stamp, stamp)
            told.append(T_world_body[:3, 3])

        report = vb.run(self.court, slam=system, on_truth=on_truth)
        np.testing.assert_allclose(told, report.trajectories.truth[:, 1:4], rtol=0, atol=1e-12)

    def test_start_and_finish_may_fail_too(self):
        class NoStart(Standing):
            def start(self, setup):
                raise ValueError("no vocabulary")

        class NoFinish(Standing):
            def finish(self):
                return np.zeros((3, 7))

        failure = self.failure_of(NoStart())
        self.assertIn("NoStart.start: ValueError: no vocabulary", failure.cause)
        failure = self.failure_of(NoFinish())
        self.assertIn("expected shape (n, 8), found (3, 7)", failure.cause)
        self.assertIsNone(failure.frame)

    def test_its_final_trajectory_is_judged(self):
        class Corrected(Standing):
            def finish(self):
                rows = np.zeros((FRAMES, 8))
                rows[:, 0] = np.arange(FRAMES) / 15
                rows[:, 1] = 1
                rows[:, 7] = 1
                return vb.SlamSummary(trajectory=rows, landmarks=12)

        report = vb.run(self.court, slam=Corrected())
        self.assertEqual(report.metrics.landmarks, 12)
        np.testing.assert_array_equal(report.trajectories.estimate[:, 1], 1)
        np.testing.assert_array_equal(report.trajectories.live[:, 1], 0)

    def test_its_live_place_in_the_world_is_judged(self):
        class Placed(Standing):
            def process(self, frame):
                T_world_map = np.eye(4)
                T_world_map[:3, 3] = truth[frame.index]
                place = None if frame.index < 2 else T_world_map
                return vb.Estimate(np.eye(4), T_world_map=place)

        truth = vb.run(self.court, slam=Standing()).trajectories.truth[:, 1:4] + [0, 0.03, 0]
        report = vb.run(self.court, slam=Placed())
        self.assertAlmostEqual(report.metrics.ate_world_live_rmse_m, 0.03, places=8)

    def test_an_interrupt_in_it_is_the_callers(self):
        with self.assertRaises(KeyboardInterrupt):
            vb.run(self.court, slam=raising(KeyboardInterrupt()))
        vb.run(self.court, slam=Standing())  # and nothing of it is left

    def test_a_scenario_that_keeps_our_map_is_refused(self):
        with self.assertRaisesRegex(vb.Error, "earlier_visit: requires the built-in SLAM core"):
            vb.run(self.court, slam=Standing(), set={"earlier_visit": {"duration": 0.2}})


if __name__ == "__main__":
    main()
