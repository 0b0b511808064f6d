// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import {Cursor} from "./cursor";
import {Pictures} from "./data";
import {html, styleColour} from "./dom";
import {Film, Layout, Picture} from "./types";

function checkbox(name: string, changed: () => void): {input: HTMLInputElement; label: HTMLElement} {
  const input = html("input", {type: "checkbox", checked: true, change: changed});
  return {input, label: html("label", {}, input, ` ${name}`)};
}

/** The picture of the last frame that is not after the cursor's. */
function pictureAt(film: Film, frame: number): number {
  let at = 0;
  film.pictures.forEach((picture, i) => {
    if (picture.frame <= frame) at = i;
  });
  return at;
}

function drawFeatures(context: CanvasRenderingContext2D, list: number[]): void {
  context.fillStyle = styleColour("--feature");
  for (let i = 0; i + 1 < list.length; i += 2) {
    context.fillRect(list[i] - 1, list[i + 1] - 1, 2.2, 2.2);
  }
}

function drawTag(context: CanvasRenderingContext2D, corners: number[], id: number): void {
  context.strokeStyle = styleColour("--tag");
  context.fillStyle = styleColour("--tag");
  context.lineWidth = 2;
  context.beginPath();
  for (let i = 0; i + 1 < corners.length; i += 2) context.lineTo(corners[i], corners[i + 1]);
  context.closePath();
  context.stroke();
  context.font = "bold 13px sans-serif";
  context.fillText(`${id}`, corners[0] + 3, corners[1] + 14);
}

interface Cell {
  canvas: HTMLCanvasElement;
  figure: HTMLElement;
}

function cellsOf(layout: Layout): Cell[] {
  return layout.cells.map((cell) => {
    const canvas = html("canvas", {width: cell.width, height: layout.height, role: "img",
                                   "aria-label": `image of ${cell.camera}`});
    return {canvas, figure: html("figure", {}, canvas, html("figcaption", {}, cell.camera))};
  });
}

/** What the cameras saw at the cursor, with what the SLAM system found in it. `chosen` is told the
    number of a camera that is to be seen alone, -1 for all. */
export function player(pictures: Pictures, cursor: Cursor, frames: number[],
                       chosen: (camera: number) => void = () => {}): HTMLElement {
  const {film, jpegs} = pictures;
  const images = new WeakMap<Picture, HTMLImageElement>();
  const cameras = html("div", {class: "cameras"}), note = html("span", {class: "note"});
  const names = film.cells.map((cell) => cell.camera);
  let shown: Picture | null = null, layout: Layout | null = null, cells: Cell[] = [];
  const select = html("select", {"aria-label": "Camera", change: () => {
    chosen(select.selectedIndex - 1);
    draw();
  }}, ...["all cameras", ...names].map((name) => html("option", {}, name)));
  const draw = () => {
    const picture = shown, image = picture === null ? undefined : images.get(picture);
    if (picture === null || image === undefined || !image.complete) return;
    const own = picture.layout ?? film;
    if (layout === null || JSON.stringify(own) !== JSON.stringify(layout)) {
      layout = own;
      cells = cellsOf(own);
      cameras.replaceChildren(...cells.map((cell) => cell.figure));
    }
    const alone = names[select.selectedIndex - 1];
    const some = own.cells.filter((cell) => alone === undefined || cell.camera === alone);
    cameras.classList.toggle("alone", some.length === 1);
    own.cells.forEach((cell, i) => {
      const {canvas, figure} = cells[i];
      figure.hidden = !some.includes(cell);
      const context = canvas.getContext("2d") as CanvasRenderingContext2D;
      context.drawImage(image, cell.x, 0, cell.width, own.height, 0, 0, cell.width, own.height);
      if (features.input.checked && picture.features) drawFeatures(context, picture.features[i]);
      if (tags.input.checked) {
        for (const tag of picture.tags ?? []) {
          if (tag.camera === i) drawTag(context, tag.corners, tag.id);
        }
      }
      canvas.dataset.frame = `${picture.frame}`;
    });
    note.textContent = `frame ${picture.frame}`;
  };
  const features = checkbox("features", draw), tags = checkbox("tags", draw);
  const show = (at: number) => {
    const picture = film.pictures[at];
    if (picture === undefined || picture === shown) return;
    shown = picture;
    let image = images.get(picture);
    if (image === undefined) {
      image = new Image();
      image.src = `data:image/jpeg;base64,${jpegs[at]}`;
      images.set(picture, image);
    }
    image.decode().then(() => {
      if (shown === picture) draw();
    }, () => {
      note.textContent = `frame ${picture.frame}: damaged picture`;
    });
  };
  cursor.listen((index) => show(pictureAt(film, frames[index])));
  cursor.draw(() => show(pictureAt(film, frames[cursor.index])));
  return html("section", {class: "panel", "aria-label": "Cameras"},
              html("div", {class: "bar"}, select, features.label, tags.label, note), cameras);
}
