# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""A rover that is driven, alone and several side by side."""
import functools
import os
import signal
import unittest

import numpy as np

import vinebench as vb
from support import CourtTest, main
from vinebench._route import RouteProgress


def stepped(simulation, twist, steps):
    for _ in range(steps):
        answer = simulation.step(twist)
    return answer


def half_reward(observation, info):
    return 0.5 * info["gain"]


class SimulationTest(CourtTest):
    def test_the_first_frame_is_that_of_the_scenario(self):
        own = next(vb.Scenario(self.court))
        observation, info = vb.Simulation(self.court).reset()
        for name in ("left", "right"):
            np.testing.assert_array_equal(observation["images"][name], own.images[name])
        np.testing.assert_array_equal(info["T_world_body"], own.T_world_body)
        self.assertEqual(info["time"], 0)
        self.assertEqual(info["progress"], 0)

    # 0.3 m/s for 0.4 s are 0.12 m, less what it needs to gain speed: the motors give it some
    # m/s^2. 3 cm, and as much sideways and in angle for motors that differ by 1 %.
    def test_a_twist_drives_the_rover(self):
        simulation = vb.Simulation(self.court, seed=3)
        simulation.reset()
        _, reward, terminated, truncated, info = stepped(simulation, (0.3, 0.1, 0.0), 6)
        place = info["T_world_body"][:3, 3]
        np.testing.assert_allclose(place[:2], [0.12, 0.04], atol=0.03)
        self.assertFalse(terminated or truncated)
        self.assertAlmostEqual(info["progress"], place[0], places=9)  # the route is along x
        self.assertGreater(reward, 0.3 / 15 / 2)
        self.assertEqual(info["seed"], 3)
        np.testing.assert_array_equal(info["twist"], [0.3, 0.1, 0.0])

    def test_an_observation_is_of_the_state_that_is_returned(self):
        simulation = vb.Simulation(self.court, truth=["depth"])
        simulation.reset()
        for _ in range(4):
            observation, *_, info = simulation.step((0.5, 0, 0.5))
            frame = simulation.frame
            np.testing.assert_array_equal(observation["images"]["left"], frame.images["left"])
            np.testing.assert_array_equal(info["T_world_body"], frame.T_world_body)
            np.testing.assert_array_equal(observation["imu"], frame.imu[-1, 1:])
            np.testing.assert_array_equal(observation["wheels"], frame.wheels[-1, 5:])
            self.assertLessEqual(frame.imu[-1, 0], frame.time)
            self.assertGreater(frame.imu[-1, 0], frame.time - 1 / 200)

    def test_an_episode_repeats_to_the_byte(self):
        drives = []
        for threads in (1, 3):
            simulation = vb.Simulation(self.court, threads=threads)
            simulation.reset(seed=11)
            drives.append(stepped(simulation, (0.4, -0.1, 0.3), 5))
            simulation.reset()  # of the same seed
            drives.append(stepped(simulation, (0.4, -0.1, 0.3), 5))
        for answer in drives[1:]:
            np.testing.assert_array_equal(answer[0]["images"]["left"], drives[0][0]["images"]["left"])
            np.testing.assert_array_equal(answer[4]["T_world_body"], drives[0][4]["T_world_body"])

    # 0.6 s at 15 Hz: the tenth frame is the last.
    def test_an_episode_is_truncated_at_its_duration(self):
        simulation = vb.Simulation(self.court)
        simulation.reset()
        ends = [simulation.step((0, 0, 0))[3] for _ in range(9)]
        self.assertEqual(ends, [False] * 8 + [True])
        with self.assertRaisesRegex(vb.Error, "call reset"):
            simulation.step((0, 0, 0))
        self.assertFalse(simulation.reset()[1]["collision"])

    def test_the_routes_end_terminates(self):
        simulation = vb.Simulation(self.court, set={"duration": 20})
        simulation.reset(options={"start": (0.7, 0, 0)})
        for _ in range(60):
            _, _, terminated, _, info = simulation.step((0.5, 0, 0))
            if terminated:
                break
        self.assertTrue(info["reached"])
        self.assertFalse(info["collision"])
        self.assertAlmostEqual(info["T_world_body"][0, 3], 0.8, delta=0.05)  # 0.2 m before it

    # A crate a metre to the right; without duration an episode goes on.
    def test_a_collision_terminates_and_costs(self):
        simulation = vb.Simulation(self.court, set={"duration": None, "occluders": [
            {"shape": "crate", "position": [0, -1]}]})
        simulation.reset()
        for _ in range(90):
            _, reward, terminated, truncated, info = simulation.step((0, -0.5, 0))
            if terminated:
                break
        self.assertTrue(info["collision"])
        self.assertFalse(truncated)
        self.assertLess(reward, -0.9)
        self.assertLess(info["T_world_body"][1, 3], -0.3)

    # Uneven ground reaches two metres around the rows and the route.
    def test_leaving_the_ground_terminates_with_the_last_observation(self):
        simulation = vb.Simulation(self.court, set={"duration": None, "world.terrain": {
            "amplitude": 0.01, "margin": 2.0}})
        simulation.reset(options={"start": (0.0, -0.3, 0.0)})
        before = None
        for _ in range(90):
            observation, reward, terminated, _, info = simulation.step((0, -1.0, 0))
            if terminated:
                break
            before = observation
        self.assertIn("left the uneven ground", info["failure"])
        self.assertFalse(info["collision"])
        self.assertIs(observation, before)
        self.assertEqual(reward, -1)
        self.assertRaisesRegex(vb.Error, "call reset", lambda: simulation.step((0, 0, 0)))
        self.assertIsNone(simulation.reset()[1]["failure"])

    def test_limits_and_rewards_are_the_users(self):
        simulation = vb.Simulation(self.court, max_twist=(0.1, 0.1, 0.1), reward=half_reward,
                                   cameras=["right"])
        observation, _ = simulation.reset()
        self.assertEqual(list(observation["images"]), ["right"])
        self.assertEqual(simulation.image_shapes, {"right": (240, 376, 3)})
        _, reward, *_, info = stepped(simulation, (5, 0, -5), 3)
        np.testing.assert_array_equal(info["twist"], [0.1, 0, -0.1])
        self.assertEqual(reward, 0.5 * info["gain"])

    def test_the_core_follows_a_drive(self):
        simulation = vb.Simulation(self.court)
        slam = vb.Slam(simulation)
        simulation.reset()
        start = simulation.frame.T_world_body
        slam.process(simulation.frame)
        for _ in range(6):
            info = simulation.step((0.4, 0, 0))[4]
            estimate = slam.process(simulation.frame)
        moved = np.linalg.inv(start) @ info["T_world_body"]
        np.testing.assert_allclose(estimate.T_map_body[:3, 3], moved[:3, 3], atol=0.01)

    def test_bad_input_is_named(self):
        simulation = vb.Simulation(self.court)
        self.assertRaisesRegex(vb.Error, "before the first reset", lambda: simulation.frame)
        simulation.reset()
        cases = [
            (ValueError, r"expected shape \(3,\), found \(2,\)", lambda: simulation.step((1, 2))),
            (ValueError, "expected finite", lambda: simulation.step((0, 0, np.inf))),
            (ValueError, "options: expected start, found speed",
             lambda: simulation.reset(options={"speed": 1})),
            (ValueError, "expected x, y, heading", lambda: simulation.reset(options={"start": (1, 2)})),
            (vb.Error, "no camera named 'top'", lambda: vb.Simulation(self.court, cameras=["top"])),
            (vb.Error, "cannot start at", lambda: simulation.reset(options={"start": (-1, 2, 0)})),
            (ValueError, "max_twist", lambda: vb.Simulation(self.court, max_twist=(1, 1, 0))),
        ]
        for kind, words, call in cases:
            with self.assertRaisesRegex(kind, words):
                call()


class RouteProgressTest(unittest.TestCase):
    # There and back: at (1, 0) the place is 1 m on the way out and 3 m on the way back.
    def test_it_follows_a_route_that_returns(self):
        progress = RouteProgress(np.array([[0, 0], [2, 0], [0, 0]]), 0.2)
        places = [*np.arange(0, 2.01, 0.1), *np.arange(1.9, -0.01, -0.1)]
        gains = [progress.advance(np.array([x, 0.05])) for x in places]
        self.assertAlmostEqual(progress.distance, 4, places=9)
        self.assertAlmostEqual(sum(gains), 4, places=9)
        self.assertTrue(progress.reached)

    def test_the_start_of_a_loop_is_not_its_end(self):
        progress = RouteProgress(np.array([[0, 0], [2, 0], [2, 2], [0, 0.1]]), 0.2)
        progress.advance(np.array([0.0, 0.0]))
        self.assertFalse(progress.reached)

    def test_backwards_is_a_loss(self):
        progress = RouteProgress(np.array([[0, 0], [2, 0]]), 0.2)
        progress.advance(np.array([0.3, 0]))
        self.assertAlmostEqual(progress.advance(np.array([0.1, 0])), -0.2)


class VectorTest(CourtTest):
    def test_it_is_what_single_ones_are(self):
        twists = np.array([[0.4, 0, 0.2], [0.2, 0.2, 0]])
        with vb.VectorSimulation(2, self.court, reward=half_reward) as several:
            observation, infos = several.reset(seed=7)
            self.assertEqual([info["seed"] for info in infos], [7, 8])
            for _ in range(3):
                observation, rewards, terminated, truncated, infos = several.step(twists)
        self.assertEqual(observation["images"]["left"].shape, (2, 240, 376, 3))
        self.assertFalse(terminated.any() or truncated.any())
        for i, seed in enumerate((7, 8)):
            alone = vb.Simulation(self.court, reward=half_reward)
            alone.reset(seed=seed)
            expected = stepped(alone, twists[i], 3)
            for name, image in expected[0]["images"].items():
                np.testing.assert_array_equal(observation["images"][name][i], image)
            np.testing.assert_array_equal(observation["imu"][i], expected[0]["imu"])
            self.assertEqual(rewards[i], expected[1])
            np.testing.assert_array_equal(infos[i]["T_world_body"], expected[4]["T_world_body"])

    # Nine steps are an episode; the next one is its successor's reset.
    def test_episodes_that_ended_begin_again(self):
        with vb.VectorSimulation(1, self.court) as one:
            first, _ = one.reset()
            for _ in range(9):
                *_, truncated, infos = one.step(np.zeros((1, 3)))
            self.assertTrue(truncated[0])
            observation, rewards, _, truncated, infos = one.step(np.ones((1, 3)))
            self.assertEqual((rewards[0], bool(truncated[0]), infos[0]["time"]), (0, False, 0))
            np.testing.assert_array_equal(observation["images"]["left"], first["images"]["left"])

    def test_errors_come_back_and_workers_go_on(self):
        with vb.VectorSimulation(2, self.court) as several:
            with self.assertRaisesRegex(vb.Error, "simulation 0: .*call reset"):
                several.step(np.zeros((2, 3)))
            several.reset()
            with self.assertRaisesRegex(ValueError, r"expected shape \(2, 3\)"):
                several.step(np.zeros(3))
            several.step(np.zeros((2, 3)))
            os.kill(several._processes[1].pid, signal.SIGKILL)
            with self.assertRaisesRegex(vb.Error, "simulation 1: its process ended"):
                several.step(np.zeros((2, 3)))
        with self.assertRaisesRegex(vb.Error, "closed"):
            several.reset()
        with self.assertRaisesRegex(vb.Error, "simulation 0: .*nowhere"):
            vb.VectorSimulation(1, "nowhere")
        self.assertRaises(ValueError, functools.partial(vb.VectorSimulation, 0, self.court))


if __name__ == "__main__":
    main()
