// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import {OrbitControls} from "three-orbit-controls";
import {Cursor} from "./cursor";
import {html} from "./dom";
import * as scene from "./scene";
import {Details} from "./types";

const kViews = ["overview", "from above", "follow"];

/** Parts of the scene that can be hidden. */
function partsOf(details: Details, cursor: Cursor, ground: number): Map<string, any> {
  const parts = new Map<string, any>();
  if (details.site !== null && details.site.rows.length > 0) {
    parts.set("vineyard", scene.vineyard(details.site, ground));
  }
  if (details.site !== null && details.site.tags.length > 0) {
    parts.set("tags", scene.tags(details.site));
  }
  if (details.landmarks !== undefined) parts.set("landmarks", scene.landmarks(details.landmarks));
  if (details.truth !== null) {
    parts.set("truth", scene.pathLine(details.truth, () => scene.colour("--truth"), 0));
  }
  if (details.estimate !== null) {
    const errors = details.error ?? [];
    const worst = Math.max(1e-9, ...errors.map((e) => e ?? 0));
    parts.set("estimate", scene.pathDots(
        details.estimate,
        (i) => details.error === null ? scene.colour("--estimate")
                                      : scene.errorColour((errors[i] ?? 0) / worst), 0.025));
  }
  const sigma = scene.largestSigma(details.covariance);
  if (sigma > 0) {
    const factor = Math.pow(10, Math.max(0, Math.floor(Math.log10(0.1 / (3 * sigma)))));
    parts.set(factor > 1 ? `3σ × ${factor}` : "3σ", scene.ellipsoids(details, factor));
  }
  const loops = scene.loops(details, (t) => cursor.nearest(t));
  if (loops.children.length > 0) parts.set("loops", loops);
  return parts;
}

function boundsOf(details: Details): any {
  const box = new THREE.Box3();
  for (const path of [details.truth, details.estimate]) {
    path?.[0].forEach((x, i) => {
      if (x !== null) {
        box.expandByPoint(new THREE.Vector3(x, path[1][i] as number, path[2][i] as number));
      }
    });
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
  const bounds = boundsOf(details), centre = bounds.getCenter(new THREE.Vector3());
  const size = Math.max(4.5, 1.15 * bounds.getSize(new THREE.Vector3()).length());
  const ground = bounds.min.z - 0.12;
  const parts = partsOf(details, cursor, ground);
  for (const part of parts.values()) world.add(part);
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
  look(kViews[0]);
  const buttons = kViews.map((name) => html("button", {type: "button", click: () => look(name)},
                                            name));
  const boxes = [...parts].map(([name, part]) => {
    const input = html("input", {type: "checkbox", checked: true, change: () => {
      part.visible = input.checked;
      draw();
    }});
    return html("label", {}, input, ` ${name}`);
  });
  return html("section", {class: "panel", "aria-label": "3D view"},
              html("div", {class: "bar"}, ...buttons, ...boxes), box);
}
