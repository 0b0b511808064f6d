# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Compares an estimated trajectory with the true one."""
from __future__ import annotations

import dataclasses
import os
from typing import Any, Optional, Union

import numpy as np

from vinebench._load import core
from vinebench.trajectories import Array, PathLike


@dataclasses.dataclass(frozen=True)
class ErrorStatistics:
    """Of the distances between true and estimated positions, m."""

    rmse: float
    mean: float
    median: float
    max: float


@dataclasses.dataclass(frozen=True, eq=False)
class Evaluation:
    """Errors of a trajectory; they agree with evo's to nine digits."""

    poses: int
    """Pairs of a true and an estimated pose at most 0.01 s apart."""
    ate: ErrorStatistics
    """Absolute trajectory error, SE(3)-aligned without scale, m."""
    ate_origin: ErrorStatistics
    """Aligned by the first pose only, m."""
    rpe_trans_percent: Optional[float]
    """Relative pose error of the translation over 1 m of the true path, percent; None if the path
    is too short."""
    heading_rmse_deg: float
    """Error of the heading seen from above, aligned by the first pose, degrees."""
    heading_max_deg: float
    tilt_rmse_deg: float
    """Angle between the estimated and the true z axis, aligned likewise, degrees."""
    tilt_max_deg: float
    worst_error_m: float
    """The largest position error, aligned by the first pose, m."""
    worst_time_s: float
    """The true pose's stamp there, s."""
    T_world_map: Array
    """(4, 4), m: the SE(3) alignment."""


def _given(trajectory: Union[Array, PathLike], what: str) -> Union[Array, str]:
    if isinstance(trajectory, (str, os.PathLike)):
        return os.fspath(trajectory)
    if not isinstance(trajectory, np.ndarray):
        raise TypeError(f"{what}: expected an array (N, 8) or the name of a TUM file, found "
                        f"{type(trajectory).__name__}")
    return trajectory


def evaluate(truth: Union[Array, PathLike], estimate: Union[Array, PathLike]) -> Evaluation:
    """Compares two trajectories as `vinebench eval` does.

    truth, estimate: arrays (N, 8) as the rows of a TUM file (t [s], x y z [m], qx qy qz qw; the
        stamps ascend, the quaternions are of unit length), or names of TUM files.

    Raises vinebench.Error if fewer than three poses are within 0.01 s of each other, ValueError or
    TypeError for arrays that are no trajectories.
    """
    entry: dict[str, Any] = core.evaluate(_given(truth, "truth"), _given(estimate, "estimate"))
    for name in ("ate", "ate_origin"):
        entry[name] = ErrorStatistics(*entry[name])
    return Evaluation(**entry)
