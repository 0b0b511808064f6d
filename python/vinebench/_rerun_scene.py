# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What a recording of Rerun has of a run: docs/rerun.md has its entities."""
from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np

from vinebench._load import core
from vinebench._point_cloud import PointCloud
from vinebench._rerun_writer import Colour, Writer
from vinebench._run_folder import Path, RunFolder, Stamps, Timeline, is_time, nearest
from vinebench.trajectories import Array

TRUTH, MAP, LIVE = "world/truth", "world/map", "world/live_map"
_GREEN, _ORANGE, _BLUE, _RED = (60, 170, 80), (240, 150, 40), (90, 140, 240), (220, 60, 60)
_GREY, _BROWN = (150, 150, 150), (140, 110, 80)
_CAMERAS = ((90, 140, 240), (150, 200, 250), (240, 150, 40), (250, 210, 130), (60, 170, 80),
            (220, 60, 60), (170, 110, 210))  # colours in plots
_STATUS = {"lost": 0.0, "initialising": 1.0, "dead_reckoning": 2.0, "tracked": 3.0}
_WARNINGS = {"lost", "dead_reckoning_given_up", "tag_rejected", "loop_closure_missed", "explained",
             "occlusion_begin"}
_SIGMAS = 3
_VISIBLE = 0.1  # m, the largest ellipsoid's half axis is enlarged towards
_THIN = 0.004  # m, of a tag
_FAR = 4.0  # m, beyond the path
_DISTANCE = 1.0  # m, before which a drift in percent says nothing


def alignment(truth: Path, estimate: Path, how: str) -> Array:
    """T_world_map of an estimate by its "first" pose, by "all" (SE(3)), or "none"."""
    mine, theirs = nearest(truth.stamps, estimate.stamps)
    if how == "none" or not len(mine):
        return np.eye(4)
    if how == "all":
        return np.asarray(core.evaluate(truth.rows, estimate.rows)["T_world_map"])
    T_world_body, T_map_body = truth.matrices()[theirs[0]], estimate.matrices()[mine[0]]
    return np.asarray(T_world_body @ np.linalg.inv(T_map_body))


def position_errors(truth: Path, estimate: Path, T_world_map: Array) -> tuple[Stamps, Array]:
    """Stamps, and distances from the true positions there, m."""
    mine, theirs = nearest(truth.stamps, estimate.stamps)
    placed = estimate.rows[mine, 1:4] @ T_world_map[:3, :3].T + T_world_map[:3, 3]
    return estimate.stamps[mine], np.linalg.norm(placed - truth.rows[theirs, 1:4], axis=1)


def _numbers(values: Any, count: int) -> list[float]:
    """So many finite numbers. Raises ValueError."""
    numbers = np.array(values, np.float64)
    if numbers.shape != (count,) or not np.isfinite(numbers).all():
        raise ValueError(f"expected {count} numbers, found {values}")
    return [float(number) for number in numbers]


def _object(box: Mapping[str, Any]) -> dict[str, Any]:
    (x, y), size = _numbers(box["centre"], 2), _numbers(box["size"], 3)
    foot, yaw_deg = _numbers([box["foot"], box["yaw_deg"]], 2)
    yaw = math.radians(yaw_deg) / 2
    return {"centre": [x, y, foot + size[2] / 2], "size": size, "label": str(box["class"]),
            "rotation": [0, 0, math.sin(yaw), math.cos(yaw)],
            "colour": [round(255 * min(max(c, 0), 1)) for c in _numbers(box["colour"], 3)]}


def _tag(tag: Mapping[str, Any]) -> dict[str, Any]:
    """x right, y down on the printed face, z into it."""
    pose, [size] = _numbers(tag["T_world_tag"], 7), _numbers([tag["size"]], 1)
    return {"centre": pose[:3], "size": [size, size, _THIN], "rotation": pose[3:],
            "label": f"{tag['family']}_{tag['id']}"}


def _boxes(site: Mapping[str, Any]) -> dict[str, list[dict[str, Any]]]:
    """Of the vineyard, by entity."""
    radius, height = _numbers(site.get("post", [0.035, 1.6]), 2)
    posts = [{"centre": [*_numbers(post, 2), height / 2], "rotation": [0, 0, 0, 1],
              "size": [2 * radius, 2 * radius, height]} for post in site.get("posts", [])]
    return {"posts": posts, "objects": [_object(box) for box in site.get("objects", [])],
            "tags": [_tag(tag) for tag in site.get("tags", [])]}


def write_site(writer: Writer, run: RunFolder) -> None:
    """Rows, posts, objects and tags. Raises Error for a site.json that lacks something."""
    try:
        boxes = _boxes(run.site)
        rows = [np.array([[a, b, 0.0], [c, d, 0.0]])
                for a, b, c, d in (_numbers(row, 4) for row in run.site.get("rows", []))]
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise core.Error(f"{run.folder / 'site.json'}: not as vinebench writes it ({error!r})"
                         ) from error
    writer.static("world", writer.sdk.ViewCoordinates.RIGHT_HAND_Z_UP)
    writer.lines("world/rows", rows, [_BROWN])
    writer.boxes("world/posts", boxes["posts"], colors=[_BROWN])
    writer.boxes("world/objects", boxes["objects"], labels=[b["label"] for b in boxes["objects"]],
                 colors=[b["colour"] for b in boxes["objects"]])
    writer.boxes("world/tags", boxes["tags"], labels=[b["label"] for b in boxes["tags"]],
                 colors=[_RED], show_labels=False)


def _write_path(writer: Writer, entity: str, path: Path, colour: Colour) -> None:
    writer.line(f"{entity}/path", path.rows[:, 1:4], colour)
    writer.poses(f"{entity}/body", path.stamps, path.rows)


def write_loops(writer: Writer, run: RunFolder) -> None:
    """Lines between the two places of each closed loop: green right, red wrong."""
    strips, colours = [], []
    for event in run.events:
        ends = [event.get(name) for name in ("earlier_t", "later_t")]
        if event["event"] != "loop_closure" or not all(is_time(t) for t in ends):
            continue
        stamps = np.array([round(t * 1e9) for t in ends if t is not None], np.int64)
        found = nearest(run.estimate.stamps, stamps)[1]
        if len(found) == len(ends):
            strips.append(run.estimate.rows[found, 1:4] + [0, 0, 0.15])
            colours.append(_RED if event.get("correct") is False else _GREEN)
    writer.lines(f"{MAP}/loops", strips, colours)


def _write_landmarks(writer: Writer, estimate: Path, cloud: PointCloud) -> None:
    """Those far from the path apart: they would make the rest small in the 3D view."""
    path = estimate.rows[:, 1:4] if len(estimate) else np.zeros((1, 3))
    near = ((cloud.points >= path.min(axis=0) - _FAR)
            & (cloud.points <= path.max(axis=0) + _FAR)).all(axis=1)
    for entity, these in (("landmarks", near), ("far_landmarks", ~near)):
        colours = [_GREY] if cloud.colours is None else cloud.colours[these]
        writer.points(f"{MAP}/{entity}", cloud.points[these], colours, 0.01)


def write_paths(writer: Writer, run: RunFolder, cloud: Optional[PointCloud], how: str
                ) -> tuple[Array, Array]:
    """True and estimated paths; the map. Returns T_world_map of the corrected and the live path."""
    corrected = alignment(run.truth, run.estimate, how)
    live = alignment(run.truth, run.live, how) if len(run.live) else corrected
    if len(run.truth):
        _write_path(writer, TRUTH, run.truth, _GREEN)
    writer.transform(MAP, corrected)
    _write_path(writer, f"{MAP}/estimate", run.estimate, _ORANGE)
    writer.points(f"{MAP}/keyframes", run.keyframes.rows[:, 1:4], [_ORANGE], 0.02)
    write_loops(writer, run)
    if cloud is not None:
        _write_landmarks(writer, run.estimate, cloud)
    if len(run.live):
        writer.transform(LIVE, live)
        _write_path(writer, LIVE, run.live, _BLUE)
    return corrected, live


def _largest_sigmas(timeline: Timeline) -> Array:
    """Along the longest axis, m; NaN where unknown."""
    sigmas = np.full(len(timeline.stamps), np.nan)
    known = np.isfinite(timeline.covariance).all(axis=(1, 2))
    values = np.linalg.eigvalsh(timeline.covariance[known])
    sigmas[known] = np.sqrt(np.maximum(values[:, 2], 0))
    return sigmas


def write_covariance(writer: Writer, run: RunFolder) -> float:
    """Ellipsoids of three standard deviations at the live pose. Returns by how much they are
    enlarged, a power of ten as in a report."""
    timeline = run.timeline
    sigmas = _largest_sigmas(timeline)
    at = np.nonzero(np.isfinite(sigmas))[0]
    mine, theirs = nearest(run.live.stamps, timeline.stamps[at])
    if not len(mine) or not hasattr(writer.sdk, "Ellipsoids3D"):
        return 1
    largest = float(np.nanmax(sigmas))
    orders = math.floor(math.log10(_VISIBLE / (_SIGMAS * largest))) if largest > 0 else 0
    factor = 10.0 ** max(0, orders)
    values, axes = np.linalg.eigh(timeline.covariance[at[mine]])
    axes[np.linalg.det(axes) < 0, :, 0] *= -1
    half_sizes = _SIGMAS * factor * np.sqrt(np.maximum(values, 0))
    writer.ellipsoids(f"{LIVE}/covariance", timeline.stamps[at[mine]], np.maximum(half_sizes, 1e-4),
                      axes, run.live.rows[theirs, 1:4], _BLUE)
    return factor


def _write_errors(writer: Writer, run: RunFolder, corrected: Array, live: Array) -> list[str]:
    stamps, errors = position_errors(run.truth, run.estimate, corrected)
    writer.scalars("plots/error_mm/corrected", stamps, 1000 * errors, "corrected", _ORANGE)
    stamps, errors = position_errors(run.truth, run.live, live)
    writer.scalars("plots/error_mm/live", stamps, 1000 * errors, "live", _BLUE)
    steps = np.linalg.norm(np.diff(run.truth.rows[:, 1:4], axis=0), axis=1)
    driven = np.concatenate([[0.0], np.cumsum(steps)])[np.searchsorted(run.truth.stamps, stamps)
                                                       .clip(max=len(steps))]
    far = driven >= _DISTANCE
    writer.scalars("plots/drift_percent/live", stamps[far], 100 * errors[far] / driven[far], "live",
                   _BLUE)
    return ["plots/error_mm", *(["plots/drift_percent"] if far.any() else [])]


def write_plots(writer: Writer, run: RunFolder, corrected: Array, live: Array) -> list[str]:
    """Errors, and what the timeline has. Returns the entities that are plots."""
    timeline = run.timeline
    plots = _write_errors(writer, run, corrected, live) if len(run.truth) else []
    writer.scalars("plots/sigma_mm/live", timeline.stamps, 1000 * _largest_sigmas(timeline), "live",
                   _BLUE)
    for what, cameras in timeline.counts.items():
        for i, (camera, counts) in enumerate(cameras.items()):
            writer.scalars(f"plots/{what}/{writer.part(camera)}", timeline.stamps, counts, camera,
                           _CAMERAS[i % len(_CAMERAS)])
    status = np.array([_STATUS.get(name, math.nan) for name in timeline.status])
    writer.scalars("plots/status/status", timeline.stamps, status,
                   ", ".join(f"{value:.0f} {name}" for name, value in _STATUS.items()))
    return [*plots, "plots/sigma_mm", "plots/status",
            *(f"plots/{what}" for what in timeline.counts)]


def write_imu(writer: Writer, readings: Array) -> list[str]:
    """Returns the entities that are plots."""
    stamps = readings[:, 0].astype(np.int64)
    for k, name in enumerate(("rate_x", "rate_y", "rate_z", "force_x", "force_y", "force_z")):
        writer.scalars(f"imu/{name}", stamps, readings[:, 1 + k],
                       f"{name}, {'rad/s' if k < 3 else 'm/s²'}")
    return ["imu"] if len(stamps) else []


def _level(event: Mapping[str, Any]) -> str:
    if event["event"] == "loop_closure" and event.get("correct") is False:
        return "ERROR"
    if event["event"] in _WARNINGS:
        return "WARN"
    return "DEBUG" if event["event"] == "keyframe" else "INFO"


def _text(event: Mapping[str, Any]) -> str:
    parts = [f"{name} {value:.4g}" if isinstance(value, float) else f"{name} {value}"
             for name, value in event.items() if name not in ("t", "frame", "event")]
    return ": ".join([event["event"], *([", ".join(parts)] if parts else [])])


def write_events(writer: Writer, run: RunFolder) -> None:
    """As texts, with their level."""
    stamps = np.array([round(event["t"] * 1e9) for event in run.events], np.int64)
    writer.texts("events", stamps, [_text(event) for event in run.events],
                 [_level(event) for event in run.events])


def write_summary(writer: Writer, run: RunFolder, factor: float, how: str) -> None:
    """What the run has come to, and what the 3D view shows."""
    metrics = "\n".join(f"| {name} | {value} |" for name, value in run.metrics.items()
                        if isinstance(value, (str, int, float)) and not isinstance(value, bool))
    notes = [f"Covariance: {_SIGMAS} standard deviations, enlarged {factor:.0f} times.",
             f"Alignment of the map with the world: {how}." if len(run.truth) else ""]
    writer.document("summary", "\n\n".join(
        ["\n".join(["| metric | |", "|---|---|", metrics]) if metrics else "", run.summary.strip(),
         *notes]))
