# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the files of a run's results folder (docs/running.md)."""
from __future__ import annotations

import csv
import dataclasses
import json
import pathlib
from collections.abc import Iterator
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from vinebench._load import core
from vinebench.trajectories import Array, to_matrices

Stamps = npt.NDArray[np.int64]

_NANOSECONDS = 10**9
_LONGEST = 9 * 10**9  # s; more is no stamp in ns
_NEAR = 10**7  # ns, between a true and an estimated pose of one frame, as in the evaluation
_FIRST = ["t", "frame", "status", "keyframe", "xx", "xy", "xz", "yy", "yz", "zz"]
_CAMERAS = len(_FIRST)  # first column of what cameras saw
_COUNTS = ("features", "inliers", "occluded")


@dataclasses.dataclass(frozen=True, eq=False)
class Path:
    """A trajectory with stamps in ns."""

    stamps: Stamps
    rows: Array
    """(N, 8), as of a TUM file."""

    def __len__(self) -> int:
        return len(self.stamps)

    def matrices(self) -> Array:
        """(N, 4, 4)"""
        return to_matrices(self.rows)


@dataclasses.dataclass(frozen=True, eq=False)
class Timeline:
    """timeline.csv: the frames of a run."""

    stamps: Stamps
    frames: Stamps
    status: list[str]
    covariance: Array
    """(N, 3, 3), m², in the map's axes; NaN where unknown."""
    counts: dict[str, dict[str, Array]]
    """"features", "inliers", "occluded", each by camera; NaN where unknown."""

    def frames_at(self, stamps: Stamps) -> Stamps:
        """The last frame no later than each stamp; the first one before it."""
        at = np.searchsorted(self.stamps, stamps, side="right") - 1
        return np.asarray(self.frames[np.maximum(at, 0)])


@dataclasses.dataclass(frozen=True, eq=False)
class RunFolder:
    """What a run wrote; a trajectory is empty where there is no file of it."""

    folder: pathlib.Path
    timeline: Timeline
    truth: Path
    estimate: Path
    live: Path
    keyframes: Path
    events: list[dict[str, Any]]
    site: dict[str, Any]
    metrics: dict[str, Any]
    summary: str


def text_of(file: pathlib.Path) -> str:
    """A text file. Raises Error where it cannot be read."""
    try:
        return file.read_text(encoding="utf-8")
    except OSError as error:
        raise core.Error(f"{file}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise core.Error(f"{file}: expected text, found the byte {error.object[error.start]:#04x} "
                         f"at {error.start}") from error


def json_object(text: str, where: str) -> dict[str, Any]:
    """Raises Error for what is no JSON object."""
    try:
        found = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise core.Error(f"{where}: not valid JSON ({error})") from error
    if not isinstance(found, dict):
        raise core.Error(f"{where}: expected a JSON object, found {type(found).__name__}")
    return found


def is_time(value: Any) -> bool:
    """Whether it is a number of seconds that a stamp can have."""
    return isinstance(value, (int, float)) and abs(value) < _LONGEST


def nearest(stamps: Stamps, wanted: Stamps) -> tuple[Stamps, Stamps]:
    """Indices of pairs at most 0.01 s apart: into `wanted`, and of the nearest into `stamps`."""
    if not len(stamps) or not len(wanted):
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    after = np.clip(np.searchsorted(stamps, wanted), 1, max(1, len(stamps) - 1))
    after = np.minimum(after, len(stamps) - 1)
    before = np.maximum(after - 1, 0)
    closer = np.abs(stamps[before] - wanted) <= np.abs(stamps[after] - wanted)
    at = np.where(closer, before, after)
    near = np.nonzero(np.abs(stamps[at] - wanted) <= _NEAR)[0]
    return near, at[near]


def read_path(file: pathlib.Path) -> Path:
    """A TUM file; empty if there is none."""
    if not file.exists():
        return Path(np.zeros(0, np.int64), np.zeros((0, 8)))
    rows = core.read_tum(str(file))
    if not (np.abs(rows[:, 0]) < _LONGEST).all():
        raise core.Error(f"{file}: expected times in s, found {np.abs(rows[:, 0]).max():g}")
    return Path(np.rint(rows[:, 0] * _NANOSECONDS).astype(np.int64), rows)


def _number(text: str, where: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise core.Error(f"{where}: expected a number, found '{text}'") from None


def _table(file: pathlib.Path) -> Iterator[tuple[str, list[str]]]:
    """Lines with their places."""
    rows = csv.reader(text_of(file).splitlines(), strict=True)
    try:
        for fields in rows:
            yield f"{file}:{rows.line_num}", fields
    except csv.Error as error:
        raise core.Error(f"{file}:{rows.line_num}: {error}") from error


def _columns(header: list[str], file: pathlib.Path) -> list[tuple[str, str]]:
    """What and of which camera, of the columns after the first ones."""
    cameras = [tuple(name.split(":", 1)) for name in header[_CAMERAS:]]
    if header[:_CAMERAS] != _FIRST or any(len(c) != 2 or c[0] not in _COUNTS for c in cameras):
        raise core.Error(f"{file}:1: expected the columns {', '.join(_FIRST)} and features:CAMERA, "
                         f"inliers:CAMERA, occluded:CAMERA, found {', '.join(header)}")
    return [(what, camera) for what, camera in cameras]


def read_timeline(file: pathlib.Path) -> Timeline:
    """Raises Error with file and line for what is no timeline."""
    lines = list(_table(file))
    if len(lines) < 2:
        raise core.Error(f"{file}: expected a header and a line a frame, found {len(lines)} lines")
    columns = _columns(lines[0][1], file)
    status = []
    numbers = np.zeros((len(lines) - 1, len(lines[0][1])))
    for i, (where, fields) in enumerate(lines[1:]):
        if len(fields) != numbers.shape[1]:
            raise core.Error(f"{where}: expected {numbers.shape[1]} columns, found {len(fields)}")
        status.append(fields[2])
        numbers[i] = [_number(text, where) for text in [*fields[:2], "0", *fields[3:]]]
        if not (np.abs(numbers[i, :2]) < _LONGEST).all() or (i and not (numbers[i - 1, :2]
                                                                < numbers[i, :2]).all()):
            raise core.Error(f"{where}: expected ascending times and frames, found {fields[0]}, "
                             f"{fields[1]}")
    counts: dict[str, dict[str, Array]] = {what: {} for what in _COUNTS}
    for k, (what, camera) in enumerate(columns):
        counts[what][camera] = numbers[:, _CAMERAS + k]
    return Timeline(np.rint(numbers[:, 0] * _NANOSECONDS).astype(np.int64),
                    numbers[:, 1].astype(np.int64), status,
                    numbers[:, [4, 5, 6, 5, 7, 8, 6, 8, 9]].reshape(-1, 3, 3), counts)


def read_events(file: pathlib.Path) -> list[dict[str, Any]]:
    """Each with `t` (s), `frame` and `event`. Raises Error with file and line."""
    events = []
    for number, line in enumerate(text_of(file).splitlines(), 1):
        event = json_object(line, f"{file}:{number}")
        if not is_time(event.get("t")) or not isinstance(event.get("event"), str):
            raise core.Error(f"{file}:{number}: expected an event with \"t\" and \"event\"")
        events.append(event)
    return events


def read_run(folder: pathlib.Path) -> RunFolder:
    """Raises Error with the file and the place for a folder that is no run's."""
    if not (folder / "timeline.csv").is_file() or not (folder / "estimate.tum").is_file():
        raise core.Error(f"{folder}: expected the results folder of a run, with timeline.csv and "
                         "estimate.tum (vinebench run SCENARIO --out FOLDER)")

    def if_there(name: str) -> str:
        file = folder / name
        return text_of(file) if file.exists() else ""

    def json_if_there(name: str) -> dict[str, Any]:
        text = if_there(name)
        return json_object(text, str(folder / name)) if text else {}

    events = folder / "events.jsonl"
    return RunFolder(folder, read_timeline(folder / "timeline.csv"),
                     read_path(folder / "groundtruth.tum"), read_path(folder / "estimate.tum"),
                     read_path(folder / "estimate_live.tum"), read_path(folder / "keyframes.tum"),
                     read_events(events) if events.exists() else [], json_if_there("site.json"),
                     json_if_there("metrics.json"), if_there("summary.txt"))
