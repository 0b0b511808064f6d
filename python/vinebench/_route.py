# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""How far along a route a rover is."""
from __future__ import annotations

import numpy as np

from vinebench.trajectories import Array

class RouteProgress:
    """The distance along a polyline of waypoints, leg by leg: the next leg begins within `arrival`
    of a waypoint, so that a route may return to where it was."""

    def __init__(self, waypoints: Array, arrival: float) -> None:
        """waypoints: (n, 2), m. arrival: m, distance at which a waypoint is reached."""
        self._points = np.asarray(waypoints, dtype=np.float64)
        lengths = np.linalg.norm(np.diff(self._points, axis=0), axis=1)
        self._begins = np.concatenate([[0.0], np.cumsum(lengths)])
        self._leg = 0
        self.arrival = arrival
        self.distance = 0.0
        """m, of the leg's point that is nearest."""
        self.reached = False

    @property
    def length(self) -> float:
        """m, of the whole route."""
        return float(self._begins[-1])

    def advance(self, position: Array) -> float:
        """The new place for a position (2,) [m]; returns the gain in m, negative backwards."""
        before = self.distance
        place = np.asarray(position, dtype=np.float64)
        legs = len(self._points) - 1
        while self._leg < legs and self._near_end(place):
            self._leg += 1
        self.reached = legs > 0 and self._leg == legs
        self.distance = self._along(place, min(self._leg, legs - 1)) if legs > 0 else 0.0
        return self.distance - before

    def _near_end(self, place: Array) -> bool:
        away = np.linalg.norm(self._points[self._leg + 1] - place)
        return bool(away <= self.arrival)

    def _along(self, place: Array, leg: int) -> float:
        begin, end = self._points[leg], self._points[leg + 1]
        length = self._begins[leg + 1] - self._begins[leg]
        if length <= 0:
            return float(self._begins[leg])
        return float(self._begins[leg] + np.clip((place - begin) @ (end - begin) / length,
                                                 0, length))
