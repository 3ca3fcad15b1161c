// SPDX-License-Identifier: GPL-3.0-or-later
// The side of curves: the tree of channels, and panels below it.
import { Panel } from "./panel";
import type { PanelHost } from "./panel";
import { ChannelTree } from "./tree";
import type { Leaf } from "./tree";
import type { Run } from "../data/run";
import { button, h } from "../ui/dom";
import type { Player } from "../ui/player";

export class Curves implements PanelHost {
  readonly element: HTMLElement;
  readonly panels: Panel[] = [];
  readonly tree: ChannelTree;
  private readonly list = h("div", { class: "panels" });
  private active: Panel;

  constructor(private readonly runs: Run[], private readonly player: Player) {
    this.tree = new ChannelTree(runs, (path) => this.panels.some((panel) => panel.paths.includes(path)), (leaf) => this.toggle(leaf));
    this.element = h("div", { class: "curves" }, this.tree.element,
      h("div", { class: "row" }, h("span", { class: "remark grow" }, "Drag: zoom. Click: go to that time. Double click: whole range."),
        button("New panel", "Add an empty panel of curves", () => this.addPanel())),
      this.list);
    this.active = this.addPanel();
    new ResizeObserver(() => this.panels.forEach((panel) => panel.resize())).observe(this.list);
    const first = initialChannels(runs);
    for (const path of first) this.show(path);
  }

  addPanel(): Panel {
    const panel = new Panel(this);
    this.panels.push(panel);
    this.list.append(panel.element);
    this.activate(panel);
    void panel.rebuild();
    return panel;
  }

  private toggle(leaf: Leaf): void {
    const holder = this.panels.find((panel) => panel.paths.includes(leaf.path));
    if (holder) holder.toggle(leaf.path);
    else this.show(leaf.path);
  }

  /** Shows a channel in the active panel; in one of its unit, or a new one, if the units differ. */
  show(path: string): void {
    if (this.panels.some((panel) => panel.paths.includes(path))) return;
    const unit = this.tree.leaves.find((leaf) => leaf.path === path)?.unit ?? "";
    const fits = (panel: Panel): boolean => panel.paths.length === 0 || panel.unit === unit;
    const panel = fits(this.active) ? this.active : this.panels.find(fits) ?? this.addPanel();
    panel.toggle(path);
  }

  // What panels ask of their host.
  shown(): Run[] {
    return this.runs.filter((run) => run.visible);
  }
  time(): number {
    return this.player.time;
  }
  seek(time: number): void {
    this.player.pause();
    this.player.seek(time);
  }
  zoomed(_panel: Panel, range: [number, number] | null): void {
    for (const panel of this.panels) {
      panel.range = range;
      void panel.rebuild();
    }
  }
  activate(panel: Panel): void {
    this.active = panel;
    for (const other of this.panels) other.element.classList.toggle("active", other === panel && this.panels.length > 1);
  }
  remove(panel: Panel): void {
    if (this.panels.length === 1) {
      panel.paths.length = 0;
      void panel.rebuild();
      return;
    }
    this.panels.splice(this.panels.indexOf(panel), 1);
    panel.element.remove();
    this.activate(this.panels[0]!);
    this.changed();
  }
  changed(): void {
    this.tree.refresh();
  }

  follow(): void {
    if (this.element.offsetParent !== null) for (const panel of this.panels) panel.follow();
  }
  rebuild(): void {
    for (const panel of this.panels) void panel.rebuild();
  }
}

/** Share of the largest range of the same node below which a component is not shown at first. */
const STILL = 0.05;

/** What is shown at first: channels with a reference, else those of the user, else how the node that travels farthest moves. */
function initialChannels(runs: Run[]): string[] {
  const channels = runs[0]!.entry.channels, known = new Set(channels.map((channel) => channel.path));
  const referred = runs.flatMap((run) => run.entry.references.map((reference) => reference.channel)).filter((path) => known.has(path));
  if (referred.length > 0) return [...new Set(referred)].slice(0, 3);
  const own = channels.filter((channel) => channel.group === "channels");
  if (own.length > 0) return own.filter((channel) => channel.unit === own[0]!.unit).slice(0, 3).map((channel) => channel.path);
  const far = `nodes/position/${farthestNode(runs[0]!)}/`;
  const first = channels.find((channel) => channel.path.startsWith(far)) ?? channels.find((channel) => channel.path.startsWith("nodes/position")) ?? channels[0];
  if (!first) return [];
  const stem = first.path.slice(0, first.path.lastIndexOf("/") + 1);
  const same = channels.filter((channel) => channel.path.startsWith(stem) && channel.unit === first.unit).slice(0, 3).map((channel) => channel.path);
  if (!first.path.startsWith(far)) return same;
  const ranges = rangesOf(runs[0]!, farthestNode(runs[0]!)), largest = Math.max(...ranges);
  return same.filter((path) => !(ranges["xyz".indexOf(path.slice(stem.length))]! < STILL * largest));
}

/** Name of the node whose track has the largest extent, over a sample of instants. */
function farthestNode(run: Run): string {
  const instants = Array.from({ length: 24 }, (_, i) => run.times[Math.floor((i * (run.times.length - 1)) / 23)]!);
  let name = "", largest = -1;
  for (const node of run.nodes.slice(0, 3000)) {
    const extent = Math.hypot(...rangesOf(run, node.name, instants));
    if (extent > largest) largest = extent, name = node.name;
  }
  return name;
}

/** Ranges of x, y, z of a node over instants. */
function rangesOf(run: Run, name: string, instants = Array.from(run.times)): number[] {
  const node = run.nodes.find((one) => one.name === name);
  if (!node) return [0, 0, 0];
  const track = instants.map((t) => run.placeAt(node.place, t).position);
  return [0, 1, 2].map((c) => track.reduce((most, p) => Math.max(most, p[c]!), -Infinity) - track.reduce((least, p) => Math.min(least, p[c]!), Infinity));
}
