// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import {Pictures} from "./data";
import {html} from "./dom";
import {RunView} from "./run_view";
import {Details, LiveEnd, LivePicture, LiveRun, LiveState, LiveTick, Path, Values} from "./types";

const kRedraw = 300;        // ms between two drawings of what grows
const kMostPictures = 300;  // kept for looking back
const kSpeeds = [["0", "as fast as it goes"], ["2", "× 2"], ["1", "real time"], ["0.5", "× 0.5"],
                 ["0.1", "× 0.1"]];

function emptyPath(): Path {
  return [[], [], [], [], [], [], []];
}

function push(path: Path, pose: Values | null): void {
  path.forEach((column, i) => column.push(pose === null ? null : pose[i]));
}

function noDetails(run: LiveRun): Details {
  const lists = () => run.site.cameras.map(() => [] as Values);
  return {site: run.site, step: 1, t: [], frame: [], truth: emptyPath(), estimate: null,
          live: emptyPath(), error: null, live_error: [], status: "", keyframes: [],
          covariance: [], features: lists(), inliers: lists(), occluded: lists(), events: [],
          metrics: null, summary: "", settings: null, explanation: null};
}

function add(details: Details, tick: LiveTick): void {
  details.t.push(tick.t);
  details.frame.push(tick.frame);
  push(details.truth as Path, tick.truth);
  push(details.live as Path, tick.live);
  details.live_error?.push(tick.error);
  details.status += tick.status;
  if (tick.keyframe) details.keyframes?.push(details.t.length - 1);
  details.covariance?.push(tick.covariance ?? [null, null, null, null, null, null]);
  for (const key of ["features", "inliers", "occluded"] as const) {
    details[key]?.forEach((values, i) => values.push(tick[key][i]));
  }
  details.events.push(...tick.events);
}

/** Every second one of the older half. */
function thin(pictures: Pictures): void {
  const half = pictures.jpegs.length >> 1;
  const keep = (_: unknown, i: number) => i >= half || i % 2 === 0;
  pictures.jpegs.splice(0, Infinity, ...pictures.jpegs.filter(keep));
  pictures.film.pictures.splice(0, Infinity, ...pictures.film.pictures.filter(keep));
}

/** A run while it goes on, from the events of view_server.cpp. */
export class LiveView {
  private readonly source = new EventSource("events");
  private readonly note = html("p", {class: "result", role: "status"}, "waiting for the run");
  private readonly title = html("h1", {}, "Vinebench");
  private readonly pause = html("button", {type: "button", class: "play", click: () => {
    void this.wish({paused: !this.paused});
  }}, "❚❚ Pause run");
  private readonly speed = html("select", {"aria-label": "Speed of the run", change: () => {
    void this.wish({speed: Number(this.speed.value)});
  }}, ...kSpeeds.map(([value, name]) => html("option", {value}, name)));
  private readonly head: HTMLElement[];
  private run: LiveRun | null = null;
  private details: Details | null = null;
  private pictures: Pictures | null = null;
  private view: RunView | null = null;
  private paused = false;
  private ended = false;
  private timer = 0;
  private arrivals: [number, number][] = [];  // ms, t of the latest ticks

  constructor(private readonly app: HTMLElement, private readonly shown: (view: RunView) => void) {
    const step = html("button", {type: "button", click: () => void this.wish({step: true})},
                      "One frame");
    const latest = html("button", {type: "button", click: () => this.toLatest()}, "Latest frame");
    this.head = [html("header", {class: "verdict live"}, this.title, this.note,
                      html("div", {class: "bar", role: "group", "aria-label": "Run"}, this.pause,
                           step, this.speed, latest))];
    app.replaceChildren(html("main", {class: "run"}, ...this.head));
    this.on<LiveRun>("begin", (run) => this.begin(run));
    this.on<LiveTick[]>("ticks", (ticks) => this.grow(ticks));
    this.on<LivePicture>("picture", (picture) => this.add(picture));
    this.on<LiveState>("state", (state) => this.show(state));
    this.on<LiveEnd>("end", (end) => void this.end(end));
    this.source.addEventListener("error", () => {
      if (!this.ended) this.tell("no connection: the run was stopped, or the network is down");
    });
    document.body.dataset.ready = "live";
  }

  private on<Message>(name: string, handle: (message: Message) => void): void {
    this.source.addEventListener(name, (event) => {
      handle(JSON.parse((event as MessageEvent<string>).data) as Message);
    });
  }

  private tell(text: string): void {
    this.note.textContent = text;
  }

  private async wish(body: object): Promise<void> {
    const answer = await fetch("control", {method: "POST", body: JSON.stringify(body)})
        .catch(() => null);
    if (answer !== null && !answer.ok) this.tell(await answer.text());
  }

  private begin(run: LiveRun): void {
    if (this.run !== null) return;  // connected again
    this.run = run;
    this.title.textContent = run.title;
    document.title = `${run.title}: live`;
    this.details = noDetails(run);
    this.pictures = {film: {...run.film, pictures: []}, jpegs: []};
  }

  private grow(ticks: LiveTick[]): void {
    const {run, details, pictures} = this;
    if (run === null || details === null) return;
    const latest = this.view === null || this.view.cursor.index === details.t.length - 1;
    for (const tick of ticks) add(details, tick);
    if (this.view === null) {
      const end = details.t[0] + (run.total - 1) / run.rate_hz;
      this.view = new RunView(this.head, details, pictures, end,
                              (camera) => void this.wish({camera}));
      this.app.replaceChildren(this.view.element);
      this.shown(this.view);
    }
    const last = ticks[ticks.length - 1];
    this.arrivals.push([performance.now(), last.t]);
    if (this.arrivals.length > 20) this.arrivals.shift();
    this.draw();
    if (latest) this.toLatest();
  }

  /** At once, and then not again for a while. */
  private draw(): void {
    if (this.timer !== 0) return;
    this.view?.cursor.grow();
    this.tellProgress();
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      const behind = this.arrivals.length > 0 &&
          performance.now() - this.arrivals[this.arrivals.length - 1][0] <= kRedraw;
      if (behind) this.draw();
    }, kRedraw);
  }

  private toLatest(): void {
    this.view?.cursor.move(Infinity);
  }

  private tellProgress(): void {
    const {run, details, arrivals} = this;
    if (run === null || details === null || arrivals.length === 0 || this.ended) return;
    const [from, to] = [arrivals[0], arrivals[arrivals.length - 1]];
    const rate = to[0] > from[0] ? 1000 * (to[1] - from[1]) / (to[0] - from[0]) : 0;
    const factor = rate > 0 && !this.paused ? `, ${rate.toFixed(1)} × real time` : "";
    this.tell(`${this.paused ? "paused" : "running"}: frame ${details.t.length} of ${run.total}` +
              factor);
  }

  private add(picture: LivePicture): void {
    if (this.pictures === null) return;
    const {jpeg, ...rest} = picture;
    this.pictures.jpegs.push(jpeg);
    this.pictures.film.pictures.push(rest);
    if (this.pictures.jpegs.length > kMostPictures) thin(this.pictures);
    this.view?.cursor.refresh();
  }

  private show(state: LiveState): void {
    this.paused = state.paused;
    this.pause.textContent = state.paused ? "▶ Go on" : "❚❚ Pause run";
    this.speed.value = String(state.speed);
    this.tellProgress();
  }

  /** The page becomes the run's report. */
  private async end(end: LiveEnd): Promise<void> {
    this.ended = true;
    this.source.close();
    this.tell(`${end.verdict}; the report is coming`);
    const answer = end.report === "" ? null : await fetch("report").catch(() => null);
    if (answer === null || !answer.ok) return this.tell(`${end.verdict}; report: ${end.report}`);
    const page = await answer.text();
    document.open();
    document.write(page);
    document.close();
  }
}
