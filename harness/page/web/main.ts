// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import {readDetails, readPictures, readReport} from "./data";
import {html} from "./dom";
import {LiveView} from "./live";
import {RunView, verdict} from "./run_view";
import {setView} from "./set_view";

const report = readReport();
const app = document.getElementById("app") as HTMLElement;
const alone = report.runs.length === 1 && report.history === null;
let shown: RunView | null = null;
let scrolled = 0;  // of the set, px

function fail(text: string): void {
  app.replaceChildren(html("main", {}, html("p", {class: "alarm", role: "alert"}, text)));
}

async function showRun(index: number): Promise<void> {
  const run = report.runs[index];
  const details = run === undefined ? null : await readDetails(index);
  if (run === undefined || details === null) return fail("This run is not in the report.");
  shown = new RunView(verdict(run, details), details, await readPictures(index));
  const back = html("nav", {}, html("a", {href: "#"}, "← all runs"));
  app.replaceChildren(...(alone ? [] : [back]), shown.element);
  window.scrollTo(0, 0);
}

function showSet(): void {
  shown = null;
  app.replaceChildren(setView(report));
  window.scrollTo(0, scrolled);
}

async function route(): Promise<void> {
  shown?.cursor.stop();
  const match = /^#run=(\d+)$/.exec(location.hash);
  try {
    if (alone) await showRun(0);
    else if (match !== null) await showRun(Number(match[1]));
    else showSet();
  } catch (error) {
    fail(`The report cannot be shown: ${(error as Error).message}`);
  }
  document.body.dataset.ready = location.hash || "set";
}

if (report.live === true) new LiveView(app, (view) => {
  shown = view;
});
document.addEventListener("keydown", (event) => shown?.key(event));
document.addEventListener("click", () => {
  if (shown === null) scrolled = window.scrollY;
});
if (report.live !== true) {
  window.addEventListener("hashchange", route);
  void route();
}
