# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The simulation as an environment of Gymnasium, which this module needs (`pip install gymnasium`).

    environment = gymnasium.make("vinebench.gym:Vineyard-v0", scenario="quick-loop")
"""
from __future__ import annotations

from typing import Any, Optional

import gymnasium
import numpy as np

from vinebench.simulation import Image, Observation, Simulation
from vinebench.trajectories import Array, PathLike


def _unlimited(size: int) -> gymnasium.spaces.Box[Any]:
    return gymnasium.spaces.Box(-np.inf, np.inf, (size,), dtype=np.float64)


# Without Gymnasium its base is Any to a type checker.
class VineyardEnv(gymnasium.Env[Any, Any]):  # type: ignore[misc, unused-ignore]
    """Simulation as a gymnasium.Env. Actions are twists (3,) float32 within max_twist; observations
    are those of Simulation. Its arguments are those of Simulation."""

    metadata = {"render_modes": ["rgb_array"], "render_fps": 15}

    def __init__(self, scenario: PathLike = "quick-loop", *, render_mode: Optional[str] = None,
                 **arguments: Any) -> None:
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f'render_mode: expected None or "rgb_array", found "{render_mode}"')
        self.render_mode = render_mode
        self.simulation = Simulation(scenario, **arguments)
        limits = self.simulation.max_twist.astype(np.float32)
        self.action_space = gymnasium.spaces.Box(-limits, limits, dtype=np.float32)
        self.observation_space = gymnasium.spaces.Dict({
            "images": gymnasium.spaces.Dict({
                name: gymnasium.spaces.Box(0, 255, shape, np.uint8)
                for name, shape in self.simulation.image_shapes.items()}),
            "imu": _unlimited(6),
            "wheels": _unlimited(4)})
        self._observation: Optional[Observation] = None

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None
              ) -> tuple[Observation, dict[str, Any]]:
        """See Simulation.reset()."""
        super().reset(seed=seed)
        self._observation, info = self.simulation.reset(seed=seed, options=options)
        return self._observation, info

    def step(self, action: Array) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """See Simulation.step()."""
        answer = self.simulation.step(action)
        self._observation = answer[0]
        return answer

    def render(self) -> Optional[Image]:
        """The first camera's image of the current state, (h, w, 3) uint8."""
        if self.render_mode is None or self._observation is None:
            return None
        return next(iter(self._observation["images"].values()))


gymnasium.register("Vineyard-v0", entry_point="vinebench.gym:VineyardEnv")
