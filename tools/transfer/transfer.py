#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Does training on recordings transfer to real photographs (docs/transfer.md)? Trains a small
network to find the pixels of grape bunches on each TRAIN, tests it on PHOTOS and prints a table."""
import argparse
import importlib
import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

# 2.6.0 is there for Python 3.9 to 3.13, numpy 2.0.2 for 3.9 to 3.12.
PACKAGES = ["torch==2.6.0", "numpy==2.0.2; python_version<'3.13'",
            "numpy==2.2.6; python_version>='3.13'", "opencv-python-headless==4.11.0.86"]
MOST = 10**6  # of a seed, of steps


def stop(message, code=2):
    sys.exit(print(f"transfer.py: {message}", file=sys.stderr) or code)


def say(message):
    print(f"transfer.py: {message}", file=sys.stderr, flush=True)


def whole_number(least):
    def number(text):
        if not re.fullmatch("[0-9]{1,7}", text) or not least <= int(text) <= MOST:
            raise argparse.ArgumentTypeError(
                f"expected a whole number from {least} to {MOST}, found '{text}'")
        return int(text)
    return number


def seed_list(text):
    seeds = [whole_number(1)(part) for part in text.split(",")]
    if len(set(seeds)) < len(seeds):
        raise argparse.ArgumentTypeError(f"expected each seed once, found '{text}'")
    return seeds


def folder(text):
    if not os.path.isdir(text):
        raise argparse.ArgumentTypeError(f"{text}: is no folder")
    return text


def arguments():
    parser = argparse.ArgumentParser(prog="transfer.py", description=__doc__)
    parser.error = lambda message: stop(re.sub("^argument ", "", message))
    add = parser.add_argument
    add("train", nargs="*", type=folder, metavar="TRAIN",
        help="recording with --format coco, or folder of labelled photographs")
    add("--test", type=folder, metavar="PHOTOS", required=True,
        help="labelled photographs to test on: NAME.jpg with NAME_mask.png or NAME.npz")
    add("--real", type=folder, metavar="PHOTOS",
        help="other labelled photographs: trained on alone, a tenth of them alone and with each TRAIN")
    add("--steps", type=whole_number(1), default=400, help="of each training (400)")
    add("--seeds", type=seed_list, default=[1, 2, 3], metavar="1,2,3")
    add("--width", type=whole_number(64), default=752, metavar="PX",
        help="to which all pictures are scaled (752)")
    add("--out", type=Path, default=Path("out/transfer"), metavar="FOLDER",
        help="results; trainings that are there are not repeated (out/transfer)")
    add("--table", action="store_true", help="of the results that are there: nothing is trained")
    add("--here", action="store_true",
        help="with the torch, numpy and cv2 of this Python, not those of an environment made for it")
    options = parser.parse_args()
    if not options.train and not options.real:
        stop("expected a TRAIN or --real to train on")
    return options


def environment(options):
    """The Python that has PyTorch. A table needs none: this Python where there is no environment."""
    base = os.environ.get("VINEBENCH_CACHE") or Path(
        os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "vinebench"
    place = Path(base).resolve() / "transfer"
    python, ready = place / "bin/python3", place / "packages.txt"
    known = ready.read_text() if ready.is_file() and python.exists() else ""
    if known != "\n".join(PACKAGES):
        if options.table:
            return sys.executable
        say(f"making an environment in {place}: 6 GB, once")
        for command in ([os.environ.get("PYTHON", "python3"), "-m", "venv", place],
                        [python, "-m", "pip", "install", "--quiet", *PACKAGES]):
            try:
                done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                      text=True, errors="replace")
            except OSError as error:
                stop(f"{command[0]}: {error.strerror}", 1)
            if done.returncode:
                stop(f"{Path(command[0]).name}: exit code {done.returncode}: "
                     f"{done.stdout.strip()[-1000:]}", 1)
        ready.write_text("\n".join(PACKAGES))
    return python


def run(options):
    import experiment  # what it needs is in the environment
    import pictures
    import scores
    trainer = lambda: importlib.import_module("network")
    try:
        rows = experiment.Experiment(options, say, trainer).results()
    except pictures.Problem as error:
        stop(error)
    except OSError as error:
        stop(f"{error.filename or options.out}: {error.strerror}", 1)
    print(scores.table(rows), end="")


def start(options):
    if not options.here:
        python = environment(options)
        os.execv(python, [str(python), __file__, "--here", *sys.argv[1:]])
    needed = ["numpy", "cv2"] + ([] if options.table else ["torch"])
    missing = [name for name in needed if not importlib.util.find_spec(name)]
    if missing:
        stop(f"{sys.executable}: does not have {' and '.join(missing)}", 1)
    run(options)


def main():
    options = arguments()
    try:
        start(options)
    except KeyboardInterrupt:
        stop(f"interrupted; what is finished is kept in {options.out}", 130)


if __name__ == "__main__":
    main()
