#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""What makes packages, as far as it can be checked without building one (tools/packages.sh does).

Usage: packaging_test.py ROOT
"""

import json
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "packaging"))
sys.dont_write_bytecode = True

from dockerfile import DockerfileError, lines_of, stages_of  # noqa: E402


def steps(text, stage):
    return lines_of(stages_of(text), stage)


class DockerfileTest(unittest.TestCase):
    def test_a_continued_line_is_one_command(self):
        lines = steps("FROM a AS b\n# comment\nRUN one && \\\n    two \\\n# comment\n    three\n", "b")
        self.assertEqual(lines, [["stage", "b", "a"], ["run", "/", "one &&  two  three"], ["start", "/"]])

    def test_a_stage_comes_after_those_that_it_needs(self):
        text = ("FROM a AS tools\nWORKDIR /src\nFROM tools AS build\nRUN make\nFROM a AS other\n"
                "FROM a\nCOPY --from=build /out /in\nENTRYPOINT [\"x\"]\nCMD [\"y\", \"z\"]\n")
        lines = steps(text, "3")
        stages = [line[1:] for line in lines if line[0] == "stage"]
        self.assertEqual(stages, [["tools", "a"], ["build", "stage:tools"], ["3", "a"]])
        self.assertIn(["run", "/src", "make"], lines)  # the folder is the parent's
        self.assertEqual(lines[-2:], [["copyfrom", "build", "/", "/out", "/in"], ["start", "/", "x", "y", "z"]])

    def test_what_is_not_known_is_an_error(self):
        for text in ("FROM a\nUSER me\n", "FROM a\nRUN --mount=type=cache,target=/x make\n", "RUN make\n",
                     "FROM a\nCOPY --chown=me . .\n", "FROM --platform=x a\n"):
            with self.assertRaises(DockerfileError, msg=text):
                steps(text, "0")
        with self.assertRaises(DockerfileError):
            steps("FROM a AS b\n", "c")

    def test_ours_installs_what_setup_sh_installs(self):
        lines = steps((ROOT / "Dockerfile").read_text(), "tools")
        self.assertIn(["run", "/src", "tools/setup.sh --packages"], lines)
        self.assertFalse([line for line in lines if line[0] == "run" and "apt-get" in line[2]])

    def test_the_development_container_stops_at_a_stage(self):
        container = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text())
        self.assertEqual(container["build"]["dockerfile"], "../Dockerfile")
        self.assertIn(container["build"]["target"], stages_of((ROOT / "Dockerfile").read_text()))


class PackagesTest(unittest.TestCase):
    def test_the_wheel_has_the_projects_version(self):
        expression = re.search(r"^regex = '(.*)'$", (ROOT / "pyproject.toml").read_text(), re.M).group(1)
        found = re.search(expression, (ROOT / "CMakeLists.txt").read_text()).group("value")
        cited = re.search(r"^version: (.*)$", (ROOT / "CITATION.cff").read_text(), re.M).group(1)
        self.assertEqual(found, cited)

    def test_each_debian_package_is_described(self):
        text = (ROOT / "cmake/packages.cmake").read_text()
        packages = re.findall(r"^ *vinebench_package\(\w+ \w+ ([\w-]+)\)", text, re.M)
        described = {file.stem for file in (ROOT / "packaging/debian").glob("*.description")}
        self.assertEqual(set(packages), described)


if __name__ == "__main__":
    unittest.main()
