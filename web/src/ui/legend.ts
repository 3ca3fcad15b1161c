// SPDX-License-Identifier: GPL-3.0-or-later
// The scale of colours, and the small axes that tell how the picture is turned.
import { h, svg } from "./dom";
import { number } from "./numbers";
import type { OrbitCamera } from "../view/camera";
import { mapGradient } from "../view/colours";
import type { MapName } from "../view/colours";

export class Legend {
  readonly element = h("figure", { class: "legend", hidden: true });
  title = "";
  range: [number, number] = [0, 1];
  /** The range as the scale writes it. */
  shown: [number, number] = [0, 1];

  /** Lines of text below the scale. */
  notes: string[] = [];
  /** `range` of the colours, and the factor that takes it to the unit. */
  show(title: string, unit: string, range: [number, number], factor: number, map: MapName, notes: string[]): void {
    this.title = unit ? `${title} [${unit}]` : title;
    this.range = range;
    this.shown = [factor * range[0], factor * range[1]];
    this.notes = notes;
    const bar = h("div", { class: "legend-bar" });
    bar.style.background = mapGradient(map);
    const ticks = [1, 0.75, 0.5, 0.25, 0].map((s) => h("span", {}, number(this.shown[0] + s * (this.shown[1] - this.shown[0]), 3)));
    this.element.replaceChildren(h("figcaption", {}, this.title), h("div", { class: "legend-scale" }, bar, h("div", { class: "legend-ticks" }, ...ticks)),
      ...notes.map((note) => h("div", { class: "remark" }, note)));
    this.element.hidden = false;
  }
  hide(): void {
    this.element.hidden = true;
  }
}

const AXES = [["x", "#c23b3b"], ["y", "#3c8d3c"], ["z", "#3b62c2"]] as const;

export class Triad {
  readonly element = svg("svg", { class: "triad", viewBox: "-34 -34 68 68", width: 68, height: 68, role: "img", "aria-label": "Directions of the world axes" });
  private readonly lines = AXES.map(([, colour]) => svg("line", { x1: 0, y1: 0, stroke: colour, "stroke-width": 2 }));
  private readonly texts = AXES.map(([name, colour]) => svg("text", { fill: colour, "text-anchor": "middle", "dominant-baseline": "central" }, name));

  constructor() {
    this.element.append(...this.lines, ...this.texts);
  }
  follow(camera: OrbitCamera): void {
    const { right, above } = camera.directions();
    for (let i = 0; i < 3; ++i) {
      const x = 22 * right[i]!, y = -22 * above[i]!;
      this.lines[i]!.setAttribute("x2", x.toFixed(1));
      this.lines[i]!.setAttribute("y2", y.toFixed(1));
      this.texts[i]!.setAttribute("x", (1.32 * x).toFixed(1));
      this.texts[i]!.setAttribute("y", (1.32 * y).toFixed(1));
    }
  }
}
