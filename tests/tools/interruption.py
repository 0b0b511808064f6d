# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What kill_test.py and fault_test.py share: a small scenario and programs that end early."""
import argparse
import itertools
import os
import pathlib
import subprocess

LIMIT = 120  # s, beyond which a program hangs


def parse_arguments(**numbers: int) -> argparse.Namespace:
    """VINEBENCH SHIM ROOT and options that take a number, with their defaults."""
    parser = argparse.ArgumentParser()
    for name in ("vinebench", "shim", "root"):
        parser.add_argument(name, type=lambda text: pathlib.Path(text).resolve())
    for name, default in numbers.items():
        parser.add_argument(f"--{name}", type=int, default=default)
    return parser.parse_args()


def write_scenario(folder: pathlib.Path, root: pathlib.Path) -> pathlib.Path:
    """Four frames of three small cameras in a walled court, without OpenGL and plants."""
    (folder / "rig.yaml").write_text("""name: small
rate_hz: 15
cameras:
  - {name: left, width: 96, height: 64, fx: 60, fy: 60, position: [0.15, 0.06, 0.5], rpy_deg: [0, 0, 90]}
  - {name: right, width: 96, height: 64, fx: 60, fy: 60, position: [0.27, 0.06, 0.5], rpy_deg: [0, 0, 90]}
  - {name: side, width: 160, height: 96, fx: 80, fy: 80, position: [0, -0.15, 0.5], rpy_deg: [0, 0, -90]}
stereo_pairs: [{name: front, left: left, right: right}]
tag_cameras: [side]
""")
    scenario = folder / "small.yaml"
    scenario.write_text(f"""name: small
world: {{rows: [{{start: [-0.5, 1.2], end: [2.5, 1.2]}}], vines: {{templates: 1}}}}
rover: {{model: {root}/models/csl-rover/rover.xml, rig: rig.yaml}}
route: {{acceleration: 2, waypoints: [{{position: [0, 0]}}, {{position: [1, 0]}}]}}
renderer: {{engine: fake}}
duration: 0.2
""")
    return scenario


def numbers(arguments: argparse.Namespace):
    """Of the operations at which to end a program: --first, --first + --every, ... up to --last
    (0: to the end). Says every hundred of them how far it is."""
    for done, number in enumerate(itertools.count(arguments.first, arguments.every)):
        if arguments.last and number > arguments.last:
            return
        if done % 100 == 99:
            print(f"  operation {number}", flush=True)
        yield number


def run(command, *, shim=None, fault=None, folder=None):
    """Runs a program, with the N-th file operation below the folder at fault: (kind, N). Returns
    its exit code (a negative signal, None for a hang), its standard output and error, and the
    operation at fault, empty if the program ended before it."""
    environment = dict(os.environ)
    log = None
    if fault is not None:
        log = pathlib.Path(str(folder) + ".fault")
        log.unlink(missing_ok=True)
        environment.update(LD_PRELOAD=str(shim), FAULT_FOLDER=str(folder), FAULT_KIND=fault[0],
                           FAULT_AT=str(fault[1]), FAULT_LOG=str(log))
    try:
        ended = subprocess.run([str(word) for word in command], env=environment, timeout=LIMIT,
                               stdin=subprocess.DEVNULL, capture_output=True, text=True,
                               check=False)
        code, out, errors = ended.returncode, ended.stdout, ended.stderr
    except subprocess.TimeoutExpired:
        code, out, errors = None, "", ""
    happened = log.read_text().strip() if log is not None and log.exists() else ""
    return code, out, errors, happened


def content(folder: pathlib.Path) -> dict:
    """The bytes of every file below a folder, by name."""
    return {str(file.relative_to(folder)): file.read_bytes()
            for file in sorted(folder.rglob("*")) if file.is_file()}
