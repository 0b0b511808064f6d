# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The examples run, on short drives."""
import subprocess
import sys

from support import ROOT, CourtTest, main


class ExamplesTest(CourtTest):
    def example(self, name, *arguments):
        done = subprocess.run([sys.executable, ROOT / "examples/python" / name, *arguments],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_run(self):
        text = self.example("run.py", self.court, "--seeds", "1", "2")
        self.assertRegex(text, r"seed 1: PASSED, ATE \d+\.\d mm")
        self.assertRegex(text, r"seed 2: PASSED")

    def test_frame_by_frame(self):
        text = self.example("frame_by_frame.py", self.court)
        self.assertRegex(text, r"0\.600 s: TRACKING, \d+ inliers")
        self.assertRegex(text, r"ATE \d+\.\d mm over 10 poses")

    # All but the last, which frames_test.py runs, on the court and its cameras.
    def test_the_documentation(self):
        text = (ROOT / "docs/python.md").read_text().split("## Frames")[0]
        blocks = [part.split("```")[0] for part in text.split("```python\n")[1:]]
        self.assertEqual(len(blocks), 3)
        expected = [r"^(True|False) 0\.0\d+ [0-9a-f]{32}\n", "^$", r"^0\.60*1? 0\.1\d+ False\n$"]
        for block, words in zip(blocks, expected):
            code = block.replace('"quick-loop"', repr(str(self.court))).replace("front_left", "left")
            code = code.replace('"duration": 20', '"duration": 0.6')
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, words)

    # The wheels turn as they should but for slip: some millimetres in some centimetres.
    def test_wheel_odometry(self):
        text = self.example("wheel_odometry.py", self.court)
        self.assertRegex(text, r"WheelOdometry: error at most \d\.\d mm, \d\.\d\d m driven")

    def test_drive(self):
        text = self.example("drive.py", self.court, "--seconds", "4")
        self.assertRegex(text, r"reached the end after \d\.\d s")


if __name__ == "__main__":
    main()
