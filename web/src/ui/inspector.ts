// SPDX-License-Identifier: GPL-3.0-or-later
// What was chosen in the picture: a body or a node, its place now, and the channels of its name.
import { button, h } from "./dom";
import { number, steady } from "./numbers";
import type { Run } from "../data/run";
import type { Picked } from "../view/viewport";

export interface InspectorActions {
  trace(picked: Picked): void;
  traced(picked: Picked): boolean;
  centre(picked: Picked): void;
  close(): void;
  curve(path: string): void;
}

const MOST_CHANNELS = 12;

export class Inspector {
  readonly element = h("aside", { class: "inspector", "aria-label": "Chosen body or node", hidden: true });
  picked: Picked | null = null;
  private updates: (() => void)[] = [];

  constructor(private readonly actions: InspectorActions) {}

  get name(): string {
    if (!this.picked) return "";
    const { run, body, node } = this.picked;
    return node === null ? run.bodies[body]!.name : run.nodes[node]!.name;
  }

  choose(picked: Picked | null): void {
    this.picked = picked;
    this.element.hidden = picked === null;
    this.updates = [];
    if (!picked) return;
    const { run, body, node } = picked, entry = run.bodies[body]!;
    const rows = h("dl", {});
    const row = (name: string, unit: string, value: () => string): void => {
      const output = h("output", {});
      rows.append(h("dt", {}, name), h("dd", {}, output, unit ? h("span", { class: "unit" }, ` ${unit}`) : null));
      this.updates.push(() => (output.textContent = value()));
    };
    const place = (): number[] => (node === null ? run.placeAt(bodyPlace(body), run.time) : run.placeAt(run.nodes[node]!.place, run.time)).position;
    row("position", run.unit("length"), () => place().map((x) => steady(x, 1e-5 * run.size)).join("  "));
    if (node === null) row("quaternion", "", () => run.pose(body).rotation.map((x) => x.toFixed(4)).join("  "));
    else row("of body", "", () => entry.name);
    if (node === null && entry.mass !== null) row("mass", run.unit("mass"), () => number(entry.mass));
    if (node === null && entry.amplitudes) row("deformation", "", () => `${entry.amplitudes!.columns} amplitudes`);
    const channels = this.channelsOf(run);
    for (const { index, path, unit, text } of channels) {
      row(text, unit, () => {
        const values = run.channelNow(index), { row: r, share } = run.locate(run.time);
        if (!values) return "...";
        const a = values[r]!, b = values[Math.min(r + 1, values.length - 1)]!;
        return number(share === 0 ? a : a + share * (b - a));
      });
      rows.lastElementChild!.append(button("+", `Show ${path} as a curve`, () => this.actions.curve(path), { class: "small" }));
      void run.channel(index).then(() => this.follow());
    }
    const trace = button("Trace", "Draw the path of this node", () => {
      this.actions.trace(picked);
      trace.setAttribute("aria-pressed", String(this.actions.traced(picked)));
    }, { "aria-pressed": String(this.actions.traced(picked)) });
    const kind = node === null ? `${entry.kind} body` : "node";
    this.element.replaceChildren(
      h("header", {}, h("strong", {}, this.name), h("span", { class: "remark" }, ` ${kind}${run.entry.name ? ` of ${run.entry.name}` : ""}`)), rows,
      h("div", { class: "row" }, node === null ? null : trace, button("Centre", "Rotate the picture about this point", () => this.actions.centre(picked)),
        h("span", { class: "grow" }), button("Close", "Clear the selection (Esc)", () => this.actions.close())));
    this.follow();
  }

  private channelsOf(run: Run): { index: number; path: string; unit: string; text: string }[] {
    const names = [this.name, ...(this.picked!.node === null ? [] : run.nodes[this.picked!.node]!.also ?? [])];
    return run.entry.channels.flatMap((channel, index) => {
      const name = names.find((n) => `/${channel.path}/`.includes(`/${n}/`));
      const text = name ? `/${channel.path}/`.replace(`/${name}/`, " / ").replace(/^[\s/]+|[\s/]+$/g, "") : "";
      return name ? [{ index, path: channel.path, unit: channel.unit, text }] : [];
    }).slice(0, MOST_CHANNELS);
  }

  follow(): void {
    for (const update of this.updates) update();
  }
}

/** The origin of a body as a place. */
export function bodyPlace(body: number): { entry: { body: number }; position: null; rotation: null; body: number } {
  return { entry: { body }, position: null, rotation: null, body };
}
