# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The environment of Gymnasium, by its own checker; skipped without Gymnasium."""
import sys
import unittest
import warnings

import numpy as np

from support import CourtTest, main

try:
    import gymnasium
    from gymnasium.utils.env_checker import check_env
except ImportError:
    print("gymnasium is not installed")
    sys.exit(77)


class GymTest(CourtTest):
    def test_the_checker_finds_nothing(self):
        environment = gymnasium.make("vinebench.gym:Vineyard-v0", scenario=str(self.court),
                                     render_mode="rgb_array")
        with warnings.catch_warnings():
            # Readings have no limits, and one action's limits are not -1 and 1.
            warnings.filterwarnings("ignore", message=".*(infinity|symmetric|normalized).*")
            warnings.filterwarnings("ignore", message=".*render.*")
            check_env(environment.unwrapped)
        environment.close()

    def test_it_is_driven_by_actions(self):
        environment = gymnasium.make("vinebench.gym:Vineyard-v0", scenario=str(self.court),
                                     render_mode="rgb_array", max_episode_steps=4)
        observation, info = environment.reset(seed=4)
        self.assertEqual(info["seed"], 4)
        self.assertTrue(environment.observation_space.contains(observation))
        for i in range(4):
            action = np.array([0.3, 0, 0], np.float32)
            observation, _, terminated, truncated, info = environment.step(action)
            self.assertEqual((terminated, truncated), (False, i == 3))
        self.assertGreater(info["progress"], 0.03)
        np.testing.assert_array_equal(environment.render(), observation["images"]["left"])
        environment.close()


if __name__ == "__main__":
    main()
