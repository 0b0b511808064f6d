# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Trajectories as arrays and as TUM files.

A trajectory is an array of float64, (N, 8), as the rows of a TUM file: t [s], x, y, z [m], then the
quaternion qx, qy, qz, qw of T_map_body (or T_world_body of the truth), stamps ascending.
"""
from __future__ import annotations

import os
from typing import Union

import numpy as np
import numpy.typing as npt

from vinebench._load import core

Array = npt.NDArray[np.float64]
PathLike = Union[str, "os.PathLike[str]"]


def read_tum(file: PathLike) -> Array:
    """Reads a TUM file: (N, 8) float64.

    Raises vinebench.Error with file and line for a file that is not one.
    """
    return core.read_tum(os.fspath(file))


def write_tum(file: PathLike, trajectory: Array) -> None:
    """Writes an (N, 8) trajectory as a TUM file, stamps and numbers with nine decimals."""
    core.write_tum(os.fspath(file), trajectory)


def to_matrices(trajectory: Array) -> Array:
    """The poses of an (N, 8) trajectory as transforms, (N, 4, 4)."""
    rows = np.asarray(trajectory, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 8:
        raise ValueError(f"trajectory: expected shape (N, 8), found {rows.shape}")
    x, y, z, w = rows[:, 4:].T
    matrices = np.zeros((len(rows), 4, 4))
    matrices[:, 0, :3] = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w),
                                   2 * (x * z + y * w)], axis=1)
    matrices[:, 1, :3] = np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z),
                                   2 * (y * z - x * w)], axis=1)
    matrices[:, 2, :3] = np.stack([2 * (x * z - y * w), 2 * (y * z + x * w),
                                   1 - 2 * (x * x + y * y)], axis=1)
    matrices[:, :3, 3] = rows[:, 1:4]
    matrices[:, 3, 3] = 1
    return matrices


def row_of(stamp: int, pose: Array) -> Array:
    """A row of a trajectory, (8,), of a stamp in ns and a transform (4, 4)."""
    R = np.asarray(pose, dtype=np.float64)[:3, :3]
    # Shepperd (1978): the largest of the four is divided by.
    squares = np.array([1 + R[0, 0] - R[1, 1] - R[2, 2], 1 - R[0, 0] + R[1, 1] - R[2, 2],
                        1 - R[0, 0] - R[1, 1] + R[2, 2], 1 + R[0, 0] + R[1, 1] + R[2, 2]])
    k = int(np.argmax(squares))
    others = np.array([[squares[0], R[0, 1] + R[1, 0], R[0, 2] + R[2, 0], R[2, 1] - R[1, 2]],
                       [R[0, 1] + R[1, 0], squares[1], R[1, 2] + R[2, 1], R[0, 2] - R[2, 0]],
                       [R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], squares[2], R[1, 0] - R[0, 1]],
                       [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], squares[3]]])
    q = others[k] / np.linalg.norm(others[k])
    return np.concatenate([[stamp * 1e-9], np.asarray(pose)[:3, 3], q if q[3] >= 0 else -q])
