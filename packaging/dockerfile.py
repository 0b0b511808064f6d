#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The steps of a Dockerfile as lines for a shell, so that they can be executed without Docker.

Usage: dockerfile.py FILE [STAGE]

Prints the steps of a stage, the last one by default, and of those that it needs, one a line, fields
separated by tabs.

    stage    NAME IMAGE            a new system from the image of a registry
    stage    NAME stage:OTHER      from the stage OTHER
    run      FOLDER COMMAND        a command for /bin/sh
    copy     FOLDER FROM… TO       from the build's context
    copyfrom STAGE FOLDER FROM… TO from another stage
    start    FOLDER WORD…          what a container executes: ENTRYPOINT and CMD

What it does not know is an error: it must not skip a line that Docker would execute.
"""

import json
import pathlib
import re
import sys

KNOWN = {"FROM", "WORKDIR", "COPY", "RUN", "ENTRYPOINT", "CMD"}


class DockerfileError(Exception):
    pass


def instructions(text):
    """(word, rest) of each instruction; continued lines are one, comments are left out."""
    lines = [line for line in text.splitlines() if not re.match(r"\s*#", line)]
    joined = re.sub(r"\\\n\s*", " ", "\n".join(lines))
    for line in joined.splitlines():
        if line.strip():
            word, _, rest = line.strip().partition(" ")
            if word not in KNOWN:
                raise DockerfileError(f"{word}: not known here, expected one of {', '.join(sorted(KNOWN))}")
            yield word, rest.strip()


class Stage:
    def __init__(self, name, image, parent):
        self.name, self.image, self.parent = name, image, parent
        self.folder = parent.folder if parent else "/"
        self.entrypoint = list(parent.entrypoint) if parent else []
        self.command = list(parent.command) if parent else []
        self.needs = [parent.name] if parent else []
        self.steps = []

    def copy(self, rest):
        words = rest.split()
        match = re.fullmatch(r"--from=(\S+)", words[0])
        if match:
            self.needs.append(match.group(1))
            self.steps.append(["copyfrom", match.group(1), self.folder, *words[1:]])
        elif words[0].startswith("--"):
            raise DockerfileError(f"COPY {words[0]}: not known here")
        else:
            self.steps.append(["copy", self.folder, *words])

    def add(self, word, rest):
        if word == "WORKDIR":
            self.folder = str(pathlib.PurePosixPath(self.folder) / rest)
            self.steps.append(["run", "/", f"mkdir -p {self.folder}"])
        elif word == "COPY":
            self.copy(rest)
        elif word == "RUN":
            if rest.startswith(("--", "[")):
                raise DockerfileError(f"RUN {rest.split()[0]}: not known here")
            self.steps.append(["run", self.folder, rest])
        elif word == "ENTRYPOINT":
            self.entrypoint, self.command = json.loads(rest), []
        elif word == "CMD":
            self.command = json.loads(rest)


def stages_of(text):
    stages = {}
    stage = None
    for word, rest in instructions(text):
        if word == "FROM":
            match = re.fullmatch(r"(\S+)(?: AS (\S+))?", rest)
            if not match:
                raise DockerfileError(f"FROM {rest}: expected IMAGE [AS NAME]")
            image, name = match.group(1), match.group(2) or str(len(stages))
            stage = stages[name] = Stage(name, image, stages.get(image))
        elif stage is None:
            raise DockerfileError(f"{word}: before the first FROM")
        else:
            stage.add(word, rest)
    return stages


def lines_of(stages, name, done=None):
    """The steps of the stage, after those of the stages that it needs."""
    done = set() if done is None else done
    if name not in stages:
        raise DockerfileError(f"{name}: no such stage")
    if name in done:
        return []
    done.add(name)
    stage, lines = stages[name], []
    for other in stage.needs:
        lines += lines_of(stages, other, done)
    source = f"stage:{stage.parent.name}" if stage.parent else stage.image
    lines.append(["stage", name, source])
    lines += stage.steps
    lines.append(["start", stage.folder, *stage.entrypoint, *stage.command])
    return lines


def main():
    stages = stages_of(pathlib.Path(sys.argv[1]).read_text())
    name = sys.argv[2] if len(sys.argv) > 2 else list(stages)[-1]
    for line in lines_of(stages, name):
        print("\t".join(line))
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except DockerfileError as error:
        print(f"{sys.argv[1]}: {error}", file=sys.stderr)
        sys.exit(1)
