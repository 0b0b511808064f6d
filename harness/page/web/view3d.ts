// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import {OrbitControls} from "three-orbit-controls";
import {Cursor} from "./cursor";
import {html} from "./dom";
import * as scene from "./scene";
import {Details} from "./types";

const kViews = ["overview", "from above", "follow"];

/** A part of the scene that can be hidden. */
interface Part {
  name: string;
  object: any;
}

/** What does not change. */
function fixedParts(details: Details, ground: number): Part[] {
  const parts: Part[] = [];
  if (details.site !== null && details.site.rows.length > 0) {
    parts.push({name: "vineyard", object: scene.vineyard(details.site, ground)});
  }
  if (details.site !== null && details.site.tags.length > 0) {
    parts.push({name: "tags", object: scene.tags(details.site)});
  }
  if (details.landmarks !== undefined) {
    parts.push({name: "landmarks", object: scene.landmarks(details.landmarks)});
  }
  return parts;
}

/** What grows with the run. */
function grownParts(details: Details, cursor: Cursor): Part[] {
  const parts: Part[] = [];
  if (details.truth !== null) {
    parts.push({name: "truth",
                object: scene.pathLine(details.truth, () => scene.colour("--truth"), 0)});
  }
  const path = details.estimate ?? details.live, errors = details.error ?? details.live_error;
  if (path !== null) {
    const worst = (errors ?? []).reduce((most: number, e) => Math.max(most, e ?? 0), 1e-9);
    const colour = (i: number) => errors === null ? scene.colour("--estimate")
                                                  : scene.errorColour((errors[i] ?? 0) / worst);
    parts.push({name: "estimate", object: scene.pathDots(path, colour, 0.025)});
  }
  const sigma = scene.largestSigma(details.covariance);
  if (sigma > 0) {
    const factor = Math.pow(10, Math.max(0, Math.floor(Math.log10(0.1 / (3 * sigma)))));
    parts.push({name: factor > 1 ? `3σ × ${factor}` : "3σ",
                object: scene.ellipsoids(details, factor)});
  }
  const loops = scene.loops(details, (t) => cursor.nearest(t));
  if (loops.children.length > 0) parts.push({name: "loops", object: loops});
  return parts;
}

function dispose(object: any): void {
  object.traverse((part: any) => {
    part.geometry?.dispose();
    part.material?.dispose();
  });
}

/** A part's name without its factor. */
function kindOf(name: string): string {
  return name.split(" ")[0];
}

/** Adds the parts to the world, with a box for each that hides it; the grown ones anew whenever the
    run has grown. */
function partBoxes(details: Details, cursor: Cursor, world: any, ground: number,
                   draw: () => void): HTMLElement {
  const hidden = new Set<string>(), boxes = html("span", {class: "boxes"});
  const fixed = fixedParts(details, ground);
  let grown: Part[] = [];
  for (const {object} of fixed) world.add(object);
  const boxOf = ({name, object}: Part) => {
    object.visible = !hidden.has(kindOf(name));
    const input = html("input", {type: "checkbox", checked: object.visible, change: () => {
      object.visible = input.checked;
      if (input.checked) hidden.delete(kindOf(name));
      else hidden.add(kindOf(name));
      draw();
    }});
    return html("label", {}, input, ` ${name}`);
  };
  let names = "";
  cursor.draw(() => {
    for (const {object} of grown) {
      world.remove(object);
      dispose(object);
    }
    grown = grownParts(details, cursor);
    for (const {name, object} of grown) {
      world.add(object);
      object.visible = !hidden.has(kindOf(name));
    }
    const list = [...fixed, ...grown];
    // A box that is replaced while a finger is on it would lose its click.
    const now = list.map(({name}) => name).join();
    if (now !== names || !cursor.growing) boxes.replaceChildren(...list.map(boxOf));
    names = now;
    draw();
  });
  return boxes;
}

/** Of the paths; of the vineyard before there are any. */
function boundsOf(details: Details, growing: boolean): any {
  const box = new THREE.Box3();
  for (const path of [details.truth, details.estimate]) {
    path?.[0].forEach((x, i) => {
      if (x !== null) {
        box.expandByPoint(new THREE.Vector3(x, path[1][i] as number, path[2][i] as number));
      }
    });
  }
  if (growing && details.site !== null && !box.isEmpty()) {
    const z = box.min.z;
    for (const [x1, y1, x2, y2] of details.site.rows) {
      box.expandByPoint(new THREE.Vector3(x1, y1, z)).expandByPoint(new THREE.Vector3(x2, y2, z));
    }
  }
  return box.isEmpty() ? new THREE.Box3(new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1))
                       : box;
}

/** Vineyard, paths, map and rover in three dimensions. */
export function view3d(details: Details, cursor: Cursor): HTMLElement {
  let renderer: any;
  const canvas = html("canvas", {tabindex: 0, role: "img",
                                 "aria-label": "The run in three dimensions; its figures are in " +
                                               "the tables of the charts"});
  try {
    renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true});
  } catch {
    return html("div", {class: "missing"}, "No 3D view: this browser has no WebGL.");
  }
  const world = new THREE.Scene();
  world.add(new THREE.HemisphereLight(0xffffff, 0x777766, 1.1));
  const bounds = boundsOf(details, cursor.growing), centre = bounds.getCenter(new THREE.Vector3());
  const size = Math.max(4.5, 1.15 * bounds.getSize(new THREE.Vector3()).length());
  const ground = bounds.min.z - 0.12;
  const cameras = details.site?.cameras ?? [];
  const trueRover = scene.rover(cameras, "--truth"), rover = scene.rover(cameras, "--estimate");
  world.add(trueRover, rover);
  const grid = new THREE.GridHelper(2 * Math.ceil(size), 2 * Math.ceil(size), scene.colour("--rule"),
                                    scene.colour("--rule"));
  grid.rotation.x = Math.PI / 2;
  grid.position.set(Math.round(centre.x), Math.round(centre.y), ground);
  world.add(grid);

  const camera = new THREE.PerspectiveCamera(45, 16 / 9, 0.05, 40 * size);
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  controls.enableKeys = false;  // the arrow keys move the cursor
  let waiting = false, following = false;
  const draw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      renderer.render(world, camera);
      canvas.dataset.drawn = "yes";
    });
  };
  const look = (name: string) => {
    following = name === "follow";
    controls.target.copy(centre);
    const from = name === "from above" ? [0, -0.001, 1.15] : [-0.45, -0.65, 0.55];
    camera.position.copy(centre).add(new THREE.Vector3(...from).multiplyScalar(size));
    if (following) follow();
    controls.update();
    draw();
  };
  const follow = () => {
    const object = trueRover.visible ? trueRover : rover;
    const behind = new THREE.Vector3(-1.6, 0.9, 1.3);
    const yaw = new THREE.Euler().setFromQuaternion(object.quaternion, "ZYX").z;
    controls.target.copy(object.position);
    camera.position.copy(object.position)
        .add(behind.applyAxisAngle(new THREE.Vector3(0, 0, 1), yaw));
    controls.update();
  };
  controls.addEventListener("change", draw);
  cursor.listen((index) => {
    for (const [object, path] of [[trueRover, details.truth],
                                  [rover, details.live ?? details.estimate]] as const) {
      const pose = scene.poseOf(path, index);
      object.visible = pose !== null;
      if (pose !== null) scene.placed(object, pose);
    }
    if (following) follow();
    draw();
  });
  const box = html("div", {class: "view"}, canvas);
  new ResizeObserver(() => {
    const width = box.clientWidth, height = box.clientHeight;
    if (width === 0 || height === 0) return;
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  }).observe(box);
  const boxes = partBoxes(details, cursor, world, ground, draw);
  look(cursor.growing ? "follow" : kViews[0]);
  const buttons = kViews.map((name) => html("button", {type: "button", click: () => look(name)},
                                            name));
  return html("section", {class: "panel", "aria-label": "3D view"},
              html("div", {class: "bar"}, ...buttons, boxes), box);
}
