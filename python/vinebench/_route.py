# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""How far along a route a rover is."""
from __future__ import annotations

import numpy as np

from vinebench.trajectories import Array

# m, that the place on the route may move from one frame to the next, so that it does not jump where
# the route comes back to itself.
_REACH = 0.5


class RouteProgress:
    """The distance along a polyline of waypoints, followed from its start."""

    def __init__(self, waypoints: Array, arrival: float) -> None:
        """waypoints: (n, 2), m. arrival: m, distance to the last one at which it is reached."""
        self._points = np.asarray(waypoints, dtype=np.float64)
        lengths = np.linalg.norm(np.diff(self._points, axis=0), axis=1)
        self._begins = np.concatenate([[0.0], np.cumsum(lengths)])
        self.arrival = arrival
        self.distance = 0.0
        """m, of the nearest point of the route."""
        self.reached = False

    @property
    def length(self) -> float:
        """m, of the whole route."""
        return float(self._begins[-1])

    def advance(self, position: Array) -> float:
        """The new place for a position (2,) [m]; returns the gain in m, negative backwards."""
        before = self.distance
        self.distance = self._nearest(np.asarray(position, dtype=np.float64))
        left = self.length - self.distance
        away = float(np.linalg.norm(self._points[-1] - position))
        self.reached = self.length > 0 and left <= self.arrival and away <= self.arrival
        return self.distance - before

    def _nearest(self, position: Array) -> float:
        """Among the points of the route within reach of the last one."""
        low, high = max(0.0, self.distance - _REACH), min(self.length, self.distance + _REACH)
        best, nearest = np.inf, self.distance
        for i in range(len(self._points) - 1):
            begin, end = self._begins[i], self._begins[i + 1]
            if end <= begin or end < low or begin > high:
                continue
            direction = (self._points[i + 1] - self._points[i]) / (end - begin)
            along = float(np.clip(begin + direction @ (position - self._points[i]),
                                  max(low, begin), min(high, end)))
            away = float(np.linalg.norm(self._points[i] + direction * (along - begin) - position))
            if away < best - 1e-12:
                best, nearest = away, along
        return nearest
