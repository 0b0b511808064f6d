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

/** Where an instant is in a drawing, in its units. */
function across(cursor: Cursor, time: number): number {
  return kWidth * (time - cursor.begin) / cursor.span;
}

/** The part of every chart that follows the cursor, and moves it. */
function cursorArea(cursor: Cursor, drawing: SVGElement, label: string,
                    text: (index: number) => string): HTMLElement {
  const times = cursor.times;
  const mark = html("div", {class: "mark"});
  const area = html("div", {class: "area", tabindex: 0, role: "slider", "aria-label": label},
                    drawing as unknown as Node, mark);
  const show = (index: number) => {
    mark.style.left = `${100 * (times[index] - times[0]) / cursor.span}%`;
    area.setAttribute("aria-valuenow", times[index].toFixed(3));
    area.setAttribute("aria-valuetext", `${times[index].toFixed(2)} s: ${text(index)}`);
  };
  cursor.listen(show);
  cursor.draw(() => {
    area.setAttribute("aria-valuemin", `${times[0]}`);
    area.setAttribute("aria-valuemax", `${times[times.length - 1]}`);
    show(cursor.index);
  });
  const pick = (event: PointerEvent) => {
    const box = area.getBoundingClientRect();
    cursor.stop();
    cursor.moveTo(times[0] + cursor.span * (event.clientX - box.left) / box.width);
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

function tableOf(title: string, times: number[], lines: () => Line[],
                 decimals: number): HTMLElement {
  return openedTable(`Table: ${title}`, () => ["t, s", ...lines().map((line) => line.name)], () => {
    const rows: string[][] = [], columns = lines();
    const step = Math.max(1, Math.ceil(times.length / kTableRows));
    for (let i = 0; i < times.length; i += step) {
      rows.push([times[i].toFixed(2), ...columns.map((line) => fixed(line.values[i], decimals))]);
    }
    return rows;
  });
}

function drawSpans(cursor: Cursor, drawing: SVGElement, spans: Span[], least: number, y: number,
                   height: number): void {
  for (const s of spans) {
    const left = across(cursor, s.from), right = across(cursor, s.until);
    drawing.append(svg("rect", {x: left, width: Math.max(least, right - left), y, height,
                                class: s.className}, svg("title", {}, s.title)));
  }
}

/** Lines over time, from 0 up. */
export function chart(cursor: Cursor, title: string, unit: string, linesOf: () => Line[],
                      decimals: number, spansOf: () => Span[] = () => []): HTMLElement {
  const drawing = svg("svg", {viewBox: `0 0 ${kWidth} ${kHeight}`, preserveAspectRatio: "none",
                              "aria-hidden": "true"});
  const scale = html("div", {class: "scale", "aria-hidden": "true"});
  const legend = html("span", {class: "legend"});
  let lines: Line[] = [], readings: HTMLElement[] = [];
  const read = (index: number) => readings.forEach((reading, i) => {
    reading.textContent = fixed(lines[i].values[index], decimals);
  });
  cursor.draw(() => {
    lines = linesOf();
    const top = topOf(lines), step = niceStep(top);
    const y = (value: number) => kHeight * (1 - value / top);
    drawing.replaceChildren();
    scale.replaceChildren();
    drawSpans(cursor, drawing, spansOf(), 2, 0, kHeight);
    for (let value = 0; value <= top * 1.001; value += step) {
      drawing.append(svg("line", {x1: 0, x2: kWidth, y1: y(value), y2: y(value), class: "grid"}));
      const label = html("span", {}, String(Number(value.toPrecision(3))));
      label.style.top = `${y(value)}%`;
      scale.append(label);
    }
    for (const line of lines) {
      const d = pathOf(line.values, (i) => across(cursor, cursor.times[i]), y);
      const path = svg("path", {d, class: "line"});
      path.style.stroke = line.colour;
      drawing.append(path);
    }
    readings = lines.map(() => html("b", {}));
    legend.replaceChildren(...lines.map((line, i) => {
      const key = html("i", {});
      key.style.background = line.colour;
      return html("span", {}, key, `${line.name} `, readings[i]);
    }));
    read(cursor.index);
  });
  cursor.listen(read);
  const text = (index: number) =>
      lines.map((line) => `${line.name} ${fixed(line.values[index], decimals)} ${unit}`).join(", ");
  return html("figure", {class: "chart"},
              html("figcaption", {}, html("strong", {}, `${title}, ${unit}`), legend),
              html("div", {class: "plot"}, scale, cursorArea(cursor, drawing, title, text)),
              tableOf(title, cursor.times, linesOf, decimals));
}

export interface Lane {
  name: string;
  spans: Span[];
}

/** Rows of what lasts for a while. */
export function lanes(cursor: Cursor, title: string, lanesOf: () => Lane[]): HTMLElement {
  const kLane = 20;
  const drawing = svg("svg", {preserveAspectRatio: "none", "aria-hidden": "true"});
  const scale = html("div", {class: "scale names", "aria-hidden": "true"});
  const reading = html("span", {class: "legend"});
  let list: Lane[] = [];
  const present = (index: number) => {
    const time = cursor.times[index];
    const words = list.flatMap((lane) => lane.spans
        .filter((s) => s.from <= time && time <= s.until).map((s) => s.title));
    return words.length > 0 ? words.join(", ") : "nothing";
  };
  const area = cursorArea(cursor, drawing, title, present);
  cursor.draw(() => {
    list = lanesOf();
    drawing.setAttribute("viewBox", `0 0 ${kWidth} ${kLane * list.length}`);
    area.style.height = `${kLane * list.length}px`;
    drawing.replaceChildren();
    scale.replaceChildren();
    list.forEach((lane, row) => {
      const label = html("span", {title: lane.name}, lane.name);
      label.style.top = `${100 * (row + 0.5) / list.length}%`;
      scale.append(label);
      drawSpans(cursor, drawing, lane.spans, 3, kLane * row + 3, kLane - 6);
    });
    reading.textContent = present(cursor.index);
  });
  cursor.listen((index) => {
    reading.textContent = present(index);
  });
  return html("figure", {class: "chart"},
              html("figcaption", {}, html("strong", {}, title), reading),
              html("div", {class: "plot"}, scale, area),
              openedTable(`Table: ${title}`, () => ["from, s", "until, s", "what"], () =>
                  lanesOf().flatMap((lane) => lane.spans.map((s) =>
                      [s.from.toFixed(2), s.until.toFixed(2), s.title]))));
}

/** The axis below all charts. */
export function timeAxis(cursor: Cursor): HTMLElement {
  const axis = html("div", {class: "time", "aria-hidden": "true"});
  cursor.draw(() => {
    axis.replaceChildren();
    const step = niceStep(cursor.span * 0.6);
    for (let t = Math.ceil(cursor.begin / step) * step; t <= cursor.begin + cursor.span; t += step) {
      const label = html("span", {}, `${Number(t.toPrecision(6))} s`);
      label.style.left = `${100 * (t - cursor.begin) / cursor.span}%`;
      axis.append(label);
    }
  });
  return html("div", {class: "plot"}, html("div", {class: "scale"}), axis);
}
