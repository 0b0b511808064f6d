# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Writes a run as a recording for the viewer of Rerun (rerun.io), which this module needs.

    python -m vinebench.rerun out/first --recording data --out first.rrd

docs/rerun.md has the entities and what the options mean.
"""
from __future__ import annotations

import argparse
import pathlib
import sys
from collections.abc import Sequence
from typing import Any, Optional

from vinebench._load import core
from vinebench import _rerun_scene as scene
from vinebench._point_cloud import PointCloud, read_cloud
from vinebench._rerun_layout import layout
from vinebench._rerun_pictures import (Pictures, View, jpeg, pictures_of_recording, pictures_of_run,
                                       scaled)
from vinebench._rerun_writer import Writer, load_sdk
from vinebench._run_folder import RunFolder, read_run

_BAD_INPUT, _INTERRUPTED = 2, 130  # exit codes, as of the program


def _whole(least: int, most: int) -> Any:
    def number(text: str) -> int:
        if not text.isdigit() or not least <= int(text) <= most:
            raise argparse.ArgumentTypeError(f"expected {least} to {most}, found '{text}'")
        return int(text)
    return number


def arguments_parser() -> argparse.ArgumentParser:
    """The options of the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m vinebench.rerun", allow_abbrev=False,
        description="Writes a run as a recording for the viewer of Rerun.")
    parser.add_argument("run", metavar="RUN", type=pathlib.Path, help="results folder of a run")
    parser.add_argument("--out", metavar="FILE.rrd", type=pathlib.Path, required=True,
                        help="file to write")
    parser.add_argument("--recording", metavar="DIR", type=pathlib.Path,
                        help="data set of the run in EuRoC format: images and inertial readings")
    parser.add_argument("--cloud", metavar="FILE.ply", type=pathlib.Path,
                        help="landmarks (default: RUN/landmarks.ply, if there)")
    parser.add_argument("--every", metavar="N", type=_whole(1, 10**9), default=1,
                        help="images of every N-th frame (default: 1)")
    parser.add_argument("--height", metavar="PX", type=_whole(16, 65500), default=480,
                        help="higher images are made smaller, px (default: 480)")
    parser.add_argument("--quality", metavar="Q", type=_whole(1, 95), default=75,
                        help="of the JPEG images, 1 to 95 (default: 75)")
    parser.add_argument("--cameras", metavar="C[,C]", help="names of cameras (default: all)")
    parser.add_argument("--align", choices=["first", "all", "none"], default="first",
                        help="map to world by the first pose (default), by all poses, or not")
    return parser


def chosen(views: list[View], names: Optional[str]) -> list[View]:
    """Of --cameras. Raises Error for a camera that is not among them."""
    if names is None:
        return views
    wanted = names.split(",")
    for name in wanted:
        if name not in {view.name for view in views}:
            known = ", ".join(view.name for view in views) or "none"
            raise core.Error(f"--cameras: expected some of {known}, found '{name}'")
    return [view for view in views if view.name in wanted]


class _Conversion:
    """A run on its way into the file."""

    def __init__(self, options: argparse.Namespace) -> None:
        self._options = options
        self._run: RunFolder = read_run(options.run)
        self._cloud = self._read_cloud()
        self._pictures: Pictures = (pictures_of_recording(options.recording, self._run)
                                    if options.recording else pictures_of_run(self._run))
        self._views = {view.name: scaled(view, options.height)
                       for view in chosen(self._pictures.views, options.cameras)}

    def _read_cloud(self) -> Optional[PointCloud]:
        file = self._options.cloud or self._options.run / "landmarks.ply"
        return read_cloud(file) if self._options.cloud or file.exists() else None

    def write(self) -> None:
        """Writes the file; there is none if it fails."""
        run, options = self._run, self._options
        with Writer(load_sdk(), options.out, run.timeline, self._name()) as writer:
            body = f"{scene.TRUTH if len(run.truth) else f'{scene.MAP}/estimate'}/body"
            entities = {name: f"{body}/{writer.part(name)}" for name in self._views}
            scene.write_site(writer, run)
            corrected, live = scene.write_paths(writer, run, self._cloud, options.align)
            factor = scene.write_covariance(writer, run)
            plots = [*scene.write_plots(writer, run, corrected, live),
                     *scene.write_imu(writer, self._pictures.imu)]
            scene.write_events(writer, run)
            scene.write_summary(writer, run, factor, options.align)
            self._write_images(writer, entities)
            writer.lay_out(layout([(name, f"/{at}") for name, at in entities.items()], plots))

    def _name(self) -> str:
        metrics = self._run.metrics
        name = metrics.get("scenario") or self._options.run.resolve().name
        return f"{name} (seed {metrics['seed']})" if "seed" in metrics else str(name)

    def _write_images(self, writer: Writer, entities: dict[str, str]) -> None:
        options, timeline = self._options, self._run.timeline
        for name, view in self._views.items():
            writer.camera(entities[name], view)
        stamps = set(timeline.stamps[timeline.frames % options.every == 0].tolist())
        for picture in self._pictures.each():
            if picture.camera in self._views and picture.stamp in stamps:
                writer.image(entities[picture.camera], picture.stamp,
                             jpeg(picture.open(), self._views[picture.camera], options.quality))


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Writes by the command line's arguments and returns the exit code."""
    options = arguments_parser().parse_args(arguments)
    try:
        _Conversion(options).write()
    except core.Error as error:
        print(f"vinebench.rerun: {error}", file=sys.stderr)
        return _BAD_INPUT
    except KeyboardInterrupt:
        print("vinebench.rerun: interrupted; nothing was written", file=sys.stderr)
        return _INTERRUPTED
    print(f"{options.out} ({options.out.stat().st_size / 1e6:.1f} MB)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
