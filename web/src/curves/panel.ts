// SPDX-License-Identifier: GPL-3.0-or-later
// One diagram: its channels over time (or differences, or spectra), with the cursor at the time of the animation.
import uPlot from "uplot";
import { valueAt } from "./fourier";
import { csvOf, tableOf } from "./table";
import type { Presentation, Table } from "./table";
import type { Run } from "../data/run";
import { button, download, fileName, h, select, styled } from "../ui/dom";
import { number } from "../ui/numbers";

export interface PanelHost {
  shown(): Run[];
  time(): number;
  seek(time: number): void;
  /** A panel was zoomed in time: the others follow. */
  zoomed(panel: Panel, range: [number, number] | null): void;
  activate(panel: Panel): void;
  remove(panel: Panel): void;
  changed(): void;
}

const HEIGHT = 210;

export class Panel {
  readonly element: HTMLElement;
  readonly paths: string[] = [];
  presentation: Presentation = "values";
  table: Table | null = null;
  range: [number, number] | null = null;
  private plot: uPlot | null = null;
  private readonly legend = h("ul", { class: "curve-legend" });
  private readonly canvas = h("div", { class: "curve-canvas" });
  private readonly remark = h("p", { class: "remark" });
  private readonly line = h("div", { class: "time-line" });
  private readonly readings: HTMLElement[] = [];
  private built = 0;

  constructor(private readonly host: PanelHost) {
    const how = select("What the panel shows", [["values", "Values"], ["difference", "Difference of runs"], ["spectrum", "Spectrum"]], "values",
      (value) => {
        this.presentation = value as Presentation;
        void this.rebuild();
      });
    this.element = h("section", { class: "panel", "aria-label": "Panel of curves", onpointerdown: () => host.activate(this), onfocusin: () => host.activate(this) },
      h("div", { class: "panel-head" }, how, h("span", { class: "grow" }),
        button("Whole range", "Show the whole range of time", () => host.zoomed(this, null)),
        button("CSV", "Save what this panel shows as CSV", () => this.save()),
        button("Close", "Close this panel", () => host.remove(this))),
      this.legend, this.canvas, this.remark);
  }

  get unit(): string | null {
    const run = this.host.shown().find((r) => r.entry.channels.some((c) => c.path === this.paths[0]));
    return run?.entry.channels.find((c) => c.path === this.paths[0])?.unit ?? null;
  }

  toggle(path: string): void {
    const i = this.paths.indexOf(path);
    if (i >= 0) this.paths.splice(i, 1);
    else this.paths.push(path);
    void this.rebuild();
  }

  save(): void {
    if (this.table) download(fileName(this.paths[0] ?? "curves", "csv"), new Blob([csvOf(this.table)], { type: "text/csv" }));
  }

  async rebuild(): Promise<void> {
    const turn = ++this.built;
    const table = await tableOf(this.host.shown(), this.paths, this.presentation, this.range);
    if (turn !== this.built) return;
    this.table = table;
    this.plot?.destroy();
    this.plot = null;
    this.remark.textContent = this.paths.length === 0 ? "Choose channels in the list above." : table.remark;
    this.drawLegend(table);
    if (table.columns.length > 0) this.plot = new uPlot(this.options(table), table.data as uPlot.AlignedData, this.canvas);
    this.host.changed();
    this.follow();
  }

  private drawLegend(table: Table): void {
    this.readings.length = 0;
    this.legend.replaceChildren(...table.columns.map((column) => {
      const reading = h("output", { class: "reading" });
      this.readings.push(reading);
      const mark = h("span", { class: `mark rank${Math.max(-1, Math.min(2, column.rank))}` });
      mark.style.color = column.colour;
      const path = this.paths.find((p) => column.label === p || column.label.startsWith(`${p} [`));
      const off = path && column.rank <= 0 ? button("×", `Remove ${path}`, () => this.toggle(path), { class: "small" }) : null;
      return h("li", {}, mark, h("span", { class: "name", title: column.label }, column.label), reading, h("span", { class: "unit" }, column.unit), off);
    }));
  }

  private options(table: Table): uPlot.Options {
    const ink = styled("--ink-2"), rule = styled("--rule"), font = "11px system-ui, sans-serif";
    const isSpectrum = this.presentation === "spectrum";
    const axis = { stroke: ink, font, grid: { stroke: rule, width: 1 }, ticks: { stroke: rule, width: 1, size: 4 } };
    const units = [...new Set(table.columns.map((column) => column.unit).filter(Boolean))].join(", ");
    const { label, unit } = table.abscissa;
    return {
      width: Math.max(220, this.canvas.clientWidth),
      height: HEIGHT,
      pxAlign: 0,
      legend: { show: false },
      cursor: { drag: { x: true, y: false, dist: 6 }, points: { size: 5 }, bind: { dblclick: () => () => (this.host.zoomed(this, null), null) } },
      scales: {
        x: { time: false, ...(this.range && !isSpectrum ? { range: () => this.range! } : {}) },
        y: isSpectrum ? { distr: 3, range: (_u, low, high) => [Math.max(low > 0 ? low : 1e-30, high * 1e-7), high > 0 ? high * 2 : 1] } : {},
      },
      axes: [
        { ...axis, label: unit ? `${label} [${unit}]` : label, labelFont: font, labelSize: 16, size: 30, values: (_u, ticks) => ticks.map((t) => number(t, 6)) },
        { ...axis, ...(isSpectrum ? { splits: (_u: uPlot, _axis: number, low: number, high: number) => decades(low, high) } : {}), label: units ? `[${units}]` : "", labelFont: font, labelSize: 16, size: 56,
          values: (_u, ticks) => ticks.map((t) => (t === null ? "" : number(t, 5))) },
      ],
      series: [{}, ...table.columns.map((column): uPlot.Series => ({
        label: column.label,
        stroke: column.colour,
        width: column.rank > 0 ? 1.25 : 1.5,
        spanGaps: true,
        ...(column.rank > 0 ? { dash: [[6, 3], [2, 3], [8, 3, 2, 3]][(column.rank - 1) % 3]! } : {}),
        ...(column.rank < 0 ? { paths: () => null } : {}),
        points: column.rank < 0 ? { show: true, size: 5, stroke: column.colour, fill: styled("--paper") } : { show: column.x.length === 1, size: 6, stroke: column.colour, fill: column.colour },
      }))],
      hooks: {
        draw: [(u) => this.placeTime(u)],
        setSelect: [(u) => this.zoom(u)],
        ready: [(u) => {
          u.over.append(this.line);
          u.over.addEventListener("click", (event) => this.clicked(u, event));
        }],
      },
    };
  }

  private zoom(u: uPlot): void {
    if (u.select.width < 4) return;
    const range: [number, number] = [u.posToVal(u.select.left, "x"), u.posToVal(u.select.left + u.select.width, "x")];
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    if (this.presentation !== "spectrum") this.host.zoomed(this, range);
  }

  private clicked(u: uPlot, event: MouseEvent): void {
    if (this.presentation === "spectrum" || u.select.width > 4) return;
    this.host.seek(u.posToVal(event.offsetX, "x"));
  }

  /** The line of the time lies over the diagram: moving it draws nothing anew. */
  private placeTime(u: uPlot): void {
    const x = u.valToPos(this.host.time(), "x"), width = u.over.clientWidth;
    this.line.hidden = this.presentation === "spectrum" || !(x >= 0 && x <= width);
    this.line.style.transform = `translateX(${(x - 0.75).toFixed(2)}px)`;
  }

  /** Cursor and readings at the time of the animation. */
  follow(): void {
    if (!this.plot || !this.table) return;
    this.placeTime(this.plot);
    const t = this.host.time();
    for (const [i, column] of this.table.columns.entries())
      this.readings[i]!.textContent = this.presentation === "spectrum" ? "" : number(valueAt(column.x, column.y, t));
  }

  resize(): void {
    const width = Math.max(220, this.canvas.clientWidth);
    if (this.plot && Math.abs(this.plot.width - width) > 1) this.plot.setSize({ width, height: HEIGHT });
  }
}

/** The powers of ten between low and high. */
function decades(low: number, high: number): number[] {
  const first = Math.ceil(Math.log10(low)), last = Math.floor(Math.log10(high));
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => 10 ** (first + i));
}
