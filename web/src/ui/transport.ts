// SPDX-License-Identifier: GPL-3.0-or-later
// The bar of time: play, steps, slider, speed, loop; in a mode, its phase.
import { button, checkbox, h, select } from "./dom";
import { number, steady, withUnit } from "./numbers";
import { SPEEDS } from "./player";
import type { Player } from "./player";
import type { Run } from "../data/run";

const STEPS = 10000;

export class Transport {
  readonly element: HTMLElement;
  readonly play: HTMLButtonElement;
  readonly slider: HTMLInputElement;
  private readonly label = h("output", { class: "time", "aria-live": "off" });
  private readonly speed: HTMLSelectElement;
  private readonly loop: HTMLInputElement;

  constructor(private readonly player: Player, private readonly runs: Run[]) {
    this.play = button("Play", "Play or pause (Space)", () => player.toggle(), { class: "primary" });
    this.slider = h("input", { type: "range", min: 0, max: STEPS, step: 1, value: 0, class: "grow", "aria-label": "Time", oninput: () => this.slide() });
    this.speed = select("Speed", SPEEDS.map((s): [string, string] => [String(s), `× ${s}`]), String(player.speed), (value) => {
      player.speed = Number(value);
      player.changed();
    });
    const loop = checkbox("Loop", player.loop, (on) => {
      player.loop = on;
      player.changed();
    }, "Start again at the end (L)");
    this.loop = loop.querySelector("input")!;
    this.element = h("footer", { class: "transport", role: "toolbar", "aria-label": "Time" },
      this.play,
      button("|◂", "Go to the start (Home)", () => player.seek(player.begin)),
      button("◂", "Previous stored instant (Left)", () => player.step(-1)),
      button("▸", "Next stored instant (Right)", () => player.step(1)),
      button("▸|", "Go to the end (End)", () => player.seek(player.end)),
      this.slider, this.label, this.speed, loop);
    player.onChange(() => this.follow());
    this.follow();
  }

  private slide(): void {
    const share = Number(this.slider.value) / STEPS;
    this.player.playing = false;
    if (this.player.mode) this.player.seekPhase(2 * Math.PI * share);
    else this.player.seek(this.player.begin + share * (this.player.end - this.player.begin));
  }

  /** Time as text, with its unit. */
  get text(): string {
    const { player } = this, run = this.runs[player.mode?.run ?? 0]!;
    if (player.mode) {
      const mode = run.entry.modes![player.mode.index]!;
      const name = mode.frequency === null ? (mode.name ?? `mode ${player.mode.index + 1}`) : `mode ${player.mode.index + 1}, ${number(mode.frequency)} Hz`;
      return `${name}, phase ${((player.phase * 180) / Math.PI).toFixed(0)}°`;
    }
    const span = player.end - player.begin;
    return withUnit(steady(player.time, span > 0 ? span / 2000 : 1e-3), run.unit("time"));
  }

  follow(): void {
    const { player } = this, span = player.end - player.begin;
    const share = player.mode ? player.phase / (2 * Math.PI) : span > 0 ? (player.time - player.begin) / span : 0;
    const value = String(Math.round(STEPS * (share - Math.floor(share === 1 ? 0 : share))));
    if (this.slider.value !== value) this.slider.value = value;
    const text = this.text;
    if (this.label.textContent !== text) this.label.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
    const word = player.playing ? "Pause" : "Play";
    if (this.play.textContent !== word) this.play.textContent = word;
    this.play.disabled = !player.moves;
    this.slider.disabled = !player.moves;
    const speed = String(SPEEDS.reduce((best, s) => (Math.abs(s - player.speed) < Math.abs(best - player.speed) ? s : best)));
    if (this.speed.value !== speed) this.speed.value = speed;
    this.loop.checked = player.loop;
  }
}
