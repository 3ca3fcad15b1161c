// SPDX-License-Identifier: GPL-3.0-or-later
// The table of modes: a row chosen moves the picture in that mode.
import { button, h } from "./dom";
import { number } from "./numbers";
import type { Player } from "./player";
import type { ModeEntry } from "../data/header";
import type { Run } from "../data/run";

/** Damping ratios below are rounding of the eigenvalues. */
const ROUNDING = 1e-8;

/** Real eigenvalue of a mode that does not vibrate: -damping times 2 pi frequency; null: it vibrates. */
export function poleOf({ frequency, damping }: ModeEntry): number | null {
  return frequency !== null && damping !== null && frequency > 0 && Math.abs(damping) >= 1 - ROUNDING ? -damping * 2 * Math.PI * frequency : null;
}

export class Modes {
  readonly element = h("div", { class: "pad modes" });
  /** Largest displacement shown, as a share of the size of the picture. */
  share = 0.08;
  private readonly rows: { run: number; index: number; row: HTMLElement; choose: HTMLButtonElement }[] = [];

  constructor(runs: Run[], private readonly player: Player, changed: () => void) {
    const slider = h("input", { type: "range", min: 0.01, max: 0.4, step: 0.01, value: this.share, "aria-label": "Amplitude of the motion shown",
      oninput: () => {
        this.share = Number(slider.value);
        changed();
      } });
    this.element.append(h("div", { class: "row" },
      h("label", { class: "field grow" }, h("span", {}, "Amplitude"), slider),
      button("Leave the mode", "Show the state about which the model was linearised", () => player.choose(null))),
    h("p", { class: "remark" }, "The amplitude of a mode is arbitrary: the slider sets the largest displacement. One cycle takes two seconds at speed 1; damping is not shown."));
    for (const run of runs.filter((r) => r.entry.modes && r.entry.modes.length > 0)) this.element.append(this.table(run));
    player.onChange(() => this.follow());
  }

  /** Of buckling, shapes have a load factor in their name, and neither frequency nor damping. */
  private table(run: Run): HTMLElement {
    const modes = run.entry.modes!;
    const damping = (mode: ModeEntry): string => (mode.damping === null ? "-" : number(Math.abs(mode.damping) < ROUNDING ? 0 : 100 * mode.damping, 3));
    const columns: { title: string; text: (mode: ModeEntry, index: number) => string }[] = [{ title: "mode", text: (mode, index) => mode.name ?? String(index + 1) }];
    if (modes.some((mode) => mode.frequency !== null)) columns.push({ title: "frequency [Hz]", text: (mode) => number(mode.frequency, 5) });
    if (modes.some((mode) => mode.damping !== null)) columns.push({ title: "damping [%]", text: damping });
    if (modes.some((mode) => poleOf(mode) !== null)) columns.push({ title: `pole [1/${run.unit("time") || "time"}]`, text: (mode) => (poleOf(mode) === null ? "" : number(poleOf(mode), 4)) });
    const rows = modes.map((mode, index) => {
      const choose = button("Show", `Show the motion of mode ${index + 1}`, () => this.player.choose({ run: run.index, index }), { class: "link" });
      const row = h("tr", {}, ...columns.map(({ text }) => h("td", { class: "figure" }, text(mode, index))), h("td", {}, choose));
      this.rows.push({ run: run.index, index, row, choose });
      return row;
    });
    return h("table", {}, h("caption", {}, run.name), h("thead", {}, h("tr", {},
      ...[...columns.map(({ title }) => title), ""].map((title) => h("th", { scope: "col", class: title ? "figure" : "" }, title)))), h("tbody", {}, ...rows));
  }

  /** Factor on the stored shape that makes its largest displacement `share` of the size of the run. */
  amplitude(run: Run, index: number): number {
    const mode = run.entry.modes![index]!, size = this.sizes.get(mode) ?? largestMotion(run, mode);
    this.sizes.set(mode, size);
    return size > 0 ? (this.share * run.size) / size : 0;
  }
  private readonly sizes = new WeakMap<ModeEntry, number>();

  private follow(): void {
    for (const { run, index, row, choose } of this.rows) {
      const on = this.player.mode?.run === run && this.player.mode.index === index;
      row.classList.toggle("chosen", on);
      choose.setAttribute("aria-pressed", String(on));
    }
  }
}

/** Bound of the displacement of the stored shape: translation, rotation times reach, and the amplitudes of its body. */
function largestMotion(run: Run, mode: ModeEntry): number {
  let largest = 0;
  for (const moved of mode.bodies) {
    const body = run.bodies[moved.body];
    const shape = body && body.shape !== null ? run.shapes[body.shape]! : null;
    for (const part of [0, 1]) {
      const norm = (v: number[] | undefined): number => Math.hypot(...(v ?? [0]));
      let size = norm(moved.translation[part]) + norm(moved.rotation[part]) * reach(shape?.vertices);
      const a = moved.amplitudes?.[part];
      if (a && shape?.modes) size += a.reduce((sum, x, k) => sum + Math.abs(x) * largestOf(shape.modes!, k), 0);
      largest = Math.max(largest, size);
    }
  }
  return largest;
}

function reach(vertices: Float64Array | undefined): number {
  let largest = 0;
  for (let i = 0; vertices && i + 2 < vertices.length; i += 3) largest = Math.max(largest, Math.hypot(vertices[i]!, vertices[i + 1]!, vertices[i + 2]!));
  return largest;
}

const known = new WeakMap<object, number[]>();
function largestOf(modes: { rows: number; columns: number; at(r: number, c: number): number }, k: number): number {
  let list = known.get(modes);
  if (!list) known.set(modes, (list = []));
  if (list[k] === undefined) {
    let largest = 0;
    for (let c = 0; c + 2 < modes.columns; c += 3) largest = Math.max(largest, Math.hypot(modes.at(k, c), modes.at(k, c + 1), modes.at(k, c + 2)));
    list[k] = largest;
  }
  return list[k]!;
}
