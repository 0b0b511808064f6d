// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import {Cursor} from "./cursor";
import {fixed, html, openedTable, svg} from "./dom";
import {Values} from "./types";

const kWidth = 1000, kHeight = 100;  // of the drawing's own units
const kTableRows = 40;

export interface Line {
  name: string;
  values: Values;
  colour: string;  // of CSS
}

export interface Span {
  from: number;  // s
  until: number;
  className: string;
  title: string;
}

function niceStep(range: number): number {
  const rough = range / 4, unit = Math.pow(10, Math.floor(Math.log10(rough)));
  for (const step of [1, 2, 5, 10]) if (step * unit >= rough) return step * unit;
  return 10 * unit;
}

/** Values of 0 to a round number above the largest. */
function topOf(lines: Line[]): number {
  let top = 0;
  for (const line of lines) for (const value of line.values) top = Math.max(top, value ?? 0);
  if (top === 0) return 1;
  const step = niceStep(top);
  return Math.ceil(top / step) * step;
}

/** The largest and smallest value of each column of the drawing: no peak is lost. */
function pathOf(values: Values, x: (i: number) => number, y: (v: number) => number): string {
  const bins = Math.min(values.length, kWidth);
  let text = "", pen = false;
  for (let bin = 0; bin < bins; ++bin) {
    const begin = Math.floor(bin * values.length / bins);
    const end = Math.max(begin + 1, Math.floor((bin + 1) * values.length / bins));
    let low = begin, high = begin, known = false;
    for (let i = begin; i < end; ++i) {
      const value = values[i];
      if (value === null) continue;
      if (!known || value < (values[low] as number)) low = i;
      if (!known || value > (values[high] as number)) high = i;
      known = true;
    }
    if (!known) {
      pen = false;
      continue;
    }
    for (const i of low === high ? [low] : low < high ? [low, high] : [high, low]) {
      text += `${pen ? "L" : "M"}${x(i).toFixed(1)} ${y(values[i] as number).toFixed(2)}`;
      pen = true;
    }
  }
  return text;
}

/** The part of every chart that follows the cursor, and moves it. */
function cursorArea(cursor: Cursor, drawing: SVGElement, label: string,
                    text: (index: number) => string): HTMLElement {
  const times = cursor.times;
  const mark = html("div", {class: "mark"});
  const area = html("div", {class: "area", tabindex: 0, role: "slider", "aria-label": label,
                            "aria-valuemin": times[0],
                            "aria-valuemax": times[times.length - 1]}, drawing as unknown as Node,
                    mark);
  const span = Math.max(1e-9, times[times.length - 1] - times[0]);
  cursor.listen((index) => {
    mark.style.left = `${100 * (times[index] - times[0]) / span}%`;
    area.setAttribute("aria-valuenow", times[index].toFixed(3));
    area.setAttribute("aria-valuetext", `${times[index].toFixed(2)} s: ${text(index)}`);
  });
  const pick = (event: PointerEvent) => {
    const box = area.getBoundingClientRect();
    cursor.stop();
    cursor.moveTo(times[0] + span * (event.clientX - box.left) / box.width);
  };
  area.addEventListener("pointerdown", (event) => {
    area.setPointerCapture(event.pointerId);
    pick(event);
  });
  area.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) pick(event);
  });
  return area;
}

function tableOf(title: string, times: number[], lines: Line[], decimals: number): HTMLElement {
  return openedTable(`Table: ${title}`, ["t, s", ...lines.map((line) => line.name)], () => {
    const rows: string[][] = [];
    const step = Math.max(1, Math.ceil(times.length / kTableRows));
    for (let i = 0; i < times.length; i += step) {
      rows.push([times[i].toFixed(2), ...lines.map((line) => fixed(line.values[i], decimals))]);
    }
    return rows;
  });
}

/** Lines over time, from 0 up. */
export function chart(cursor: Cursor, title: string, unit: string, lines: Line[], decimals: number,
                      spans: Span[] = []): HTMLElement {
  const times = cursor.times, top = topOf(lines);
  const span = Math.max(1e-9, times[times.length - 1] - times[0]);
  const x = (i: number) => kWidth * (times[i] - times[0]) / span;
  const y = (value: number) => kHeight * (1 - value / top);
  const drawing = svg("svg", {viewBox: `0 0 ${kWidth} ${kHeight}`, preserveAspectRatio: "none",
                              "aria-hidden": "true"});
  for (const s of spans) {
    const left = kWidth * (s.from - times[0]) / span, right = kWidth * (s.until - times[0]) / span;
    drawing.append(svg("rect", {x: left, width: Math.max(2, right - left), y: 0, height: kHeight,
                                class: s.className}, svg("title", {}, s.title)));
  }
  const scale = html("div", {class: "scale", "aria-hidden": "true"});
  const step = niceStep(top);
  for (let value = 0; value <= top * 1.001; value += step) {
    drawing.append(svg("line", {x1: 0, x2: kWidth, y1: y(value), y2: y(value), class: "grid"}));
    const label = html("span", {}, String(Number(value.toPrecision(3))));
    label.style.top = `${y(value)}%`;
    scale.append(label);
  }
  const legend = html("span", {class: "legend"});
  const readings: HTMLElement[] = [];
  for (const line of lines) {
    const path = svg("path", {d: pathOf(line.values, x, y), class: "line"});
    path.style.stroke = line.colour;
    drawing.append(path);
    const key = html("i", {});
    key.style.background = line.colour;
    readings.push(html("b", {}));
    legend.append(html("span", {}, key, `${line.name} `, readings[readings.length - 1]));
  }
  const text = (index: number) =>
      lines.map((line) => `${line.name} ${fixed(line.values[index], decimals)} ${unit}`).join(", ");
  cursor.listen((index) => readings.forEach((reading, i) => {
    reading.textContent = fixed(lines[i].values[index], decimals);
  }));
  return html("figure", {class: "chart"},
              html("figcaption", {}, html("strong", {}, `${title}, ${unit}`), legend),
              html("div", {class: "plot"}, scale, cursorArea(cursor, drawing, title, text)),
              tableOf(title, times, lines, decimals));
}

export interface Lane {
  name: string;
  spans: Span[];
}

/** Rows of what lasts for a while. */
export function lanes(cursor: Cursor, title: string, list: Lane[]): HTMLElement {
  const times = cursor.times;
  const span = Math.max(1e-9, times[times.length - 1] - times[0]);
  const kLane = 20;
  const height = kLane * list.length;
  const drawing = svg("svg", {viewBox: `0 0 ${kWidth} ${height}`, preserveAspectRatio: "none",
                              "aria-hidden": "true"});
  const scale = html("div", {class: "scale names", "aria-hidden": "true"});
  list.forEach((lane, row) => {
    const label = html("span", {title: lane.name}, lane.name);
    label.style.top = `${100 * (row + 0.5) / list.length}%`;
    scale.append(label);
    for (const s of lane.spans) {
      const left = kWidth * (s.from - times[0]) / span;
      const right = kWidth * (s.until - times[0]) / span;
      drawing.append(svg("rect", {x: left, width: Math.max(3, right - left), y: kLane * row + 3,
                                  height: kLane - 6, class: s.className},
                         svg("title", {}, s.title)));
    }
  });
  const present = (index: number) => {
    const words = list.flatMap((lane) => lane.spans
        .filter((s) => s.from <= times[index] && times[index] <= s.until).map((s) => s.title));
    return words.length > 0 ? words.join(", ") : "nothing";
  };
  const reading = html("span", {class: "legend"});
  cursor.listen((index) => {
    reading.textContent = present(index);
  });
  const area = cursorArea(cursor, drawing, title, present);
  area.style.height = `${height}px`;
  return html("figure", {class: "chart"},
              html("figcaption", {}, html("strong", {}, title), reading),
              html("div", {class: "plot"}, scale, area),
              openedTable(`Table: ${title}`, ["from, s", "until, s", "what"], () =>
                  list.flatMap((lane) => lane.spans.map((s) =>
                      [s.from.toFixed(2), s.until.toFixed(2), s.title]))));
}

/** The axis below all charts. */
export function timeAxis(cursor: Cursor): HTMLElement {
  const times = cursor.times;
  const span = Math.max(1e-9, times[times.length - 1] - times[0]);
  const axis = html("div", {class: "time", "aria-hidden": "true"});
  const step = niceStep(span * 0.6);
  for (let t = Math.ceil(times[0] / step) * step; t <= times[times.length - 1]; t += step) {
    const label = html("span", {}, `${Number(t.toPrecision(6))} s`);
    label.style.left = `${100 * (t - times[0]) / span}%`;
    axis.append(label);
  }
  return html("div", {class: "plot"}, html("div", {class: "scale"}), axis);
}
