#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The documents say what is so.

Usage: docs_test.py VINEBENCH ROOT

Prints every link of README.md, the other documents at the root and docs/ that leads to no file or
no heading, every picture that is absent, every page of docs/ that the site's navigation lacks, every
key of a file that the generated reference has no meaning for (tools/reference.py takes it from the
source), every command of the program that its manual page lacks, and every `vinebench` command line
in a block of code that names a command, option, scenario or file of the repository that does not
exist.
"""

import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+?)\s*$", re.M)
FENCE = re.compile(r"^```.*?^```", re.M | re.S)
PROGRAM = re.compile(r"^(?:[A-Z_]+=\S+ )*(?:build/)?vinebench (.*)$")
# What a reader has to put in.
PLACEHOLDER = re.compile(r"[A-Z]{3,}|…|<|\[|\$|\{|\*|\|")


def anchor_of(heading):
    """As GitHub and MkDocs make it."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
    return re.sub(r"[^\w\- ]", "", text).strip().replace(" ", "-")


def without_code(text):
    text = FENCE.sub("", text)
    lines = [line for line in text.splitlines() if not line.startswith("    ")]
    return re.sub(r"`[^`]*`", "", "\n".join(lines))


def anchors_of(file):
    return {anchor_of(heading) for heading in HEADING.findall(FENCE.sub("", file.read_text()))}


def check_links(file, root, problems):
    for link in LINK.findall(without_code(file.read_text())):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (file.parent / path).resolve() if path else file
        name = file.relative_to(root)
        if not target.exists():
            problems.append(f"{name}: {link}: no such file")
        elif anchor and target.suffix == ".md" and anchor not in anchors_of(target):
            problems.append(f"{name}: {link}: no such heading")


def code_lines(text):
    blocks = [block.splitlines()[1:-1] for block in FENCE.findall(text)]
    lines = [line for block in blocks for line in block]
    lines += [line[4:] for line in FENCE.sub("", text).splitlines() if line.startswith("    ")]
    joined = []
    for line in lines:
        if joined and joined[-1].endswith("\\"):
            joined[-1] = joined[-1][:-1] + line.strip()
        else:
            joined.append(line.strip())
    return joined


class Program:
    """What the command line accepts, by its own help."""

    def __init__(self, vinebench):
        self.vinebench = vinebench
        self.helps = {}
        self.names = set(self.ask("list").split())

    def ask(self, *arguments):
        run = subprocess.run([self.vinebench, *arguments], capture_output=True, text=True)
        return run.stdout if run.returncode == 0 else ""

    def options(self, *command):
        if command not in self.helps:
            text = self.ask(*command, "--help")
            self.helps[command] = set(re.findall(r"--[a-z][a-z-]*", text)) if text else None
        return self.helps[command]


def check_command(words, program, root):
    """A problem, or None."""
    command = [words[0]]
    if words[0] in ("bench", "sweep") and len(words) > 1:
        command.append(words[1])
    options = program.options(*command)
    if options is None:
        return f"no command {' '.join(command)}"
    for word in words[len(command):]:
        option = word.partition("=")[0]
        if option.startswith("--") and option not in options:
            return f"{' '.join(command)} has no option {option}"
        if re.match(r"(scenarios|worlds|models|examples)/", word) and not PLACEHOLDER.search(word):
            if not (root / word).exists():
                return f"no file {word}"
    if command == ["run"] and len(words) > 1 and re.fullmatch(r"[a-z][a-z0-9-]*", words[1]):
        if words[1] not in program.names:
            return f"no scenario {words[1]}"
    return None


def check_commands(file, root, program, problems):
    for line in code_lines(file.read_text()):
        match = PROGRAM.match(re.sub(r"\s{2,}#.*$", "", line))
        if not match:
            continue
        text = match.group(1).split(" | ")[0].split(" > ")[0].split(" && ")[0]
        try:
            words = [word for word in shlex.split(text) if not word.startswith("#")]
        except ValueError:
            continue
        if not words or words[0].startswith("-") or PLACEHOLDER.search(words[0]):
            continue
        problem = check_command(words, program, root)
        if problem:
            problems.append(f"{file.relative_to(root)}: '{line}': {problem}")


def check_navigation(root, problems):
    site = (root / "mkdocs.yml").read_text()
    for page in sorted((root / "docs").glob("*.md")):
        if not re.search(rf"\b{re.escape(page.name)}\b", site):
            problems.append(f"mkdocs.yml: docs/{page.name} is not in its navigation")
    for name in re.findall(r"[\w/-]+\.md", site):
        if not (root / "docs" / name).exists() and not name.startswith("reference/"):
            problems.append(f"mkdocs.yml: docs/{name} does not exist")


def check_reference(vinebench, root, problems):
    """The generated pages: all keys of a resolved scenario, each with a meaning."""
    sys.path.insert(0, str(root / "tools"))
    import reference
    told = reference.reference_of(vinebench)
    sources = reference.Sources(root)
    for file in told["files"]:
        for key in file["keys"]:
            if "map" not in key["type"] and not sources.comment(key["owner"], key["own_key"]):
                problems.append(f"reference: {file['name']}: {key['key']}: no comment beside it in "
                                f"{key['owner']}")
    keys = reference.key_page(told["files"], sources)
    site = (root / "mkdocs.yml").read_text()
    for page, text in {"keys": keys, "commands": reference.command_page(told["program"])}.items():
        if f"reference/{page}.md" not in site:
            problems.append(f"mkdocs.yml: reference/{page}.md is not in its navigation")
        for link in LINK.findall(without_code(text)):
            path, _, anchor = link.partition("#")
            target = root / "docs/reference" / path
            if not (root / "docs" / target.name).exists() or (
                    anchor and anchor not in anchors_of(root / "docs" / target.name)):
                problems.append(f"reference/{page}.md: {link}: no such file or heading")
    return keys


def resolved_keys(vinebench):
    """Those that a run writes out, dotted, with N for numbers of entries."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([vinebench, "run", "quick-loop", "--out", folder, "--set", "duration=0.01",
                        "--set", "renderer.engine=fake"],
                       capture_output=True)
        text = (pathlib.Path(folder) / "scenario.resolved.yaml").read_text()
    keys, open_keys = [], []  # (indentation, name)
    for line in text.splitlines():
        indent, content = len(line) - len(line.lstrip()), line.strip()
        name = "N" if content == "-" else content.partition(":")[0]
        while open_keys and open_keys[-1][0] >= indent:
            open_keys.pop()
        open_keys.append((indent, name))
        keys.append(".".join(name for _, name in open_keys))
    return keys


def check_resolved(vinebench, page, problems):
    for key in resolved_keys(vinebench):
        if not key.endswith(".N") and f"| `{key}` |" not in page:
            problems.append(f"reference: scenario: {key}: a run writes this key, the page lacks it")


def check_manual(root, program, problems):
    manual = (root / "packaging/vinebench.1.in").read_text()
    described = set(re.findall(r"^\.TP\n\.B ([a-z]+)$", manual.partition(".SH COMMANDS")[2], re.M))
    commands = set(re.findall(r"^  ([a-z]+) {2,}", program.ask("help").partition("Subcommands:")[2], re.M))
    for command in sorted(described ^ commands):
        problems.append(f"packaging/vinebench.1.in: {command}: the program and the page differ")


def main():
    program, root = Program(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    problems = []
    files = sorted([*root.glob("*.md"), *(root / "docs").glob("*.md")])
    for file in files:
        check_links(file, root, problems)
        check_commands(file, root, program, problems)
    check_navigation(root, problems)
    if program.options("reference"):  # a build without the simulation has none
        page = check_reference(sys.argv[1], root, problems)
        check_resolved(sys.argv[1], page, problems)
    check_manual(root, program, problems)
    print("\n".join(problems))
    print(f"{len(files)} documents, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
