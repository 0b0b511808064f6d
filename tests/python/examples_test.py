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

    # The wheels turn as they should but for slip: some millimetres in some centimetres.
    def test_wheel_odometry(self):
        text = self.example("wheel_odometry.py", self.court)
        self.assertRegex(text, r"WheelOdometry: error at most \d\.\d mm, \d\.\d\d m driven")

    def test_drive(self):
        text = self.example("drive.py", self.court, "--seconds", "4")
        self.assertRegex(text, r"reached the end after \d\.\d s")


if __name__ == "__main__":
    main()
