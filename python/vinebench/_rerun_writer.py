# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Writes a file of Rerun. This and _rerun_layout.py are the only files that know its SDK."""
from __future__ import annotations

import importlib
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from types import TracebackType
from typing import Any, Optional

import numpy as np

from vinebench._load import core
from vinebench._piped_file import PipedFile
from vinebench._rerun_pictures import PIXEL_CORNER, View
from vinebench._run_folder import Stamps, Timeline
from vinebench.trajectories import Array, row_of

INSTALL = "install python/rerun-requirements.txt with pip (docs/rerun.md)"
_AXES = np.eye(3) * 0.25  # m, drawn of a body
_FRUSTUM = 0.35  # m, from a camera to its image in the 3D view

Colour = tuple[int, int, int]


def load_sdk() -> Any:
    """The package `rerun`. Raises Error where it is not installed, or another one is."""
    try:
        sdk = importlib.import_module("rerun")
    except ImportError as error:
        reason = str(error).splitlines()[0]
        raise core.Error(f"rerun cannot be imported ({reason}): {INSTALL}") from error
    if not hasattr(sdk, "RecordingStream") or not hasattr(sdk, "Scalars"):
        raise core.Error(f"rerun is not rerun-sdk 0.23 or newer: {INSTALL}")
    return sdk


class Writer:
    """A context: a file that has its name once it is whole. Raises Error if that fails."""

    def __init__(self, sdk: Any, file: pathlib.Path, timeline: Timeline, name: str) -> None:
        self.sdk = sdk
        sdk.set_strict_mode(True)  # else what cannot be written is left out with a warning
        self._file = file
        self._timeline = timeline
        self._name = name

    def __enter__(self) -> Writer:
        try:
            self._output = PipedFile(self._file)
        except OSError as error:
            raise self._error(error) from error
        self._stream = self.sdk.RecordingStream("vinebench")
        self._stream.save(self._output.pipe)
        self._stream.send_recording_name(self._name)
        return self

    def __exit__(self, kind: Optional[type[BaseException]], _: Optional[BaseException],
                 __: Optional[TracebackType]) -> None:
        self._stream.flush()
        self._stream.disconnect()
        if kind is not None:
            self._output.discard()
            return
        try:
            self._output.finish()
        except OSError as error:
            raise self._error(error) from error

    def _error(self, error: OSError) -> Exception:
        return core.Error(f"{self._file}: cannot be written ({error.strerror})")

    def lay_out(self, blueprint: Any) -> None:
        """How the viewer shows it, until its user changes that."""
        self._stream.send_blueprint(blueprint)

    def part(self, name: str) -> str:
        """A name as a part of an entity's path."""
        return str(self.sdk.escape_entity_path_part(name))

    def static(self, entity: str, *archetypes: Any) -> None:
        """Without a time."""
        self._stream.log(entity, *archetypes, static=True)

    def rows(self, entity: str, stamps: Stamps, columns: Any) -> None:
        """A row at each stamp, on the timelines `time` and `frame`."""
        if not len(stamps):
            return
        sdk = self.sdk
        self._stream.send_columns(entity, [
            sdk.TimeColumn("time", duration=stamps.astype("timedelta64[ns]")),
            sdk.TimeColumn("frame", sequence=self._timeline.frames_at(stamps))], columns)

    def poses(self, entity: str, stamps: Stamps, rows: Array) -> None:
        """Transforms of the entity, as rows of a TUM file, with its axes."""
        self.rows(entity, stamps, self.sdk.Transform3D.columns(translation=rows[:, 1:4],
                                                               quaternion=rows[:, 4:8]))
        self.static(f"{entity}/axes", self.sdk.Arrows3D(
            vectors=_AXES, colors=[(220, 60, 60), (60, 180, 60), (70, 90, 230)]))

    def transform(self, entity: str, T: Array) -> None:
        """Of the whole run."""
        row = row_of(0, T)
        self.static(entity, self.sdk.Transform3D(translation=row[1:4], quaternion=row[4:8]))

    def line(self, entity: str, points: Array, colour: Colour) -> None:
        if len(points) > 1:
            self.static(entity, self.sdk.LineStrips3D([points], colors=[colour], radii=[0.008]))

    def lines(self, entity: str, strips: Sequence[Array], colours: Sequence[Colour]) -> None:
        if strips:
            self.static(entity, self.sdk.LineStrips3D(strips, colors=colours, radii=[0.008]))

    def points(self, entity: str, points: Array, colours: Any, radius: float) -> None:
        if len(points):
            self.static(entity, self.sdk.Points3D(points, colors=colours, radii=[radius]))

    def boxes(self, entity: str, boxes: Sequence[Mapping[str, Any]], **more: Any) -> None:
        """Each with `centre`, `size` (m) and `rotation` (quaternion x, y, z, w)."""
        if boxes:
            wires = self.sdk.components.FillMode.MajorWireframe  # nothing in an image is hidden
            self.static(entity, self.sdk.Boxes3D(
                centers=[box["centre"] for box in boxes],
                half_sizes=[np.array(box["size"]) / 2 for box in boxes],
                quaternions=np.array([box["rotation"] for box in boxes]), fill_mode=wires, **more))

    def scalars(self, entity: str, stamps: Stamps, values: Array, name: str,
                colour: Optional[Colour] = None) -> None:
        """A line of a plot; what is not a number is left out."""
        known = np.isfinite(values)
        self.static(entity, self.sdk.SeriesLines(names=[name], colors=colour and [colour]))
        self.rows(entity, stamps[known], self.sdk.Scalars.columns(scalars=values[known]))

    def texts(self, entity: str, stamps: Stamps, texts: Sequence[str],
              levels: Sequence[str]) -> None:
        self.rows(entity, stamps, self.sdk.TextLog.columns(text=texts, level=levels))

    def document(self, entity: str, markdown: str) -> None:
        self.static(entity, self.sdk.TextDocument(markdown, media_type="text/markdown"))

    def ellipsoids(self, entity: str, stamps: Stamps, half_sizes: Array,
                   rotations: Iterable[Array], centres: Array, colour: Colour) -> None:
        """One at each stamp; rotations (3, 3)."""
        poses = [np.block([[R, np.zeros((3, 1))], [np.zeros((1, 3)), np.ones((1, 1))]])
                 for R in rotations]
        self.static(entity, self.sdk.Ellipsoids3D.from_fields(colors=[colour]))
        self.rows(entity, stamps, self.sdk.Ellipsoids3D.columns(
            half_sizes=half_sizes, centers=centres,
            quaternions=np.array([row_of(0, pose)[4:8] for pose in poses])))

    def camera(self, entity: str, view: View) -> None:
        """A pinhole. In Rerun the centre of the top left pixel is (0.5, 0.5)."""
        K, sdk = view.K + PIXEL_CORNER, self.sdk
        self.transform(entity, view.T_body_camera)
        self.static(entity, sdk.Pinhole(image_from_camera=K, resolution=[view.width, view.height],
                                        camera_xyz=sdk.ViewCoordinates.RDF,
                                        image_plane_distance=_FRUSTUM))

    def image(self, entity: str, stamp: int, content: bytes) -> None:
        """A JPEG."""
        self.rows(entity, np.array([stamp], np.int64), self.sdk.EncodedImage.columns(
            blob=[content], media_type=["image/jpeg"]))
