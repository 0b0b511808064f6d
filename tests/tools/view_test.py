#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""The live view in a real browser.

Usage: view_test.py VINEBENCH ROOT

A run of a few seconds is watched in headless Chromium from its beginning, where it is held until the
browser is there: it is gone on with, paused, stepped and looked back at, a camera is shown alone, and in the end the page is the run's report.
The run's hash is that of the same run without a view. A port in use is one clear message. Exit code
77 (skipped) where a browser is missing.
"""

import json
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request

from browser import SIZES, By, Keys, Page, check

FRAMES = 71  # of report_run.yaml


def hash_of(text):
    found = re.search(r"hash ([0-9a-f]{32})", text)
    check(found, f"no hash in {text}")
    return found.group(1)


def wish(url, **values):
    request = urllib.request.Request(url + "control", json.dumps(values).encode(), method="POST")
    urllib.request.urlopen(request, timeout=30).close()


def frames_of(page):
    return int(re.search(r"frame (\d+) of", page.find(".result")[0].text).group(1))


def press(page, label):
    buttons = [b for b in page.find(".verdict.live button") if label in b.text]
    check(len(buttons) == 1, f"{len(buttons)} buttons '{label}'")
    buttons[0].click()


def check_pause(page):
    press(page, "Pause")
    page.wait("document.querySelector('.result').textContent.startsWith('paused')")
    time.sleep(1.5)  # a frame that was under way
    before = frames_of(page)
    time.sleep(1)
    check(frames_of(page) == before, "it goes on while it is paused")
    check(before < FRAMES, "it has ended before it was paused")
    for _ in range(2):
        press(page, "One frame")
    page.wait(f"/frame {before + 2} of/.test(document.querySelector('.result').textContent)")
    # The picture of the frame at which it stands.
    page.wait(
        "[...document.querySelectorAll('.cameras canvas')].every((c) => "
        f"c.dataset.frame === '{before + 1}')"
    )


def check_looking_back(page):
    body = page.driver.find_element(By.TAG_NAME, "body")
    body.send_keys(Keys.HOME)
    page.wait("document.querySelector('.mark').style.left === '0%'")
    press(page, "Latest")
    page.wait("document.querySelector('.mark').style.left !== '0%'")


def check_camera(page):
    page.run(
        "const s = document.querySelector('select[aria-label=Camera]');"
        "s.value = 'side'; s.dispatchEvent(new Event('change'))"
    )
    page.wait(
        "[...document.querySelectorAll('.cameras figure')].filter((f) => !f.hidden).length === 1"
    )
    press(page, "One frame")
    # Drawn larger: of 480 rows.
    page.wait("[...document.querySelectorAll('.cameras canvas')].some((c) => c.height === 480)")


def check_view(url, size):
    with Page(url, size) as page:
        page.wait("document.querySelectorAll('figure.chart').length === 5", 60)
        page.wait("document.querySelector('.view canvas').dataset.drawn")
        check(frames_of(page) < FRAMES / 2, "it did not wait")
        press(page, "Go on")
        check_pause(page)
        check_looking_back(page)
        check_camera(page)
        check(page.run("return document.documentElement.scrollWidth <= window.innerWidth"),
              "wider than the window")
        wish(url, speed=0)  # as fast as it can
        press(page, "Go on")
        page.wait("document.querySelector('.result').textContent.startsWith('PASSED')", 120)
        page.wait("document.querySelector('.verdict.live') === null", 120)  # the report is made and drawn
        check(len(page.find("figure.chart")) == 5, "the report has no charts")
        page.check_quiet(url, *(url + name for name in ["events", "control", "report"]))


def watch(vinebench, root, folder, size):
    run = subprocess.Popen(
        [vinebench, "run", root / "tests/tools/report_run.yaml", "--view", "--out", folder],
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
    )
    try:
        url = re.fullmatch(r"view: (http://127\.0\.0\.1:\d+/[0-9a-f]{32}/)\n",
                           run.stdout.readline())
        check(url, "no address")
        # A browser may take longer to start than the run takes: it waits, and then goes slowly.
        wish(url.group(1), paused=True, speed=0.1)
        check_view(url.group(1), size)
        text = run.stdout.read()
        check(run.wait() == 0, f"exit code {run.returncode}")
        check((folder / "report.html").is_file(), "no report")
        return hash_of(text)
    finally:
        run.kill()


def check_port_in_use(vinebench, root, folder):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        run = subprocess.run(
            [vinebench, "run", root / "tests/tools/report_run.yaml", "--out", folder, "--view",
             str(port)], capture_output=True, text=True,
        )
    lines = run.stderr.strip().splitlines()
    check(run.returncode == 2 and len(lines) == 1, f"{run.returncode}, {run.stderr}")
    check(f"127.0.0.1:{port}" in run.stderr and "in use" in run.stderr, run.stderr)


def main():
    vinebench, root = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory(prefix="vinebench-view-") as name:
        folder = pathlib.Path(name)
        check_port_in_use(vinebench, root, folder / "refused")
        watched = watch(vinebench, root, folder / "view", SIZES[2])
        alone = subprocess.run(
            [vinebench, "run", root / "tests/tools/report_run.yaml", "--out", folder / "alone"],
            capture_output=True, text=True, check=True,
        )
        check(watched == hash_of(alone.stdout), f"{watched} with, {alone.stdout} without a view")
    print("view_test.py: passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
