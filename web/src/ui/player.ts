// SPDX-License-Identifier: GPL-3.0-or-later
// The clock of the page: time of the runs or phase of a mode, playing, speed, loop, steps.
import type { Run } from "../data/run";

export const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
/** Seconds that one cycle of a mode takes on the screen at speed 1. */
const CYCLE = 2;

export class Player {
  time: number;
  playing = false;
  loop = true;
  speed = 1;
  mode: { run: number; index: number } | null = null;
  /** Of a mode, radians. */
  phase = 0;
  readonly begin: number;
  readonly end: number;
  private readonly listeners: (() => void)[] = [];

  constructor(private readonly runs: Run[]) {
    this.begin = Math.min(...runs.map((run) => run.times[0]!));
    this.end = Math.max(...runs.map((run) => run.times[run.times.length - 1]!));
    this.time = this.begin;
    const span = this.end - this.begin;
    if (span > 0 && (span < 1.5 || span > 30)) this.speed = nearest(span / 8);
  }

  get moves(): boolean {
    return this.mode !== null || this.end > this.begin;
  }
  /** Times of the first run that is shown, in whose rows steps go. */
  private get rows(): Float64Array {
    return (this.runs.find((run) => run.visible) ?? this.runs[0]!).times;
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }
  changed(): void {
    for (const listener of this.listeners) listener();
  }

  seek(time: number): void {
    if (!Number.isFinite(time)) return;
    this.time = Math.max(this.begin, Math.min(this.end, time));
    this.changed();
  }
  seekPhase(phase: number): void {
    this.phase = phase;
    this.changed();
  }
  toggle(): void {
    if (!this.playing && !this.mode && this.time >= this.end) this.time = this.begin;
    this.playing = !this.playing && this.moves;
    this.changed();
  }
  pause(): void {
    if (this.playing) this.toggle();
  }
  step(rows: number): void {
    this.playing = false;
    if (this.mode) return this.seekPhase(this.phase + (rows * Math.PI) / 12);
    const times = this.rows;
    let row = times.findLastIndex((t) => t <= this.time + 1e-12 * Math.abs(this.time));
    if (rows < 0 && row >= 0 && times[row]! < this.time - 1e-9 * Math.abs(this.time)) ++row;
    this.seek(times[Math.max(0, Math.min(times.length - 1, row + rows))]!);
  }
  faster(steps: number): void {
    const i = SPEEDS.indexOf(nearest(this.speed));
    this.speed = SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, i + steps))]!;
    this.changed();
  }
  choose(mode: { run: number; index: number } | null): void {
    this.mode = mode;
    this.phase = 0;
    this.playing = mode !== null;
    if (mode) this.speed = 1;
    this.changed();
  }

  /** Moves on by `seconds` of the wall clock. */
  advance(seconds: number): void {
    if (!this.playing) return;
    if (this.mode) return this.seekPhase((this.phase + (2 * Math.PI * seconds * this.speed) / CYCLE) % (2 * Math.PI));
    const span = this.end - this.begin, next = this.time + seconds * this.speed;
    if (next <= this.end) this.time = next;
    else if (this.loop) this.time = this.begin + ((next - this.begin) % span);
    else {
      this.time = this.end;
      this.playing = false;
    }
    this.changed();
  }
}

function nearest(speed: number): number {
  return SPEEDS.reduce((best, s) => (Math.abs(Math.log(s / speed)) < Math.abs(Math.log(best / speed)) ? s : best));
}
