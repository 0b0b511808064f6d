# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a scenario on topics of ROS 2 and judges the poses that a SLAM system publishes.

    python -m vinebench.ros2 quick-loop --pose-topic /slam/pose --out out/mine

docs/ros2.md has topics, frames and what the options mean.
"""
from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Sequence
from types import FrameType
from typing import Any, Optional

import numpy as np

from vinebench._load import core
from vinebench._ros_poses import BODY, TYPES, PoseFrames
from vinebench._ros_system import Pace, Ros2System
from vinebench._ros_topics import Topics, has_transforms, pose_types, tell
from vinebench.results import Report
from vinebench.running import run

_TRUTH = ("/ground_truth", "/tf")
_BEHIND = 0.1  # s of wall time, later than this is told
_BAD_INPUT, _FAILED, _SIGNAL = 2, 1, 128  # exit codes, as of the program


def _positive(text: str) -> float:
    number = float(text)
    if not 0 < number < 1e6:
        raise argparse.ArgumentTypeError(f"expected a number above 0, found {text}")
    return number


def _setting(text: str) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    if not key or not equals:
        raise argparse.ArgumentTypeError(f"expected KEY=VALUE, found '{text}'")
    return key, value


def arguments_parser() -> argparse.ArgumentParser:
    """The options of the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m vinebench.ros2", allow_abbrev=False,
        description="Runs a scenario on topics of ROS 2 and judges the poses that come back.")
    parser.add_argument("scenario", metavar="SCENARIO", help="a scenario's file or name")
    parser.add_argument("--seed", type=int, help="seed in place of the scenario's")
    parser.add_argument("--set", type=_setting, action="append", default=[], metavar="KEY=VALUE",
                        help="set a key of the scenario; may be repeated")
    parser.add_argument("--randomise", metavar="FILE", help="distributions for keys")
    parser.add_argument("--out", metavar="FOLDER", help="folder for the results (default: none)")
    parser.add_argument("--threads", type=int, help="threads to share the work")
    pace = parser.add_mutually_exclusive_group()
    pace.add_argument("--lockstep", action="store_true",
                      help="wait for the pose of each frame (default)")
    pace.add_argument("--rate", type=_positive, metavar="R",
                      help="publish at R times real time, and take poses as they come")
    parser.add_argument("--pose-topic", default="/slam/pose", metavar="TOPIC",
                        help="the system under test publishes its poses there (default: %(default)s)")
    parser.add_argument("--pose-type", choices=[name.rsplit("/", 1)[1] for name in TYPES],
                        help="type of the pose topic (default: that of its publisher)")
    parser.add_argument("--path-topic", metavar="TOPIC",
                        help="nav_msgs/Path of the trajectory after all corrections")
    parser.add_argument("--pose-of", default=BODY, metavar="NAME",
                        help="whose pose it is: base_link (default), or a camera of the rig")
    parser.add_argument("--child-frame", metavar="FRAME",
                        help="what Odometry messages call it (child_frame_id)")
    parser.add_argument("--map-frame", metavar="FRAME",
                        help="frame_id of the poses (default: that of the first one)")
    parser.add_argument("--timeout", type=_positive, default=2.0, metavar="S",
                        help="wait so long for a frame's pose, s (default: 2)")
    parser.add_argument("--lag", type=int, choices=range(100), default=0, metavar="N",
                        help="in lockstep: a pose may come N frames later (default: 0)")
    parser.add_argument("--give-up", type=_positive, default=60.0, metavar="S",
                        help="the system has failed after S without any pose (default: 60)")
    parser.add_argument("--wait", type=_positive, default=30.0, metavar="S",
                        help="wait so long for the system's nodes (default: 30)")
    parser.add_argument("--images", choices=["raw", "png", "jpg"], default="raw",
                        help="raw images, or compressed ones (default: raw)")
    parser.add_argument("--colour", action="store_true", help="images in colour, not grey")
    parser.add_argument("--truth", action="store_true",
                        help="also publish the true poses, each after its frame's answer")
    return parser


def pose_frames(options: argparse.Namespace, rig: Any) -> PoseFrames:
    """Of --pose-of, --child-frame and --map-frame. Raises Error for a camera that the rig lacks."""
    T_body_child, own = np.eye(4), BODY
    if options.pose_of != BODY:
        camera = next((c for c in rig.cameras if c.name == options.pose_of), None)
        if camera is None:
            names = ", ".join([BODY, *(c.name for c in rig.cameras)])
            raise core.Error(f"--pose-of: expected one of {names}, found '{options.pose_of}'")
        T_body_child, own = camera.T_body_camera, f"{camera.name}_optical_frame"
    return PoseFrames(T_body_child, frozenset({options.child_frame or own, ""}), options.map_frame)


class _Bridge:
    """The run from the command line, and its interruption by a signal."""

    def __init__(self, options: argparse.Namespace) -> None:
        self._options = options
        self._given = {"seed": options.seed, "set": dict(options.set),
                       "randomise": options.randomise}
        self._signal = 0
        self._system: Optional[Ros2System] = None

    def interrupt(self, number: int, _: Optional[FrameType]) -> None:
        """Ends the run after its frame; once more ends the program."""
        self._signal = number
        signal.signal(number, signal.SIG_DFL)
        if self._system is not None:
            self._system.stopped = True

    def run(self) -> int:
        """Returns the exit code."""
        options = self._options
        transforms = has_transforms()
        messages = core.RosMessages(options.scenario, colour=options.colour, images=options.images,
                                    tags=transforms, **self._given)
        topics = Topics(lambda: self._signal != 0)
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self.interrupt)
        try:
            return self._run(topics, messages, transforms)
        except core.Error:
            if self._signal:  # while it waited for nodes
                return self._stopped_early()
            raise
        finally:
            topics.close()

    def _run(self, topics: Topics, messages: Any, transforms: bool) -> int:
        options = self._options
        pace = Pace(options.rate, options.lag, options.timeout, options.give_up)
        self._system = Ros2System(topics, messages, options.pose_topic,
                                  pose_frames(options, messages.rig), pace)
        self._connect(topics, messages, transforms)
        if self._signal:
            return self._stopped_early()

        def on_truth(stamp: int, T_world_body: Any) -> None:
            for topic, _, message in messages.of_truth(stamp, T_world_body):
                topics.publish(topic, message)

        report = run(options.scenario, out=options.out, threads=options.threads,
                     slam=self._system, progress=True, on_truth=on_truth if options.truth else None,
                     **self._given)
        return self._tell(report)

    def _stopped_early(self) -> int:
        tell("stopped before the first frame")
        return _SIGNAL + self._signal

    def _connect(self, topics: Topics, messages: Any, transforms: bool) -> None:
        """Waits for the system under test."""
        assert self._system is not None
        options = self._options
        topics.advertise(topic for topic in messages.topics
                         if (options.truth or topic[0] not in _TRUTH)
                         and (transforms or not topic[1].startswith("tf2_msgs/")))
        if not transforms:
            tell("tf2_msgs of ROS 2 is not installed: no /tf_static, /tags and /tf")
        kind = topics.subscribe(options.pose_topic, pose_types(options.pose_type), options.wait,
                                self._system.take)
        if options.path_topic:
            topics.subscribe(options.path_topic, ["nav_msgs/msg/Path"], options.wait,
                             self._system.take_path)
        topics.expect_subscribers(options.wait)
        tell(f"{options.pose_topic}: {kind}")

    def _tell(self, report: Report) -> int:
        assert self._system is not None
        self._tell_times(self._system)
        where = f"results: {report.folder.resolve()}\n" if report.folder else ""
        print(f"\n{report}\n{report.summary}{where}", end="")
        if self._signal:
            kept = f"; what there is of them is in {report.folder}" if report.folder else ""
            tell(f"stopped after {report.frames} frames{kept}")
            return _SIGNAL + self._signal
        return 0 if report.passed else _FAILED

    def _tell_times(self, system: Ros2System) -> None:
        if system.late > _BEHIND:
            tell(f"the simulation is slower than {self._options.rate:g} times real time: frames "
                 f"came up to {system.late:.1f} s late")
        if system.latencies:
            median, most = np.percentile(system.latencies, [50, 95])
            tell(f"from a frame to its pose: {1000 * median:.0f} ms (median), {1000 * most:.0f} ms "
                 f"(95 %)")


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs by the command line's arguments and returns the exit code."""
    try:
        return _Bridge(arguments_parser().parse_args(arguments)).run()
    except core.Error as error:
        tell(str(error))
        return _BAD_INPUT


if __name__ == "__main__":
    sys.exit(main())
