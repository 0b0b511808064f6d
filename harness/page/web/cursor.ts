// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

/** The instant that every part of a run's page shows. */
export class Cursor {
  private at = 0;
  private listeners: ((index: number) => void)[] = [];
  private growers: (() => void)[] = [];
  private timer = 0;
  private playing = false;
  speed = 1;
  onPlay: (playing: boolean) => void = () => {};

  /** `times` in s, ascending; at least one. More may be added while a run goes on, which is
      expected to end at `end`, s. */
  constructor(readonly times: number[], private readonly end = -Infinity) {}

  get index(): number {
    return this.at;
  }
  get time(): number {
    return this.times[this.at];
  }
  get begin(): number {
    return this.times[0];
  }
  /** Length of the axis of time, s. */
  get span(): number {
    return Math.max(1e-9, this.end - this.begin, this.times[this.times.length - 1] - this.begin);
  }
  get growing(): boolean {
    return this.end > -Infinity;
  }

  listen(listener: (index: number) => void): void {
    this.listeners.push(listener);
    listener(this.at);
  }

  /** Draws now, and again whenever the run has grown. */
  draw(draw: () => void): void {
    this.growers.push(draw);
    draw();
  }

  /** To be called after frames were added. */
  grow(): void {
    for (const draw of this.growers) draw();
  }

  /** Tells all parts where it is once more. */
  refresh(): void {
    for (const listener of this.listeners) listener(this.at);
  }

  move(index: number): void {
    const clamped = Math.max(0, Math.min(this.times.length - 1, Math.round(index)));
    if (clamped === this.at) return;
    this.at = clamped;
    for (const listener of this.listeners) listener(clamped);
  }

  /** To the frame that is nearest in time. */
  moveTo(time: number): void {
    this.move(this.nearest(time));
  }

  nearest(time: number): number {
    let low = 0, high = this.times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle;
    }
    return time - this.times[low] <= this.times[high] - time ? low : high;
  }

  /** Plays at `speed` times the run's own time. */
  toggle(): void {
    this.playing = !this.playing;
    this.onPlay(this.playing);
    cancelAnimationFrame(this.timer);
    if (!this.playing) return;
    if (this.at === this.times.length - 1) this.move(0);
    let last = performance.now(), time = this.time;
    const tick = (now: number) => {
      if (!this.playing) return;
      time += (now - last) / 1000 * this.speed;
      last = now;
      if (Math.abs(time - this.time) > 1) time = Math.max(time, this.time);
      this.moveTo(time);
      if (this.at === this.times.length - 1) this.toggle();
      else this.timer = requestAnimationFrame(tick);
    };
    this.timer = requestAnimationFrame(tick);
  }

  stop(): void {
    if (this.playing) this.toggle();
  }

  /** Arrows, Home and End; with shift ten frames. Whether the key was one of them. */
  key(event: KeyboardEvent): boolean {
    const step = event.shiftKey ? 10 : 1;
    const to: {[key: string]: number} = {
      ArrowLeft: this.at - step,
      ArrowRight: this.at + step,
      Home: 0,
      End: this.times.length - 1,
    };
    if (!(event.key in to)) return false;
    this.stop();
    this.move(to[event.key]);
    return true;
  }
}
