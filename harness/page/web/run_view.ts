// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import {Lane, Line, Span, chart, lanes, timeAxis} from "./chart";
import {Cursor} from "./cursor";
import {Pictures} from "./data";
import {fixed, html, openedTable, table} from "./dom";
import {player} from "./player";
import {Check, Details, RunEntry, RunEvent} from "./types";
import {view3d} from "./view3d";

// Distinct for the colour-blind (Okabe and Ito).
const kPalette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999933",
                  "#8844aa"];
const kStatus: {[letter: string]: [string, string]} = {
  t: ["tracked", "tracked"],
  d: ["dead reckoning", "reckoned"],
  i: ["initialising", "starting"],
  l: ["lost", "lost"],
};
const kMostEvents = 2000;  // in the list
const kEvents: {[event: string]: string} = {
  initialised: "initialised",
  lost: "lost",
  dead_reckoning_given_up: "dead reckoning given up",
  relocalised: "found again",
  tag_seen: "tag seen",
  tag_rejected: "tag rejected",
  calibrated: "calibrated",
  loop_closure: "loop closed",
  loop_closure_missed: "loop missed",
  occlusion_begin: "occlusion begins",
  occlusion_end: "occlusion ends",
};

function textOf(event: RunEvent): string {
  const words = [kEvents[event.event] ?? event.event];
  for (const key of ["camera", "occluder", "id", "tag", "reason", "sensor", "detail"]) {
    if (key in event) words.push(key === "id" ? `tag ${event[key]}` : `${event[key]}`);
  }
  if (event.event === "loop_closure") {
    words.push(event.correct === false ? "WRONG" : event.correct === true ? "right" : "not judged",
               `moved ${fixed(1000 * (event.correction_m as number), 1)} mm`);
  }
  return words.join(", ");
}

/** Stretches of equal letters. */
function statusSpans(details: Details): Span[] {
  const status = details.status ?? "", spans: Span[] = [];
  for (let i = 0; i < status.length; ++i) {
    const [title, className] = kStatus[status[i]] ?? [status[i], "lost"];
    const until = details.t[Math.min(i + 1, details.t.length - 1)];
    const last = spans[spans.length - 1];
    if (last !== undefined && last.className === className) last.until = until;
    else spans.push({from: details.t[i], until, className, title});
  }
  return spans;
}

/** What the diagnosis says, where it happened. */
export function causeSpans(details: Details): Span[] {
  return details.events.filter((event) => event.event === "explained").map((event) => ({
    from: event.from as number,
    until: event.until as number,
    className: "cause",
    title: `${event.cause}${(event.cameras as string[] ?? []).length > 0
        ? ` (${(event.cameras as string[]).join(", ")})` : ""}`,
  }));
}

function eventSpans(details: Details, names: string[], className: string): Span[] {
  return details.events.filter((event) => names.includes(event.event)).map((event) => ({
    from: event.t,
    until: event.t,
    className: event.event === "loop_closure" && event.correct === false ? "lost" : className,
    title: textOf(event),
  }));
}

/** Where occluders cover a fifth of a camera's image. */
function occlusionSpans(details: Details, camera: number): Span[] {
  const spans: Span[] = [];
  const name = details.site?.cameras[camera].name ?? "";
  (details.occluded?.[camera] ?? []).forEach((share, i) => {
    if (share === null || share < 0.2) return;
    const last = spans[spans.length - 1];
    const until = details.t[Math.min(i + 1, details.t.length - 1)];
    if (last !== undefined && last.until >= details.t[i] - 1e-6) last.until = until;
    else spans.push({from: details.t[i], until, className: "occluded", title: `${name} occluded`});
  });
  return spans;
}

function lanesOf(details: Details): Lane[] {
  const list: Lane[] = [];
  if (details.status !== undefined) list.push({name: "status", spans: statusSpans(details)});
  list.push({name: "causes", spans: causeSpans(details)});
  list.push({name: "loops", spans: eventSpans(details, ["loop_closure", "loop_closure_missed"],
                                              "event")});
  list.push({name: "tags", spans: eventSpans(details, ["tag_seen", "tag_rejected"], "event")});
  details.site?.cameras.forEach((camera, i) => {
    const spans = occlusionSpans(details, i);
    if (spans.length > 0) list.push({name: camera.name, spans});
  });
  return list;
}

function cameraLines(details: Details, lists: Line["values"][]): Line[] {
  const lines: Line[] = [];
  details.site?.cameras.forEach((camera, i) => {
    if (lists[i]?.some((value) => (value ?? 0) > 0)) {
      lines.push({name: camera.name, values: lists[i], colour: kPalette[i % kPalette.length]});
    }
  });
  return lines;
}

function errorLines(details: Details): Line[] {
  const lines: Line[] = [];
  if (details.error) lines.push({name: "corrected", values: details.error, colour: kPalette[0]});
  if (details.live_error) lines.push({name: "live", values: details.live_error, colour: kPalette[1]});
  return lines;
}

/** mm. */
function sigmaLines(details: Details): Line[] {
  const values = (details.covariance ?? []).map((c) => c[0] === null ? null
      : 1000 * Math.sqrt((c[0] ?? 0) + (c[3] ?? 0) + (c[5] ?? 0)));
  return [{name: "σ", values, colour: kPalette[3]}];
}

function occlusionLines(details: Details): Line[] {
  return cameraLines(details, (details.occluded ?? []).map((shares) =>
      shares.map((s) => s === null ? null : 100 * s)));
}

function charts(details: Details, cursor: Cursor): HTMLElement {
  const spans = () => causeSpans(details), list: HTMLElement[] = [];
  // A chart that has nothing to show is left out, unless it may have later.
  const add = (title: string, unit: string, lines: () => Line[], decimals: number) => {
    if (cursor.growing || lines().length > 0) {
      list.push(chart(cursor, title, unit, lines, decimals, spans));
    }
  };
  add("Position error, first poses aligned", "mm", () => errorLines(details), 1);
  list.push(lanes(cursor, "What happened", () => lanesOf(details)));
  if (details.covariance) {
    add("Standard deviation of the position, as estimated", "mm", () => sigmaLines(details), 1);
  }
  add("Inliers", "features", () => cameraLines(details, details.inliers ?? []), 0);
  add("Image covered by occluders", "%", () => occlusionLines(details), 0);
  return html("section", {class: "charts", "aria-label": "Over time"}, ...list, timeAxis(cursor));
}

function checksTable(checks: Check[]): HTMLElement {
  const order = [...checks].sort((a, b) => Number(a.ok) - Number(b.ok));
  const rows = order.map((check) =>
      [check.what, check.measured, check.expected, check.kind,
       check.ok ? "met" : check.open ? "open" : "NOT MET"]);
  return table("Expectations", ["expectation", "measured", "expected", "kind", ""], rows);
}

function eventList(details: Details, cursor: Cursor): HTMLElement {
  const list = html("ol", {class: "events"}), title = html("summary", {});
  let seen = 0;
  cursor.draw(() => {
    for (; seen < details.events.length && list.children.length < kMostEvents; ++seen) {
      const event = details.events[seen];
      if (!(event.event in kEvents)) continue;
      list.append(html("li", {}, html("button", {type: "button", click: () => cursor.moveTo(event.t)},
                                      `${event.t.toFixed(2)} s`), ` ${textOf(event)}`));
    }
    title.textContent = `Events (${details.events.filter((e) => e.event in kEvents).length})`;
  });
  return html("details", {class: "data"}, title, list);
}

/** Numbers of the metrics, nested ones by their path. */
function metricRows(value: unknown, path: string): string[][] {
  if (value !== null && typeof value === "object" && !Array.isArray(value)) {
    return Object.entries(value as object).flatMap(([key, inner]) =>
        metricRows(inner, path === "" ? key : `${path}.${key}`));
  }
  if (Array.isArray(value)) return [];
  return [[path, typeof value === "number" ? String(Number(value.toPrecision(6))) : String(value)]];
}

function texts(details: Details): HTMLElement[] {
  const list: HTMLElement[] = [];
  if (details.metrics !== null) {
    list.push(openedTable("All metrics", () => ["metric", "value"],
                          () => metricRows({...details.metrics, expectations: []}, "")));
  }
  if (details.settings !== null) {
    list.push(html("details", {class: "data"}, html("summary", {}, details.settings.name),
                   html("pre", {tabindex: 0}, details.settings.text)));
  }
  if (details.explanation) {
    list.push(html("details", {class: "data"}, html("summary", {}, "Explanation by intervention"),
                   html("pre", {tabindex: 0}, JSON.stringify(details.explanation, null, 1))));
  }
  return list;
}

/** Verdict of a run that has ended, and what it failed. */
export function verdict(run: RunEntry, details: Details): HTMLElement[] {
  const figures = ["ate_origin_rmse_m", "ate_rmse_m"].map((key) => {
    const value = details.metrics?.[key];
    return typeof value === "number" ? `${key === "ate_rmse_m" ? "ATE" : "ATE origin"} ` +
        `${(1000 * value).toFixed(1)} mm` : null;
  }).filter((text) => text !== null);
  const failed = run.failed.map((text) => html("li", {}, text));
  const head = html("header", {class: run.passed ? "verdict good" : "verdict bad"},
              html("h1", {}, run.scenario, run.seed === null ? "" : `, seed ${run.seed}`),
              html("p", {class: "result"}, [run.verdict, ...figures].join(" · ")),
              html("p", {class: "small"}, run.hash === "" ? null : "hash ",
                   run.hash === "" ? null : html("code", {}, run.hash),
                   ` ${run.folder}${run.version === "" ? "" : `, Vinebench ${run.version}`}` +
                   (details.step > 1 ? `; one frame of ${details.step} is drawn` : "")));
  return failed.length > 0 ? [head, html("ul", {class: "failed"}, ...failed)] : [head];
}

function controls(cursor: Cursor): HTMLElement {
  const button = html("button", {type: "button", class: "play", click: () => cursor.toggle()},
                      "▶ Play");
  cursor.onPlay = (playing) => {
    button.textContent = playing ? "❚❚ Pause" : "▶ Play";
  };
  const speed = html("select", {"aria-label": "Speed", change: () => {
    cursor.speed = Number(speed.value);
  }}, ...["0.25", "0.5", "1", "2", "4", "8"].map((value) =>
      html("option", {value, selected: value === "1"}, `× ${value}`)));
  const range = html("input", {type: "range", min: 0, value: 0, "aria-label": "Time", input: () => {
    cursor.stop();
    cursor.move(Number(range.value));
  }});
  const time = html("output", {});
  cursor.draw(() => {
    range.max = String(cursor.times.length - 1);
    range.value = String(cursor.index);
  });
  cursor.listen((index) => {
    range.value = String(index);
    range.setAttribute("aria-valuetext", `${cursor.time.toFixed(2)} s`);
    time.textContent = `${cursor.time.toFixed(2)} s`;
  });
  return html("div", {class: "controls", role: "group", "aria-label": "Cursor"}, button, speed,
              range, time,
              html("span", {class: "note"}, "← → frame, ⇧ ten, space plays"));
}

function isTyping(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && /^(INPUT|SELECT|BUTTON|SUMMARY|TEXTAREA)$/.test(target.tagName);
}

export class RunView {
  readonly element: HTMLElement;
  readonly cursor: Cursor;

  /** Below `head`. A run that goes on is expected to end at `end`, s; who sees it is told which
      camera is chosen. */
  constructor(head: HTMLElement[], details: Details, pictures: Pictures | null, end?: number,
              chosen?: (camera: number) => void) {
    this.cursor = new Cursor(details.t.length > 0 ? details.t : [0], end);
    const checks = details.metrics?.expectations ?? [];
    const seen = pictures !== null ? player(pictures, this.cursor, details.frame, chosen)
        : html("section", {class: "panel missing"},
               "No pictures: run with --report, or give the report more room with --report-size.");
    this.element = html("main", {class: "run"},
        ...head,
        html("pre", {class: "summary", tabindex: 0}, details.summary.trim()),
        controls(this.cursor),
        html("div", {class: "sight"}, view3d(details, this.cursor), seen),
        charts(details, this.cursor),
        html("section", {class: "texts", "aria-label": "Figures"},
             checks.length > 0 ? checksTable(checks) : null, eventList(details, this.cursor),
             ...texts(details)));
  }

  key(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key === " " && !isTyping(event.target)) {
      this.cursor.toggle();
      event.preventDefault();
    } else if (!(event.target instanceof HTMLInputElement ||
                 event.target instanceof HTMLSelectElement) && this.cursor.key(event)) {
      event.preventDefault();
    }
  }
}
