# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What a run gives back."""
from __future__ import annotations

import dataclasses
import json
import os
import pathlib
from collections.abc import Mapping
from typing import Any, Optional

from vinebench.trajectories import Array


@dataclasses.dataclass(frozen=True)
class LoopClosures:
    """Loop closures against the truth."""

    correct: int
    """Reported and within 0.10 m and 2 degrees of the truth (and their covariance, if given)."""
    wrong: int
    missed: int
    """Returns to a tag without a correct closure."""


@dataclasses.dataclass(frozen=True)
class Blind:
    """The occlusion that the scenario asks for."""

    seconds: float
    metres: float
    """True path driven meanwhile, m."""
    lost_frames: int
    inliers_clear: float
    inliers_blind: float
    inliers_drop: Optional[float]
    """Share of the inliers that were lost, 0 to 1."""


@dataclasses.dataclass(frozen=True)
class Metrics:
    """The metrics of a run; None where one could not be measured.

    Names, units and definitions are those of metrics.json (docs/running.md).
    """

    coverage: float
    """Share of frames with a live pose, 0 to 1."""
    lost_frames: int
    """Frames without a pose after the first one with a pose."""
    losses: int
    """How often tracking went from a pose to none."""
    ate_rmse_m: Optional[float]
    """Absolute trajectory error after all corrections, SE(3)-aligned, RMSE, m."""
    ate_max_m: Optional[float]
    """Its maximum, m."""
    ate_live_rmse_m: Optional[float]
    """ATE of the live poses, RMSE, m."""
    ate_origin_rmse_m: Optional[float]
    """ATE aligned by the first pose only, RMSE, m."""
    ate_world_rmse_m: Optional[float]
    """ATE in the world without any alignment, RMSE, m."""
    ate_world_p95_m: Optional[float]
    ate_world_live_rmse_m: Optional[float]
    """95 % of the poses are within it in the world, m."""
    rpe_trans_percent: Optional[float]
    """Relative pose error of the translation over 1 m, percent."""
    heading_rmse_deg: Optional[float]
    """Error of the heading, aligned by the first pose, RMSE, degrees."""
    heading_max_deg: Optional[float]
    tilt_rmse_deg: Optional[float]
    """Angle between the estimated and the true z axis, RMSE, degrees."""
    tilt_max_deg: Optional[float]
    heading_world_rmse_deg: Optional[float]
    tilt_world_rmse_deg: Optional[float]
    end_error_m: Optional[float]
    """From the route's end to the true final position, m."""
    drift_m: Optional[float]
    """Largest position error before the first loop closure, aligned by the first pose, m."""
    drift_percent: Optional[float]
    """The same in percent of the true path."""
    nees_mean: Optional[float]
    """Normalised estimation error squared, mean; 6 if the covariances are consistent."""
    nees_within_95: Optional[float]
    """Share of the frames within the 95 % quantile, 0 to 1."""
    loop_closures: LoopClosures
    loop_returns: int
    """Returns to a tag that must lead to a loop closure."""
    keyframes: int
    landmarks: int
    features: Mapping[str, float]
    """Extracted features by camera, mean of the frames."""
    inliers: Mapping[str, float]
    """Matches consistent with the pose by camera, mean of the frames."""
    blind: Optional[Blind]
    real_time_factor: float
    """Simulated seconds a second of wall time."""
    wall_seconds: float
    cpu_seconds: float
    """Of the whole process up to the run's end, s."""
    peak_rss_mib: float
    """Of the process, MiB."""


@dataclasses.dataclass(frozen=True)
class Check:
    """One expectation with what was measured."""

    what: str
    measured: str
    expected: str
    ok: bool
    open: bool
    """A goal that is not met, whose bound for now is."""
    kind: str
    """"expectation", "goal", "now" or "guard"."""

    @property
    def holds(self) -> bool:
        """Whether a run passes with it."""
        return self.ok or self.open


@dataclasses.dataclass(frozen=True)
class DegradedSegment:
    """A part of the run in which the estimate was degraded, with one cause."""

    begin: float
    """s, stamp of its first frame."""
    end: float
    """s, stamp of its last frame."""
    cause: str
    cameras: tuple[str, ...]
    """Those that the cause affects; none if it concerns no camera in particular."""
    occluder: Optional[str]
    """Class of the occluder that covers most."""
    share: float
    """Of the segment's frames in which the cause is present, 0 to 1."""
    error_growth: float
    """Drift of the live pose meanwhile, m."""
    untracked: int
    """Frames without a pose supported by cameras."""
    inliers: float
    """Of all cameras, mean over the segment."""
    usual_inliers: float
    """The run's median."""


@dataclasses.dataclass(frozen=True)
class Failure:
    """Why the SLAM system under test ended before its run did."""

    cause: str
    frame: Optional[int]
    """Index of the frame that it was given, 0 where start() failed; None after the last one."""
    exception: Optional[BaseException] = None
    """What a system written in Python raised, with its traceback."""


@dataclasses.dataclass(frozen=True)
class Trajectories:
    """Of a run, each (N, 8) float64: t [s], x y z [m], qx qy qz qw."""

    truth: Array
    """T_world_body at each frame's stamp."""
    estimate: Array
    """T_map_body after all corrections."""
    live: Array
    """T_map_body as it was given at each frame."""
    keyframes: Array
    """T_map_body of the keyframes, after all corrections."""


@dataclasses.dataclass(frozen=True)
class Report:
    """A judged run."""

    scenario: str
    seed: int
    frames: int
    passed: bool
    """Whether all checks hold (the program's exit code 0)."""
    verdict: str
    """"PASSED", "PASSED (goal open)", or "FAILED" with the kinds of what failed."""
    metrics: Metrics
    checks: tuple[Check, ...]
    degraded: tuple[DegradedSegment, ...]
    failure: Optional[Failure]
    hash: str
    """Of the frames, the estimates and the results."""
    hash_environment: Mapping[str, str]
    """What the hash depends on beside scenario and seed. Hashes are comparable if all values but
    `processor` are equal."""
    trajectories: Trajectories
    summary: str
    """Readable: degraded segments, their causes, patterns of the error."""
    folder: Optional[pathlib.Path]
    """Where the run's files are, if `out` was given."""
    raw: Mapping[str, Any]
    """The content of metrics.json."""

    def __str__(self) -> str:
        lines = [f"{self.scenario} (seed {self.seed}): {self.verdict}, {self.frames} frames, "
                 f"hash {self.hash}"]
        lines += [f"  {check.kind:<12} {check.what:<30} {check.measured:>14}  "
                  f"{check.expected:<14} {'ok' if check.ok else 'open' if check.open else 'FAILED'}"
                  for check in self.checks]
        return "\n".join(lines)


def _metrics(raw: Mapping[str, Any]) -> Metrics:
    values: dict[str, Any] = {field.name: raw.get(field.name)
                              for field in dataclasses.fields(Metrics)}
    values["loop_closures"] = LoopClosures(**raw["loop_closures"])
    blind = raw.get("blind")
    if blind is not None:
        names = [field.name for field in dataclasses.fields(Blind)]
        values["blind"] = Blind(**{name: blind[name] for name in names})
    return Metrics(**values)


def report_of(outcome: Mapping[str, Any], out: Optional[os.PathLike[str]],
              exception: Optional[BaseException]) -> Report:
    """The report of what the extension's `run` returned."""
    raw = json.loads(outcome["metrics"])
    failure = raw.get("failure")
    arrays = outcome["trajectories"]
    return Report(
        scenario=raw["scenario"], seed=raw["seed"], frames=raw["frames"],
        passed=outcome["passed"], verdict=outcome["verdict"], metrics=_metrics(raw),
        checks=tuple(Check(**check) for check in raw["expectations"]),
        degraded=tuple(DegradedSegment(**segment) for segment in outcome["degraded"]),
        failure=Failure(failure["cause"], failure["frame"], exception) if failure else None,
        hash=raw["hash"], hash_environment=raw.get("hash_environment", {}),
        trajectories=Trajectories(truth=arrays["truth"], estimate=arrays["trajectory"],
                                  live=arrays["live"], keyframes=arrays["keyframes"]),
        summary=outcome["summary"], folder=pathlib.Path(out) if out is not None else None, raw=raw)
