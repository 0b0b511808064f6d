#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Runs ORB-SLAM3 from the PyPI package pyorbslam3 on the first stereo pair of a recording.

Every frame is tracked, one call after the other, at the recording's rate or slower. In OUTPUT:
  f_vinebench.txt  poses of the left camera after all corrections (t x y z qx qy qz qw, ns); frames
                   that were not tracked are left out
  live.txt         the same as they were when each frame was tracked, in seconds
  wheel.json       counts of frames, losses, maps' changes; CPU time, memory
  orb_slam3.txt    what ORB-SLAM3 prints
Exit code 2 where the package, the vocabulary or a part of the recording is missing.
"""
import argparse
import json
import os
import resource
import sys
import time
from pathlib import Path

TRAJECTORY = "f_vinebench.txt"
SETTINGS = ("orbslam3_rectified.yaml", "orbslam3_raw.yaml")


class InputError(Exception):
    pass


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("recording", type=Path, help="the folder above mav0")
    parser.add_argument("output", type=Path)
    parser.add_argument("--vocabulary", type=Path, default=os.environ.get("PYORBSLAM3_VOCAB"),
                        help="ORBvoc.txt, or of train_vocabulary.py (default: $PYORBSLAM3_VOCAB)")
    parser.add_argument("--settings", type=Path, help="default: those of the recording")
    parser.add_argument("--no-loops", action="store_true", help="without loop closing")
    parser.add_argument("--no-wait", action="store_true", help="faster than the recording's rate")
    return parser.parse_args()


def packages():
    """The modules cv2, numpy and pyorbslam3."""
    try:
        import cv2
        import numpy
        import pyorbslam3
    except ImportError as error:
        raise InputError(f"{error.name or error}: cannot be imported; "
                         "pip install pyorbslam3 opencv-python-headless") from None
    return cv2, numpy, pyorbslam3


def listed(camera):
    """File names of a camera by stamp, ns."""
    try:
        lines = (camera / "data.csv").read_text().splitlines()
        rows = [line.split(",") for line in lines if line.strip() and not line.startswith("#")]
        return {int(row[0]): camera / "data" / row[1].strip() for row in rows}
    except (OSError, ValueError, IndexError) as error:
        raise InputError(f"{camera / 'data.csv'}: cannot be read: {error}") from None


def stereo_frames(recording):
    """Stamp in ns, left and right file of each frame that both cameras have."""
    left, right = (listed(recording / "mav0" / name) for name in ("cam0", "cam1"))
    frames = [(stamp, left[stamp], right[stamp]) for stamp in sorted(left.keys() & right.keys())]
    if not frames:
        raise InputError(f"{recording}: cam0 and cam1 have no frame in common")
    return frames


def write_settings(options):
    """A copy of the settings in the output folder."""
    written = (options.recording / "settings" / name for name in SETTINGS)
    source = options.settings or next(filter(Path.is_file, written), None)
    if not source or not source.is_file():
        raise InputError(f"{source or options.recording / 'settings'}: no settings of ORB-SLAM3; give "
                         "--settings")
    text = source.read_text()
    if options.no_loops:
        text += "loopClosing: 0\n"
    file = options.output / "settings.yaml"
    file.write_text(text)
    return file


class Tracker:
    """ORB-SLAM3, and what it has answered so far."""

    def __init__(self, slam, ok, image_of):
        self.slam, self.ok, self.image_of = slam, ok, image_of
        self.live = []      # seconds, 4 x 4 matrix
        self.tracked = set()  # stamps, ns
        self.states = {}
        self.losses = 0
        self.changes = []   # seconds at which the map had changed
        self.reading = 0.0  # s of CPU time, this thread's
        self.was_tracked = False

    def frame(self, stamp, left, right):
        before = time.thread_time()
        images = self.image_of(left), self.image_of(right)
        self.reading += time.thread_time() - before
        result = self.slam.track_stereo(*images, stamp * 1e-9)
        tracked = result.state == self.ok and result.pose_wc is not None
        self.states[result.state.name] = self.states.get(result.state.name, 0) + 1
        self.losses += self.was_tracked and not tracked
        self.was_tracked = tracked
        if tracked:
            self.tracked.add(stamp)
            self.live.append((stamp * 1e-9, result.pose_wc))
        if self.slam.map_changed():
            self.changes.append(stamp * 1e-9)


def quaternion(rotation):
    """x, y, z, w of a rotation matrix, from the largest of its four squares."""
    m = rotation
    squares = [1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
               1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2]]
    sums = [[0, m[0][1] + m[1][0], m[0][2] + m[2][0], m[2][1] - m[1][2]],
            [m[0][1] + m[1][0], 0, m[1][2] + m[2][1], m[0][2] - m[2][0]],
            [m[0][2] + m[2][0], m[1][2] + m[2][1], 0, m[1][0] - m[0][1]],
            [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], 0]]
    largest = max(range(4), key=lambda i: squares[i])
    row = sums[largest]
    row[largest] = squares[largest]
    norm = sum(value * value for value in row) ** 0.5
    return [float(value) / norm for value in row]


def write_live(file, poses):
    lines = (f"{t:.9f} " + " ".join(f"{float(v):.9f}" for v in (*T[:3, 3], *quaternion(T)))
             for t, T in poses)
    file.write_text("".join(line + "\n" for line in lines))


def keep_tracked(source, target, stamps):
    """Copies the lines of the trajectory whose frames were tracked; returns their number."""
    lines = source.read_text().splitlines() if source.is_file() else []
    # Its stamps went through a double in seconds: off by less than 1 us.
    microseconds = {round(stamp / 1000) for stamp in stamps}
    kept = [line for line in lines
            if line and microseconds & {int(float(line.split()[0]) // 1000) + i for i in (0, 1)}]
    target.write_text("".join(line + "\n" for line in kept))
    return len(kept)


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def peak_rss_mib():
    """Not getrusage's, which begins with that of the process that has started this one."""
    status = Path("/proc/self/status").read_text()
    return int(status.split("VmHWM:")[1].split()[0]) / 1024


def run(options):
    cv2, _, pos = packages()
    if not options.vocabulary or not options.vocabulary.is_file():
        raise InputError(f"{options.vocabulary or 'no vocabulary'}: give ORBvoc.txt of ORB-SLAM3, or "
                         "a file of train_vocabulary.py, with --vocabulary")
    frames = stereo_frames(options.recording)
    options.output.mkdir(parents=True, exist_ok=True)
    (options.output / TRAJECTORY).unlink(missing_ok=True)
    settings = write_settings(options)
    cv2.setNumThreads(1)

    def image_of(file):
        image = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE)
        if image is None:
            raise InputError(f"{file}: cannot be read")
        return image

    slam = pos.Slam(str(options.vocabulary), str(settings), pos.Sensor.STEREO)
    loaded = cpu_seconds()
    tracker = Tracker(slam, pos.TrackingState.OK, image_of)
    for i, (stamp, left, right) in enumerate(frames):
        start = time.monotonic()
        tracker.frame(stamp, left, right)
        if not options.no_wait and i + 1 < len(frames):
            time.sleep(max(0.0, 1e-9 * (frames[i + 1][0] - stamp) - (time.monotonic() - start)))
    slam.shutdown()
    cpu = cpu_seconds() - loaded - tracker.reading
    write_live(options.output / "live.txt", tracker.live)
    everything = options.output / "f_all.txt"
    everything.unlink(missing_ok=True)
    slam.save_trajectory_euroc(str(everything))
    poses = keep_tracked(everything, options.output / TRAJECTORY, tracker.tracked)
    summary = {"frames": len(frames), "poses": poses, "tracked": len(tracker.tracked),
               "states": tracker.states, "losses": tracker.losses, "map_changes": tracker.changes,
               "cpu_ms_a_frame": 1e3 * cpu / len(frames), "peak_rss_mib": peak_rss_mib()}
    (options.output / "wheel.json").write_text(json.dumps(summary, indent=2) + "\n")


def main():
    options = arguments()
    options.output.mkdir(parents=True, exist_ok=True)
    # ORB-SLAM3 prints a lot, to both streams.
    errors = os.fdopen(os.dup(2), "w")
    sys.stdout.flush()
    with open(options.output / "orb_slam3.txt", "wb") as log:
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
    code = 0
    try:
        run(options)
    except InputError as error:
        print(f"run_wheel.py: {error}", file=errors)
        code = 2
    except Exception as error:  # of the wheel
        print(f"run_wheel.py: {type(error).__name__}: {error}", file=errors)
        code = 1
    errors.flush()
    # Without the destructors: ORB-SLAM3 may crash in its clean-up, after all has been written.
    os._exit(code)


if __name__ == "__main__":
    main()
