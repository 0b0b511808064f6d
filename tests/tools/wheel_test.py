# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""examples/orb_slam3 with ORB-SLAM3 itself, from the package pyorbslam3: it tracks a short recording
with each of the settings that we write. Usage: wheel_test.py VINEBENCH ROOT

Exit code 77 (skipped) where neither this Python nor ROOT/out/peers/venv has the package.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

FRAMES = 30
TRACKED = 0.9  # of the frames; nothing covers the cameras in these

failures = 0


def check(name, good):
    global failures
    failures += not good
    print(f"{'ok' if good else 'FAILED'}: {name}")


def python_with_wheel(root):
    for python in (sys.executable, root / "out/peers/venv/bin/python3"):
        if Path(python).is_file() and subprocess.run(
                [python, "-c", "import pyorbslam3, cv2"], capture_output=True).returncode == 0:
            return python
    print("pyorbslam3 is not installed: skipped")
    sys.exit(77)


def main(vinebench, root, work):
    python = python_with_wheel(root)
    example = root / "examples/orb_slam3"
    subprocess.run([vinebench, "record", "quick-loop", "--format", "euroc", "--frames",
                    f"0..{FRAMES - 1}", "--out", work / "data"], check=True, capture_output=True)
    recording = work / "data/euroc"
    words = [work / "words.txt", work / "again.txt"]
    for file in words:
        subprocess.run([python, example / "train_vocabulary.py", recording, file, "--images", "15",
                        "--features", "500"], check=True, stdout=subprocess.DEVNULL)
    check("the same vocabulary twice", words[0].read_bytes() == words[1].read_bytes())
    check("its first line", words[0].read_text().startswith("8 5 0 0\n0 0 "))

    # The settings of run.sh: its program is none here.
    (work / "sh").mkdir()
    subprocess.run([example / "run.sh", "/bin/true", words[0], recording, work / "sh"], check=True)
    for settings, more in ((recording / "settings/orbslam3_rectified.yaml", []),
                           (recording / "settings/orbslam3_raw.yaml", ["--no-wait"]),
                           (work / "sh/settings.yaml", ["--no-loops"])):
        output = work / f"output-{settings.stem}"
        done = subprocess.run([python, example / "run_wheel.py", recording, output, "--vocabulary",
                               words[0], "--settings", settings, *more], capture_output=True, text=True)
        check(f"{settings.name}: {done.returncode} {done.stderr.strip()}",
              (done.returncode, done.stdout + done.stderr) == (0, ""))
        if done.returncode == 0:
            poses = len((output / "f_vinebench.txt").read_text().splitlines())
            summary = json.loads((output / "wheel.json").read_text())
            frames = summary["frames"]
            check(f"{settings.name}: {poses} of {frames} frames have a pose",
                  frames >= FRAMES - 1 and TRACKED * frames <= poses <= frames)
            check("poses are counted", summary["poses"] == poses <= summary["tracked"])

    environment = {key: value for key, value in os.environ.items() if key != "PYORBSLAM3_VOCAB"}
    for options, word in ((["--vocabulary", work / "none"], "none: give ORBvoc.txt"),
                          ([], "no vocabulary: give ORBvoc.txt"),
                          (["--vocabulary", words[0], "--settings", work / "no.yaml"], "no.yaml")):
        done = subprocess.run([python, example / "run_wheel.py", recording, work / "wrong", *options],
                              capture_output=True, text=True, env=environment)
        check(word, done.returncode == 2 and word in done.stderr and done.stderr.count("\n") == 1)
    return 1 if failures else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2]).resolve(), Path(name)))
