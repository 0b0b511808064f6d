// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import {styleColour} from "./dom";
import {Camera, Details, Path, Site, Values} from "./types";

// Objects of the 3D view, in the world's axes: x east, y north, z up, m.

export function colour(name: string): any {
  return new THREE.Color(styleColour(name));
}

/** Dark blue to yellow, 0 to 1 (after viridis): readable for the colour-blind and in print. */
export function errorColour(share: number): any {
  const stops = ["#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725"];
  const at = Math.max(0, Math.min(1, share)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  return new THREE.Color(stops[i]).lerp(new THREE.Color(stops[i + 1]), at - i);
}

export function placed(object: any, pose: number[]): any {
  object.position.set(pose[0], pose[1], pose[2]);
  object.quaternion.set(pose[3], pose[4], pose[5], pose[6]);
  return object;
}

export function poseOf(path: Path | null, index: number): number[] | null {
  if (path === null || path[0][index] === null) return null;
  return path.map((column) => column[index] as number);
}

/** Everything between two poses without a gap. */
function pieces(path: Path): number[][] {
  const list: number[][] = [];
  let piece: number[] = [];
  path[0].forEach((x, i) => {
    if (x !== null) piece.push(i);
    else if (piece.length > 0) {
      list.push(piece);
      piece = [];
    }
  });
  if (piece.length > 0) list.push(piece);
  return list;
}

export function pathLine(path: Path, colourOf: (i: number) => any, lift: number): any {
  const group = new THREE.Group();
  for (const piece of pieces(path)) {
    const points: number[] = [], colours: number[] = [];
    for (const i of piece) {
      points.push(path[0][i] as number, path[1][i] as number, (path[2][i] as number) + lift);
      colourOf(i).toArray(colours, colours.length);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
    const material = new THREE.LineBasicMaterial({vertexColors: THREE.VertexColors});
    group.add(new THREE.Line(geometry, material));
  }
  return group;
}

/** Small spheres along the path, which a line of one pixel is not. */
export function pathDots(path: Path, colourOf: (i: number) => any, radius: number): any {
  const known = path[0].map((x, i) => x === null ? -1 : i).filter((i) => i >= 0);
  const step = Math.max(1, Math.ceil(known.length / 400));
  const group = new THREE.Group();
  const sphere = new THREE.SphereBufferGeometry(radius, 8, 6);
  for (let k = 0; k < known.length; k += step) {
    const i = known[k];
    const dot = new THREE.Mesh(sphere, new THREE.MeshBasicMaterial({color: colourOf(i)}));
    dot.position.set(path[0][i], path[1][i], path[2][i]);
    group.add(dot);
  }
  return group;
}

function instanced(geometry: any, material: any, places: number[][]): any {
  const mesh = new THREE.InstancedMesh(geometry, material, Math.max(1, places.length));
  mesh.count = places.length;
  const matrix = new THREE.Matrix4();
  places.forEach((p, i) => mesh.setMatrixAt(i, matrix.makeTranslation(p[0], p[1], p[2])));
  mesh.frustumCulled = false;
  return mesh;
}

/** A cylinder along z. */
function upright(radius: number, height: number): any {
  return new THREE.CylinderBufferGeometry(radius, radius, height, 8).rotateX(Math.PI / 2);
}

export function vineyard(site: Site, ground: number): any {
  const group = new THREE.Group();
  const [depth, foot, top] = site.canopy, [radius, postHeight] = site.post;
  const leaves = new THREE.MeshLambertMaterial({color: colour("--leaf"), transparent: true,
                                                opacity: 0.28, depthWrite: false});
  for (const [x1, y1, x2, y2] of site.rows) {
    const length = Math.hypot(x2 - x1, y2 - y1);
    const wall = new THREE.Mesh(
        new THREE.BoxBufferGeometry(length, depth, Math.max(0.1, top - foot)), leaves);
    wall.position.set((x1 + x2) / 2, (y1 + y2) / 2, ground + (top + foot) / 2);
    wall.rotation.z = Math.atan2(y2 - y1, x2 - x1);
    group.add(wall);
  }
  const wood = new THREE.MeshLambertMaterial({color: colour("--wood")});
  const stone = new THREE.MeshLambertMaterial({color: colour("--post")});
  group.add(instanced(upright(0.03, foot), wood,
                      site.vines.map(([x, y]) => [x, y, ground + foot / 2])));
  group.add(instanced(upright(Math.max(0.02, radius), postHeight), stone,
                      site.posts.map(([x, y]) => [x, y, ground + postHeight / 2])));
  for (const object of site.objects) {
    const box = new THREE.Mesh(
        new THREE.BoxBufferGeometry(object.size[0], object.size[1], object.size[2]),
        new THREE.MeshLambertMaterial({color: new THREE.Color(...object.colour),
                                       transparent: object.moves, opacity: 0.6}));
    box.position.set(object.centre[0], object.centre[1], object.foot + object.size[2] / 2);
    box.rotation.z = object.yaw_deg * Math.PI / 180;
    group.add(box);
  }
  return group;
}

/** Text that faces the camera. */
function label(text: string, height: number): any {
  const canvas = document.createElement("canvas");
  canvas.width = 128;
  canvas.height = 64;
  const context = canvas.getContext("2d") as CanvasRenderingContext2D;
  context.font = "bold 40px sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.strokeStyle = styleColour("--paper");
  context.lineWidth = 8;
  context.strokeText(text, 64, 32);
  context.fillStyle = styleColour("--ink");
  context.fillText(text, 64, 32);
  const material = new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas)});
  const sprite = new THREE.Sprite(material);
  sprite.scale.set(2 * height, height, 1);
  return sprite;
}

export function tags(site: Site): any {
  const group = new THREE.Group();
  for (const tag of site.tags) {
    const square = new THREE.Group();
    const face = (size: number, shade: number, z: number) => {
      const mesh = new THREE.Mesh(
          new THREE.PlaneBufferGeometry(size, size),
          new THREE.MeshBasicMaterial({color: shade, side: THREE.DoubleSide}));
      mesh.position.z = z;
      square.add(mesh);
    };
    face(1.25 * tag.size, 0xffffff, 0.002);
    face(tag.size, 0x111111, 0);
    face(0.5 * tag.size, 0xffffff, -0.002);
    placed(square, tag.T_world_tag);
    group.add(square);
    const name = label(tag.registered ? `${tag.id}` : `(${tag.id})`, 0.3);
    name.position.set(tag.T_world_tag[0], tag.T_world_tag[1], tag.T_world_tag[2] + 0.3);
    group.add(name);
  }
  return group;
}

export function landmarks(list: number[]): any {
  const points: number[] = [], colours: number[] = [];
  for (let i = 0; i + 3 < list.length; i += 4) {
    points.push(list[i] / 100, list[i + 1] / 100, list[i + 2] / 100);
    const grey = 0.15 + 0.7 * list[i + 3] / 255;
    colours.push(grey, grey, grey);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
  return new THREE.Points(geometry, new THREE.PointsMaterial(
      {size: 0.02, sizeAttenuation: true, vertexColors: THREE.VertexColors}));
}

/** Axes and lengths of a covariance's ellipsoid: Jacobi's eigenvalue algorithm, 3 x 3. */
export function ellipsoidAxes(c: number[]): {vectors: number[][]; sigmas: number[]} {
  const a = [[c[0], c[1], c[2]], [c[1], c[3], c[4]], [c[2], c[4], c[5]]];
  const v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 20; ++sweep) {
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(a[p][q]) < 1e-30) continue;
      const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const t = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.hypot(theta, 1));
      const cos = 1 / Math.hypot(t, 1), sin = t * cos;
      for (let k = 0; k < 3; ++k) {
        [a[k][p], a[k][q]] = [cos * a[k][p] - sin * a[k][q], sin * a[k][p] + cos * a[k][q]];
      }
      for (let k = 0; k < 3; ++k) {
        [a[p][k], a[q][k]] = [cos * a[p][k] - sin * a[q][k], sin * a[p][k] + cos * a[q][k]];
        [v[k][p], v[k][q]] = [cos * v[k][p] - sin * v[k][q], sin * v[k][p] + cos * v[k][q]];
      }
    }
  }
  return {vectors: v, sigmas: [0, 1, 2].map((i) => Math.sqrt(Math.max(0, a[i][i])))};
}

/** Ellipsoids of three standard deviations, `factor` times as large. */
export function ellipsoids(details: Details, factor: number): any {
  const group = new THREE.Group();
  const path = details.live ?? details.estimate, covariance = details.covariance;
  if (path === null || covariance === undefined) return group;
  const step = Math.max(1, Math.ceil(covariance.length / 60));
  const sphere = new THREE.SphereBufferGeometry(1, 16, 12);
  const material = new THREE.MeshBasicMaterial({color: colour("--estimate"), transparent: true,
                                                opacity: 0.35, depthWrite: false});
  for (let i = 0; i < covariance.length; i += step) {
    const c = covariance[i], pose = poseOf(path, i);
    if (pose === null || c.some((value) => value === null)) continue;
    const {vectors, sigmas} = ellipsoidAxes(c as number[]);
    const [x, y, z] = [0, 1, 2].map((k) => {
      const length = Math.max(1e-4, 3 * factor * sigmas[k]);
      return new THREE.Vector3(...vectors.map((row) => row[k] * length));
    });
    const mesh = new THREE.Mesh(sphere, material);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.makeBasis(x, y, z).setPosition(pose[0], pose[1], pose[2]);
    group.add(mesh);
  }
  return group;
}

/** The largest standard deviation, m. */
export function largestSigma(covariance: Values[] | undefined): number {
  let largest = 0;
  for (const c of covariance ?? []) {
    for (const i of [0, 3, 5]) largest = Math.max(largest, Math.sqrt(c[i] ?? 0));
  }
  return largest;
}

/** Lines between the two places of each closed loop: green right, red wrong. */
export function loops(details: Details, nearest: (t: number) => number): any {
  const group = new THREE.Group();
  const path = details.estimate ?? details.truth;
  for (const event of details.events) {
    if (event.event !== "loop_closure") continue;
    const ends = [event.earlier_t, event.later_t].map((t) => poseOf(path, nearest(t as number)));
    if (ends[0] === null || ends[1] === null) continue;
    const geometry = new THREE.BufferGeometry().setFromPoints(ends.map((p) =>
        new THREE.Vector3((p as number[])[0], (p as number[])[1], (p as number[])[2] + 0.15)));
    const right = event.correct !== false;
    const material = new THREE.LineBasicMaterial({color: colour(right ? "--good" : "--bad")});
    group.add(new THREE.Line(geometry, material));
    for (const p of ends as number[][]) {
      const dot = new THREE.Mesh(new THREE.SphereBufferGeometry(0.05, 12, 8),
                                 new THREE.MeshBasicMaterial({color: material.color}));
      dot.position.set(p[0], p[1], p[2] + 0.15);
      group.add(dot);
    }
  }
  return group;
}

/** A box of the rover's size with the views of its cameras. */
export function rover(cameras: Camera[], name: string): any {
  const group = new THREE.Group();
  const edges = new THREE.EdgesGeometry(new THREE.BoxBufferGeometry(0.5, 0.4, 0.25));
  const material = new THREE.LineBasicMaterial({color: colour(name)});
  group.add(new THREE.LineSegments(edges, material));
  const kReach = 0.35;  // m
  for (const camera of cameras) {
    const w = kReach * camera.width / (2 * camera.fx), h = kReach * camera.height / (2 * camera.fy);
    const corners = [[-w, -h], [w, -h], [w, h], [-w, h]].map(([x, y]) =>
        new THREE.Vector3(x, y, kReach));
    const points: any[] = [];
    corners.forEach((corner, i) => {
      points.push(new THREE.Vector3(), corner, corner, corners[(i + 1) % 4]);
    });
    const frustum = new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(points),
                                           material);
    group.add(placed(frustum, camera.T_body_cam));
  }
  return group;
}
