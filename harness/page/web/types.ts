// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// What report_page.cpp, run_details.cpp, film_pictures.cpp and history.cpp write.

export type Values = (number | null)[];

/** Columns x, y, z (m), qx, qy, qz, qw, in the world. */
export type Path = [Values, Values, Values, Values, Values, Values, Values];

export interface Column {
  key: string;
  title: string;
  decimals: number;
  larger_is_better: boolean;
}

export interface RunEntry {
  set: string;
  scenario: string;
  seed: number | null;
  repeat: number;
  folder: string;
  verdict: string;
  passed: boolean;
  failed: string[];
  version: string;
  hash: string;
  values: Values;
  details: boolean;
  pictures: number;
}

export interface Series {
  scenario: string;
  metric: string;
  title: string;
  decimals: number;
  values: Values;
  band?: [number, number];
  change: "inside" | "worse" | "better" | "unknown" | "absent";
}

export interface Report {
  title: string;
  live?: boolean;
  version: string;
  columns: Column[];
  runs: RunEntry[];
  comparison: string | null;
  history: { versions: string[]; series: Series[] } | null;
}

export interface Camera {
  name: string;
  width: number;
  height: number;
  fx: number;
  fy: number;
  T_body_cam: number[];
}

export interface Site {
  name: string;
  rows: [number, number, number, number][];
  vines: [number, number][];
  posts: [number, number][];
  objects: {
    class: string;
    centre: [number, number];
    size: [number, number, number];
    foot: number;
    yaw_deg: number;
    colour: [number, number, number];
    moves: boolean;
  }[];
  tags: { family: string; id: number; size: number; T_world_tag: number[]; registered: boolean }[];
  canopy: [number, number, number];
  post: [number, number];
  rate_hz: number;
  cameras: Camera[];
}

export interface RunEvent {
  t: number;
  event: string;
  [key: string]: unknown;
}

export interface Check {
  what: string;
  measured: string;
  expected: string;
  ok: boolean;
  open: boolean;
  kind: string;
}

export interface Details {
  site: Site | null;
  step: number;
  t: number[];
  frame: number[];
  truth: Path | null;
  estimate: Path | null;
  live: Path | null;
  error: Values | null;
  live_error: Values | null;
  status?: string;
  keyframes?: number[];
  covariance?: Values[];
  features?: Values[];
  inliers?: Values[];
  occluded?: Values[];
  events: RunEvent[];
  landmarks?: number[];
  metrics: { [key: string]: unknown; expectations?: Check[] } | null;
  summary: string;
  settings: { name: string; text: string } | null;
  explanation: unknown;
}

export interface Layout {
  width: number;
  height: number;
  cells: { camera: string; x: number; width: number }[];
}

export interface Picture {
  frame: number;
  features?: number[][];
  tags?: { camera: number; id: number; corners: number[] }[];
  layout?: Layout;  // its own, if not the film's
}

export interface Film extends Layout {
  pictures: Picture[];
}

// What live_view.cpp and tick_json.cpp send.

export interface LiveRun {
  title: string;
  total: number;
  rate_hz: number;
  site: Site;
  film: Layout;
}

export interface LiveTick {
  t: number;
  frame: number;
  truth: Values | null;
  live: Values | null;
  error: number | null;
  status: string;
  keyframe: boolean;
  covariance: Values | null;
  features: Values;
  inliers: Values;
  occluded: Values;
  events: RunEvent[];
}

export interface LivePicture extends Picture {
  jpeg: string;
}

export interface LiveState {
  paused: boolean;
  speed: number;
  camera: number;  // -1: all
}

export interface LiveEnd {
  verdict: string;
  report: string;
}
