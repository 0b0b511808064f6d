#!/usr/bin/env python3
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Reports in a real browser.

Usage: report_test.py VINEBENCH ROOT

A run that passes and one that fails, of a few seconds each, a set of them and a history are opened
from disk in headless Chromium: every plot is drawn, one cursor joins them, nothing is requested and
nothing is logged as an error. What is no run gets one clear message. Exit code 77 (skipped) where
Chromium, its driver or Selenium (Debian: chromium, chromium-driver, python3-selenium) is missing.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

from browser import SIZES, By, Keys, Page, check, webdriver


def check_run_page(page, charts):
    page.wait("document.querySelector('.view canvas').dataset.drawn")
    check(len(page.find("figure.chart")) == charts, f"expected {charts} charts")
    # Every line has points, every chart with lines a scale.
    lengths = page.run(
        "return [...document.querySelectorAll('path.line')].map((p) => p.getTotalLength())"
    )
    check(lengths and min(lengths) > 100, f"lines of lengths {lengths}")
    # The 3D view shows something: not one colour alone.
    colours = page.run(
        "const c = document.querySelector('.view canvas'), d = document.createElement('canvas');"
        "d.width = 64; d.height = 48; const x = d.getContext('2d');"
        "return new Promise((done) => requestAnimationFrame(() => {"
        "  document.querySelector('.bar button').click();"
        "  requestAnimationFrame(() => { x.drawImage(c, 0, 0, 64, 48);"
        "    done(new Set(new Uint32Array(x.getImageData(0, 0, 64, 48).data.buffer)).size); }); }))"
    )
    check(colours > 50, f"the 3D view has {colours} colours")
    check_cursor(page)
    check_tables(page)
    # Nothing is wider than the window.
    check(page.run("return document.documentElement.scrollWidth <= window.innerWidth"), "too wide")


def state(page):
    return page.run(
        "return {marks: [...document.querySelectorAll('.mark')].map((m) => m.style.left),"
        "        range: document.querySelector('input[type=range]').value,"
        "        frames: [...document.querySelectorAll('.cameras canvas')]"
        "                    .map((c) => c.dataset.frame)}"
    )


def check_cursor(page):
    """By key and by pointer: charts, slider and pictures move together."""
    page.driver.find_element(By.TAG_NAME, "body").send_keys(Keys.END)
    page.wait("document.querySelector('.mark').style.left === '100%'")
    page.driver.find_element(By.TAG_NAME, "body").send_keys(Keys.HOME)
    page.wait("document.querySelector('.mark').style.left === '0%'")
    page.driver.find_element(By.TAG_NAME, "body").send_keys(Keys.ARROW_RIGHT)
    page.wait("document.querySelector('input[type=range]').value === '1'")
    area = page.find("figure.chart .area")[0]
    webdriver.ActionChains(page.driver).move_to_element(area).click().perform()
    page.wait("Number(document.querySelector('input[type=range]').value) > 5")
    now = state(page)
    check(len(set(now["marks"])) == 1, f"charts stand at {set(now['marks'])}")
    if now["frames"]:
        page.wait(
            "[...document.querySelectorAll('.cameras canvas')].every((c) => "
            "Math.abs(Number(c.dataset.frame) - "
            "Number(document.querySelector('input[type=range]').value)) <= 2)"
        )
    page.find(".play")[0].click()
    before = state(page)["range"]
    page.wait(f"document.querySelector('input[type=range]').value !== '{before}'")
    page.find(".play")[0].click()


def check_tables(page):
    """Each plot has a table for those who do not see it."""
    for figure in page.find("figure.chart, figure.distribution"):
        summary = figure.find_element(By.CSS_SELECTOR, "details.data summary")
        page.driver.execute_script("arguments[0].click()", summary)
    page.wait(
        "[...document.querySelectorAll('figure.chart, figure.distribution')]"
        ".every((f) => f.querySelector('table') !== null)"
    )


def check_pages(folder, passed, failed, history):
    for size in SIZES:
        for file, verdict in [(passed, "PASSED"), (failed, "FAILED")]:
            with Page(file.as_uri(), size, dark=size == SIZES[1]) as page:
                check(verdict in page.find(".result")[0].text, f"no {verdict}")
                check_run_page(page, 5)
                page.check_quiet(file.as_uri())
    with Page((folder / "report.html").as_uri(), SIZES[0]) as page:
        check("1 failed" in page.find(".result")[0].text, "the set's verdict")
        first = page.find("table.runs tbody tr")[0]
        check("FAILED" in first.text, "failures are not first")
        check_tables(page)
        first.find_element(By.TAG_NAME, "a").click()
        page.wait("document.querySelector('main.run') !== null")
        check("FAILED" in page.find(".result")[0].text, "another run was opened")
        page.driver.back()
        page.wait("document.querySelector('main.set') !== null")
        page.check_quiet((folder / "report.html").as_uri())
    with Page(history.as_uri(), SIZES[0]) as page:
        check("left their bands" in page.find(".alarm")[0].text, "no alarm")
        page.check_quiet(history.as_uri())


def expect_error(vinebench, arguments, *words):
    run = subprocess.run([vinebench, *arguments], capture_output=True, text=True)
    lines = run.stderr.strip().splitlines()
    check(run.returncode == 2 and len(lines) == 1, f"{arguments}: {run.returncode}, {run.stderr}")
    for word in words:
        check(word in run.stderr, f"{arguments}: no '{word}' in {run.stderr}")


def check_errors(vinebench, folder, run):
    expect_error(vinebench, ["report"], "expected a folder of runs")
    expect_error(vinebench, ["report", str(folder / "absent")], "absent", "folder of runs")
    empty = folder / "empty"
    empty.mkdir()
    expect_error(vinebench, ["report", str(empty)], "contains no run")
    expect_error(vinebench, ["report", str(run), "--out", str(folder / "no/such/folder.html")],
                 "no/such")
    damaged = folder / "damaged"
    shutil.copytree(run, damaged)
    (damaged / "timeline.csv").write_text("t,frame\n0.0,0\n")
    expect_error(vinebench, ["report", str(damaged)], "timeline.csv:2")
    (damaged / "timeline.csv").write_bytes((run / "timeline.csv").read_bytes())
    (damaged / "film/000003.jpg").unlink()
    expect_error(vinebench, ["report", str(damaged)], "000003.jpg")


def make_history(vinebench, folder, run):
    """Three versions that agree and one with ten times the error."""
    for number in range(1, 5):
        version = folder / f"history/v{number + 7}"
        version.mkdir(parents=True)
        metrics = json.loads((run / "metrics.json").read_text())
        if number == 4:
            metrics["ate_rmse_m"] *= 10
        (version / "metrics.json").write_text(json.dumps(metrics))
    subprocess.run([vinebench, "report", "--history", folder / "history"], check=True,
                   stdout=subprocess.DEVNULL)
    return folder / "history/report.html"


def main():
    vinebench, root = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory(prefix="vinebench-report-") as name:
        folder = pathlib.Path(name)
        base = [vinebench, "run", str(root / "tests/tools/report_run.yaml"), "--report"]
        for run, settings, code in [("good", [], 0), ("bad", ["slam.cameras=front"], 1)]:
            arguments = [word for setting in settings for word in ("--set", setting)]
            done = subprocess.run([*base, "--out", folder / run, *arguments], capture_output=True,
                                  text=True)
            check(done.returncode == code, f"{run}: {done.returncode}\n{done.stdout}{done.stderr}")
        subprocess.run([vinebench, "report", folder / "good", folder / "bad", "--out",
                        folder / "report.html"], check=True, stdout=subprocess.DEVNULL)
        history = make_history(vinebench, folder, folder / "good")
        check_pages(folder, folder / "good/report.html", folder / "bad/report.html", history)
        check_errors(vinebench, folder, folder / "good")
    print("report_test.py: passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
