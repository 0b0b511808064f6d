// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import {fixed, html, openedTable, svg} from "./dom";
import {Column, Report, RunEntry, Series, Values} from "./types";

const kSets = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

function median(values: number[]): number {
  const sorted = [...values].sort((a, b) => a - b), middle = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

function setsOf(report: Report): string[] {
  return [...new Set(report.runs.map((run) => run.set))];
}

function nameOf(run: RunEntry): string {
  return `${run.scenario}${run.seed === null ? "" : `, seed ${run.seed}`}` +
         (run.repeat > 1 ? `, repeat ${run.repeat}` : "");
}

function link(run: RunEntry, index: number): HTMLElement {
  return run.details ? html("a", {href: `#run=${index}`}, nameOf(run))
                     : html("span", {title: "left out to keep the report small"}, nameOf(run));
}

type Sort = {column: number; down: boolean};

function sortKey(run: RunEntry, column: number): number | string {
  if (column === 0) return `${run.scenario} ${String(run.seed).padStart(12)} ${run.repeat}`;
  if (column === 1) return Number(run.passed);
  return run.values[column - 2] ?? Infinity;
}

/** All runs; a click on a column's title sorts. Failures first. */
function runsTable(report: Report): HTMLElement {
  const sets = setsOf(report), body = html("tbody", {});
  let sort: Sort = {column: 1, down: false};
  const titles = ["run", "verdict", ...report.columns.map((column) => column.title)];
  const heads = titles.map((title, column) => {
    const button = html("button", {type: "button", click: () => {
      sort = {column, down: sort.column === column && !sort.down};
      fill();
    }}, title);
    return html("th", {scope: "col"}, button);
  });
  const fill = () => {
    const order = report.runs.map((_, i) => i);
    order.sort((a, b) => {
      const x = sortKey(report.runs[a], sort.column), y = sortKey(report.runs[b], sort.column);
      return (x < y ? -1 : x > y ? 1 : a - b) * (sort.down ? -1 : 1);
    });
    heads.forEach((head, column) => {
      head.setAttribute("aria-sort", column !== sort.column ? "none"
          : sort.down ? "descending" : "ascending");
    });
    body.replaceChildren(...order.map((i) => {
      const run = report.runs[i];
      const set = sets.length > 1 ? html("small", {}, ` ${run.set}`) : null;
      return html("tr", {class: run.passed ? "" : "bad"},
                  html("th", {scope: "row"}, link(run, i), set),
                  html("td", {class: "word"}, run.verdict),
                  ...report.columns.map((column, k) =>
                      html("td", {}, fixed(run.values[k], column.decimals))));
    }));
  };
  fill();
  return html("div", {class: "scroll", tabindex: 0, role: "region", "aria-label": "Runs"},
              html("table", {class: "runs"}, html("caption", {class: "hidden"}, "Runs"),
                   html("thead", {}, html("tr", {}, ...heads)), body));
}

function failures(report: Report): HTMLElement | null {
  const failed = report.runs.map((run, i) => ({run, i})).filter(({run}) => !run.passed);
  if (failed.length === 0) return null;
  return html("section", {"aria-label": "Failures"}, html("h2", {}, "Failures"),
              ...failed.slice(0, 50).map(({run, i}) => html("details", {class: "data", open: failed.length < 6},
                  html("summary", {}, link(run, i), ` ${run.verdict}`),
                  html("ul", {class: "failed"}, ...run.failed.map((text) => html("li", {}, text))))));
}

/** One dot a run, one line of dots a set, its median as a bar. */
function strip(report: Report, scenario: string, column: Column, k: number): HTMLElement | null {
  const sets = setsOf(report);
  const rows = sets.map((set) => report.runs.map((run) => ({run})).filter(({run}) => run.scenario === scenario && run.set === set && typeof run.values[k] === "number"));
  const all = rows.flatMap((row) => row.map(({run}) => run.values[k] as number));
  if (all.length < 2) return null;
  let low = Math.min(...all), high = Math.max(...all);
  if (low === high) return null;
  const margin = 0.06 * (high - low);
  low -= margin;
  high += margin;
  const kWidth = 320, kRow = 22;
  const x = (value: number) => kWidth * (value - low) / (high - low);
  const drawing = svg("svg", {viewBox: `0 0 ${kWidth} ${kRow * rows.length}`, class: "strip",
                              role: "img", "aria-label": `${column.title} of ${scenario}: ` +
                                  rows.map((row, s) => `${sets[s]} median ` + (row.length === 0 ? "unknown"
                                      : fixed(median(row.map(({run}) => run.values[k] as number)), column.decimals))).join(", ")});
  rows.forEach((row, s) => {
    const y = kRow * (s + 0.5);
    drawing.append(svg("line", {x1: 0, x2: kWidth, y1: y, y2: y, class: "grid"}));
    for (const {run} of row) {
      const dot = svg("circle", {cx: x(run.values[k] as number), cy: y, r: 4,
                                 class: run.passed ? "dot" : "dot bad"},
                      svg("title", {}, `${nameOf(run)}: ${fixed(run.values[k], column.decimals)}`));
      dot.style.fill = kSets[s % kSets.length];
      drawing.append(dot);
    }
    if (row.length > 0) {
      const at = x(median(row.map(({run}) => run.values[k] as number)));
      drawing.append(svg("line", {x1: at, x2: at, y1: y - 9, y2: y + 9, class: "median"}));
    }
  });
  return html("figure", {class: "distribution"}, html("figcaption", {}, column.title), drawing as unknown as Node,
              html("div", {class: "ends"}, html("span", {}, fixed(low + margin, column.decimals)),
                   html("span", {}, fixed(high - margin, column.decimals))),
              openedTable(`Table: ${column.title}`, () => ["run", ...(sets.length > 1 ? ["set"] : []), column.title],
                          () => rows.flatMap((row, s) => row.map(({run}) => [
                            nameOf(run), ...(sets.length > 1 ? [sets[s]] : []),
                            fixed(run.values[k], column.decimals)]))));
}

function distributions(report: Report): HTMLElement {
  const sets = setsOf(report);
  const scenarios = [...new Set(report.runs.map((run) => run.scenario))];
  const legend = sets.length < 2 ? null : html("p", {class: "legend"}, ...sets.map((set, s) => {
    const key = html("i", {});
    key.style.background = kSets[s % kSets.length];
    return html("span", {}, key, set);
  }));
  const sections = scenarios.map((scenario) => {
    const strips = report.columns.map((column, k) => strip(report, scenario, column, k))
        .filter((figure) => figure !== null);
    return strips.length === 0 ? null : html("section", {"aria-label": scenario}, html("h3", {}, scenario),
                                             html("div", {class: "strips"}, ...strips));
  });
  return html("section", {"aria-label": "Distributions"}, html("h2", {}, "Distributions"), legend, ...sections);
}

/** A figure over versions with the band that the newest should be in. */
function historyChart(versions: string[], series: Series): HTMLElement {
  const kWidth = 320, kHeight = 90;
  const known = series.values.filter((value) => value !== null) as number[];
  let low = Math.min(...known, ...(series.band ?? [])), high = Math.max(...known, ...(series.band ?? []));
  if (low === high) [low, high] = [low - 1, high + 1];
  const x = (i: number) => versions.length < 2 ? kWidth / 2 : 6 + (kWidth - 12) * i / (versions.length - 1);
  const y = (value: number) => 6 + (kHeight - 12) * (high - value) / (high - low);
  const drawing = svg("svg", {viewBox: `0 0 ${kWidth} ${kHeight}`, role: "img", class: "strip",
                              "aria-label": `${series.title} of ${series.scenario} over ${versions.length} versions: ${series.change}`});
  if (series.band) {
    drawing.append(svg("rect", {x: 0, width: kWidth, y: y(series.band[1]),
                                height: Math.max(1, y(series.band[0]) - y(series.band[1])), class: "band"}));
  }
  let path = "";
  series.values.forEach((value, i) => {
    if (value === null) return;
    path += `${path === "" ? "M" : "L"}${x(i)} ${y(value)}`;
  });
  drawing.append(svg("path", {d: path, class: "line history"}));
  series.values.forEach((value, i) => {
    if (value === null) return;
    const newest = i === versions.length - 1;
    drawing.append(svg("circle", {cx: x(i), cy: y(value), r: newest ? 4.5 : 3,
                                  class: newest ? `dot ${series.change}` : "dot"},
                       svg("title", {}, `${versions[i]}: ${fixed(value, series.decimals)}`)));
  });
  return html("figure", {class: `distribution ${series.change}`},
              html("figcaption", {}, `${series.title} `, html("b", {}, fixed(series.values[series.values.length - 1], series.decimals)),
                   series.change === "worse" ? " left the band, worse" : series.change === "better" ? " left the band, better" : ""),
              drawing as unknown as Node,
              openedTable(`Table: ${series.title}`, () => ["version", series.title],
                          () => versions.map((version, i) => [version, fixed(series.values[i], series.decimals)])));
}

function varies(values: Values): boolean {
  return new Set(values.filter((value) => value !== null)).size > 1;
}

function history(report: Report): HTMLElement | null {
  if (report.history === null) return null;
  const {versions, series} = report.history;
  const alarms = series.filter((s) => s.change === "worse");
  const scenarios = [...new Set(series.map((s) => s.scenario))];
  const text = alarms.length === 0 ? `No figure of ${versions[versions.length - 1]} has left its band to the worse.`
      : `${alarms.length} figures of ${versions[versions.length - 1]} have left their bands to the worse:`;
  return html("section", {"aria-label": "History"}, html("h2", {}, `History over ${versions.length} versions`),
              html("p", {class: alarms.length > 0 ? "alarm" : ""}, text),
              html("ul", {class: "failed"}, ...alarms.map((s) =>
                  html("li", {}, `${s.scenario}: ${s.title} ${fixed(s.values[s.values.length - 1], s.decimals)}, ` +
                      `expected ${fixed(s.band?.[0], s.decimals)} to ${fixed(s.band?.[1], s.decimals)}`))),
              ...scenarios.map((scenario) => html("section", {"aria-label": scenario}, html("h3", {}, scenario),
                  html("div", {class: "strips"}, ...series
                      .filter((s) => s.scenario === scenario && (varies(s.values) || s.change === "worse"))
                      .map((s) => historyChart(versions, s))))));
}

export function setView(report: Report): HTMLElement {
  const failed = report.runs.filter((run) => !run.passed).length;
  const scenarios = new Set(report.runs.map((run) => run.scenario)).size;
  const verdict = report.runs.length === 0 ? "" : failed === 0 ? "all passed" : `${failed} failed`;
  return html("main", {class: "set"},
              html("header", {class: failed === 0 ? "verdict good" : "verdict bad"},
                   html("h1", {}, report.title),
                   report.runs.length === 0 ? null : html("p", {class: "result"},
                        `${report.runs.length} runs of ${scenarios} scenarios · ${verdict}`),
                   html("p", {class: "small"}, `Vinebench ${report.version}`)),
              failures(report),
              report.comparison === null ? null : html("section", {"aria-label": "Comparison"},
                  html("h2", {}, "Comparison"), html("pre", {tabindex: 0}, report.comparison)),
              history(report),
              report.runs.length === 0 ? null : html("section", {"aria-label": "All runs"}, html("h2", {}, "Runs"), runsTable(report)),
              report.runs.length === 0 ? null : distributions(report));
}
