// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

type Child = Node | string | null;
type Attributes = { [name: string]: string | number | boolean | ((event: any) => void) };

function fill(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child !== null) element.append(child);
}

/** An HTML element; a function among the attributes listens to the event of that name. */
export function html<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fill(element, attributes, children);
  return element;
}

/** A table that is made anew whenever it is opened. */
export function openedTable(title: string, header: () => string[],
                            rows: () => string[][]): HTMLElement {
  const summary = html("summary", {}, title), details = html("details", {class: "data"}, summary);
  details.addEventListener("toggle", () => {
    if (details.open) details.replaceChildren(summary, table(title, header(), rows()));
  });
  return details;
}

export function table(caption: string, header: string[], rows: string[][]): HTMLElement {
  const head = html("tr", {}, ...header.map((text) => html("th", {scope: "col"}, text)));
  const body = rows.map((row) => html("tr", {}, ...row.map((text, i) =>
      i === 0 ? html("th", {scope: "row"}, text) : html("td", {}, text))));
  return html("div", {class: "scroll", tabindex: 0, role: "region", "aria-label": caption},
              html("table", {}, html("caption", {class: "hidden"}, caption),
                   html("thead", {}, head), html("tbody", {}, ...body)));
}

export function fixed(value: number | null | undefined, decimals: number): string {
  return value === null || value === undefined || !isFinite(value) ? "–" : value.toFixed(decimals);
}

/** A colour of the page's style, such as "--accent". */
export function styleColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
