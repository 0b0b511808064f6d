# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Images of a run for a recording of Rerun: of a data set, or those that the run kept."""
from __future__ import annotations

import dataclasses
import functools
import importlib
import io
import pathlib
import re
from collections.abc import Callable, Iterator
from typing import Any, Optional

import numpy as np

from vinebench._load import core
from vinebench._run_folder import RunFolder, Stamps, json_object, nearest, text_of
from vinebench.trajectories import Array, to_matrices

_FURTHEST = 0.01  # m, between the true poses of a run and of its recording
PIXEL_CORNER = np.array([[0, 0, 0.5], [0, 0, 0.5], [0, 0, 0]])
"""What is added to K where pixel (0, 0) is the corner of the top left pixel, and not its centre."""
_KEPT = re.compile(r"(\d{6,})_(.+)\.png")


@dataclasses.dataclass(frozen=True, eq=False)
class View:
    """A camera as its images are delivered."""

    name: str
    width: int
    height: int
    K: Array
    """(3, 3), px; pixel (0, 0) is the centre of the top left pixel."""
    T_body_camera: Array


@dataclasses.dataclass(frozen=True, eq=False)
class Picture:
    """An image of a camera; `open` decodes it."""

    stamp: int
    camera: str
    open: Callable[[], Any]


@dataclasses.dataclass(frozen=True, eq=False)
class Pictures:
    """Where a run's images come from."""

    views: list[View]
    each: Callable[[], Iterator[Picture]]
    """In order of time."""
    imu: Array
    """(N, 7): ns, rad/s x y z, m/s² x y z, in the body's axes; empty where unknown."""


def _open(file: pathlib.Path) -> Any:
    """An image of Pillow, which rerun-sdk needs, decoded."""
    pillow = importlib.import_module("PIL.Image")
    try:
        image = pillow.open(file)
        image.load()
    except (OSError, ValueError, SyntaxError, pillow.DecompressionBombError) as error:
        raise core.Error(f"{file}: not an image ({error})") from error
    return image if image.mode in ("L", "RGB") else image.convert("RGB")


def scaled(view: View, most: int) -> View:
    """With images at most so high, px."""
    if view.height <= most:
        return view
    width, height = max(1, round(view.width * most / view.height)), most
    zoom = np.diag([width / view.width, height / view.height, 1])
    K = zoom @ (view.K + PIXEL_CORNER) - PIXEL_CORNER
    return View(view.name, width, height, K, view.T_body_camera)


def jpeg(image: Any, view: View, quality: int) -> bytes:
    """Of the view's size."""
    if image.size != (view.width, view.height):
        pillow = importlib.import_module("PIL.Image")
        image = image.resize((view.width, view.height), pillow.BOX)
    stream = io.BytesIO()
    image.save(stream, "JPEG", quality=quality)
    return stream.getvalue()


def _euroc_folder(folder: pathlib.Path) -> pathlib.Path:
    """Of the data set, of its EuRoC folder, or of mav0."""
    for candidate in (folder / "euroc", folder, folder.parent if folder.name == "mav0" else folder):
        if (candidate / "mav0").is_dir() and (candidate / "rig.yaml").is_file():
            return candidate
    raise core.Error(f"{folder}: expected a recording in EuRoC format by vinebench, with mav0 and "
                     "rig.yaml (vinebench run SCENARIO --record FOLDER)")


def _lines(file: pathlib.Path, columns: int) -> Iterator[tuple[str, list[str]]]:
    for number, line in enumerate(text_of(file).splitlines(), 1):
        fields = line.split(",")
        if line.startswith("#"):
            continue
        if len(fields) < columns:
            raise core.Error(f"{file}:{number}: expected {columns} columns, found {len(fields)}")
        yield f"{file}:{number}", fields


def _stamp(text: str, where: str) -> int:
    if not re.fullmatch(r" *[0-9]{1,19} *", text) or int(text) > np.iinfo(np.int64).max:
        raise core.Error(f"{where}: expected a stamp in ns, found '{text}'")
    return int(text)


def _numbers(file: pathlib.Path, columns: int) -> tuple[Stamps, Array]:
    """Stamps, and the columns after them; none if there is no file."""
    stamps, rows = [], []
    for where, fields in _lines(file, columns) if file.exists() else ():
        stamps.append(_stamp(fields[0], where))
        try:
            rows.append([float(text) for text in fields[1:columns]])
        except ValueError:
            raise core.Error(f"{where}: expected numbers, found '{','.join(fields)}'") from None
    return np.array(stamps, np.int64), np.array(rows).reshape(-1, columns - 1)


def _listed(camera: str, folder: pathlib.Path) -> Iterator[Picture]:
    for where, fields in _lines(folder / "data.csv", 2):
        file = folder / "data" / fields[1].strip()
        yield Picture(_stamp(fields[0], where), camera, functools.partial(_open, file))


def _check_same_run(folder: pathlib.Path, euroc: pathlib.Path, run: RunFolder,
                    pictures: list[Picture]) -> None:
    """Raises Error if the recording is of another run."""
    stamps = np.array(sorted({picture.stamp for picture in pictures}), np.int64)
    if not len(nearest(run.timeline.stamps, stamps)[0]):
        raise core.Error(f"{folder}: no image has the time of a frame of {run.folder}")
    truth = euroc / "mav0/state_groundtruth_estimate0/data.csv"
    recorded, rows = _numbers(truth, 4)
    mine, theirs = nearest(recorded, run.truth.stamps)
    apart = np.linalg.norm(run.truth.rows[mine, 1:4] - rows[theirs], axis=1)
    if len(apart) and apart.max() > _FURTHEST:
        raise core.Error(f"{folder}: the recording of another run than {run.folder}: true "
                         f"positions differ by up to {apart.max():.3g} m")


def pictures_of_recording(folder: pathlib.Path, run: RunFolder) -> Pictures:
    """Raises Error for a folder that is no recording of this run."""
    euroc = _euroc_folder(folder)
    cameras = core.Rig.load(str(euroc / "rig.yaml")).cameras
    pictures = [picture for i, camera in enumerate(cameras)
                for picture in _listed(camera.name, euroc / f"mav0/cam{i}")]
    pictures.sort(key=lambda picture: picture.stamp)
    _check_same_run(folder, euroc, run, pictures)
    stamps, readings = _numbers(euroc / "mav0/imu0/data.csv", 7)
    return Pictures([View(c.name, c.width, c.height, c.K, c.T_body_camera) for c in cameras],
                    lambda: iter(pictures), np.column_stack([stamps, readings]))


def _site_view(camera: dict[str, Any]) -> View:
    width, height = int(camera["width"]), int(camera["height"])
    T_body_camera = to_matrices(np.array([[0, *camera["T_body_cam"]]], np.float64))[0]
    K = np.array([[camera["fx"], 0, (width - 1) / 2], [0, camera["fy"], (height - 1) / 2],
                  [0, 0, 1]], np.float64)
    if min(width, height) < 1 or not np.isfinite(K).all() or not np.isfinite(T_body_camera).all():
        raise ValueError("a number out of range")
    return View(str(camera["name"]), width, height, K, T_body_camera)


def site_views(run: RunFolder) -> list[View]:
    """The rig's cameras by site.json, which has no principal point: it is in the middle."""
    try:
        return [_site_view(camera) for camera in run.site.get("cameras", [])]
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise core.Error(f"{run.folder / 'site.json'}: cameras: expected name, width, height, fx, "
                         f"fy and T_body_cam ({error})") from error


def _of_film(run: RunFolder, index: dict[str, Any], stamps: dict[int, int]) -> Iterator[Picture]:
    for entry in index["pictures"]:
        frame = int(entry["frame"])
        if frame not in stamps:
            continue
        strip = _open(run.folder / f"film/{frame:06d}.jpg")
        for cell in index["cells"]:
            x, width = int(cell["x"]), int(cell["width"])
            box = (x, 0, x + width, strip.size[1])
            yield Picture(stamps[frame], str(cell["camera"]),
                          functools.partial(strip.crop, box))


def _film(run: RunFolder, views: list[View], stamps: dict[int, int]) -> Pictures:
    file = run.folder / "film/film.json"
    index = json_object(text_of(file), str(file))
    try:
        height = int(index["height"])
        own = {str(cell["camera"]) for cell in index["cells"]}
        [(int(e["frame"]), int(c["x"]), int(c["width"])) for c in index["cells"]
         for e in index["pictures"]]
        if height < 1 or not all(int(cell["width"]) > 0 for cell in index["cells"]):
            raise ValueError("a number out of range")
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise core.Error(f"{file}: expected height, cells and pictures ({error})") from error
    return Pictures([scaled(view, height) for view in views if view.name in own],
                    lambda: _of_film(run, index, stamps), np.zeros((0, 7)))


def _kept(run: RunFolder, views: list[View], stamps: dict[int, int]) -> Pictures:
    found = [(match, file) for file in sorted((run.folder / "frames").glob("*.png"))
             if (match := _KEPT.fullmatch(file.name)) and int(match[1]) in stamps]
    pictures = [Picture(stamps[int(match[1])], match[2], functools.partial(_open, file))
                for match, file in found]
    return Pictures(views, lambda: iter(pictures), np.zeros((0, 7)))


def pictures_of_run(run: RunFolder) -> Pictures:
    """The film that --report keeps, else the twelve frames of every run."""
    views = site_views(run)
    stamps = dict(zip(run.timeline.frames.tolist(), run.timeline.stamps.tolist()))
    if (run.folder / "film/film.json").is_file():
        return _film(run, views, stamps)
    return _kept(run, views, stamps)
