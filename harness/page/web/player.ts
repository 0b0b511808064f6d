// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import {Cursor} from "./cursor";
import {Pictures} from "./data";
import {html, styleColour} from "./dom";
import {Film} from "./types";

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

/** What the cameras saw at the cursor, with what the SLAM system found in it. */
export function player(pictures: Pictures, cursor: Cursor, frames: number[]): HTMLElement {
  const {film, jpegs} = pictures;
  const images: HTMLImageElement[] = [];
  const cells = film.cells.map((cell) => {
    const canvas = html("canvas", {width: cell.width, height: film.height, role: "img",
                                   "aria-label": `image of ${cell.camera}`});
    return {canvas, figure: html("figure", {}, canvas, html("figcaption", {}, cell.camera))};
  });
  let shown = -1;
  const note = html("span", {class: "note"});
  const draw = () => {
    const at = shown, image = images[at], picture = film.pictures[at];
    film.cells.forEach((cell, i) => {
      const context = cells[i].canvas.getContext("2d") as CanvasRenderingContext2D;
      context.drawImage(image, cell.x, 0, cell.width, film.height, 0, 0, cell.width, film.height);
      if (features.input.checked && picture.features) drawFeatures(context, picture.features[i]);
      if (tags.input.checked) {
        for (const tag of picture.tags ?? []) {
          if (tag.camera === i) drawTag(context, tag.corners, tag.id);
        }
      }
      cells[i].canvas.dataset.frame = `${picture.frame}`;
    });
    note.textContent = `frame ${picture.frame}`;
  };
  const features = checkbox("features", draw), tags = checkbox("tags", draw);
  const show = (at: number) => {
    if (at === shown) return;
    shown = at;
    if (images[at] === undefined) {
      images[at] = new Image();
      images[at].src = `data:image/jpeg;base64,${jpegs[at]}`;
    }
    images[at].decode().then(() => {
      if (shown === at) draw();
    }, () => {
      note.textContent = `frame ${film.pictures[at].frame}: damaged picture`;
    });
  };
  cursor.listen((index) => show(pictureAt(film, frames[index])));
  return html("section", {class: "panel", "aria-label": "Cameras"},
              html("div", {class: "bar"}, features.label, tags.label, note),
              html("div", {class: "cameras"}, ...cells.map((cell) => cell.figure)));
}
