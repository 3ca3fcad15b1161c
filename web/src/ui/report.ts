// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a run: doubts and notes first, what was simulated, effects, energy and steps over time, time of the phases.
import uPlot from "uplot";
import { h, select, styled } from "./dom";
import { number } from "./numbers";
import type { Run } from "../data/run";
import { LINE_COLOURS, lineColour } from "../view/colours";

export class Report {
  readonly element = h("div", { class: "pad report" });
  private plots: uPlot[] = [];
  private index = 0;

  constructor(private readonly runs: Run[]) {}

  draw(): void {
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    const run = this.runs[this.index]!, { entry } = run, report = entry.report;
    const choice = this.runs.length > 1
      ? select("Run of the report", this.runs.map((r, i): [string, string] => [String(i), r.name]), String(this.index), (value) => {
        this.index = Number(value);
        this.draw();
      })
      : null;
    this.element.replaceChildren(...[
      choice, h("h2", {}, entry.name), entry.file ? h("p", { class: "remark path" }, entry.file) : null,
      entry.completed === false ? list("warning", "Interrupted", [entry.reason || "The run did not reach its end."]) : null,
      list("warning", "Warnings", report.doubts ?? []), list("note", "Notes", report.notes ?? []),
      entry.thinned ? h("p", { class: "note" }, `The page shows ${entry.thinned.kept} of ${entry.thinned.rows} stored instants.`) : null,
      table(entry.kind === "part" ? "Data of the mesh" : "Data of the run", report.lines ?? []), table("Effects", report.effects ?? []),
      this.plot(run, "Energy", Object.entries(report.energy ?? {}), run.unit("energy"), false),
      report.steps === null || report.steps === undefined ? null : this.plot(run, "Step size", [["step", report.steps]], run.unit("time"), true),
      phases(report.phases ?? []),
      entry.scene ? h("details", {}, h("summary", {}, "Scene"), h("pre", { class: "scene", tabindex: 0 }, entry.scene)) : null,
    ].filter((element) => element !== null));
  }

  private plot(run: Run, title: string, channels: [string, number][], unit: string, logarithmic: boolean): HTMLElement | null {
    if (channels.length === 0 || run.times.length < 2) return null;
    const canvas = h("div", { class: "curve-canvas" }), section = h("section", {}, h("h3", {}, title), canvas,
      h("ul", { class: "curve-legend" }, ...channels.map(([name], i) => {
        const mark = h("span", { class: "mark rank0" });
        mark.style.color = lineColour(i % LINE_COLOURS.length);
        return h("li", {}, mark, h("span", { class: "name" }, name));
      })));
    void Promise.all(channels.map(([, index]) => run.channel(index))).then((values) => {
      const axis = { stroke: styled("--ink-2"), font: "11px system-ui, sans-serif", grid: { stroke: styled("--rule"), width: 1 }, ticks: { show: false } };
      const finite = values.map((v) => Array.from(v, (y) => (Number.isFinite(y) && (!logarithmic || y > 0) ? y : null)));
      this.plots.push(new uPlot({
        width: Math.max(220, canvas.clientWidth), height: 180, pxAlign: 0, legend: { show: false }, cursor: { show: false },
        scales: { x: { time: false }, y: logarithmic ? { distr: 3 } : {} },
        axes: [{ ...axis, label: `time [${run.unit("time")}]`, labelSize: 16, labelFont: axis.font, size: 28 },
          { ...axis, label: unit ? `[${unit}]` : "", labelSize: 16, labelFont: axis.font, size: 58, values: (_u, ticks) => ticks.map((t) => (t === null ? "" : number(t, 4))) }],
        series: [{}, ...channels.map((_, i): uPlot.Series => ({ stroke: lineColour(i % LINE_COLOURS.length), width: 1.5, points: { show: false } }))],
      }, [Array.from(run.times), ...finite] as uPlot.AlignedData, canvas));
    }).catch((error: unknown) => canvas.append(h("p", { class: "warning" }, String((error as Error).message))));
    return section;
  }

  resize(): void {
    for (const plot of this.plots) {
      const width = Math.max(220, plot.root.parentElement?.clientWidth ?? 0);
      if (Math.abs(plot.width - width) > 1) plot.setSize({ width, height: 180 });
    }
  }
}

function list(kind: "warning" | "note", title: string, texts: string[]): HTMLElement | null {
  if (texts.length === 0) return null;
  return h("section", { class: kind }, h("h3", {}, title), h("ul", {}, ...texts.map((text) => h("li", {}, text))));
}

function table(title: string, rows: [string, string][]): HTMLElement | null {
  if (rows.length === 0) return null;
  return h("section", {}, h("h3", {}, title), h("table", {}, h("tbody", {}, ...rows.map(([name, value]) => h("tr", {}, h("th", { scope: "row" }, name), h("td", {}, value))))));
}

function phases(rows: [string, number][]): HTMLElement | null {
  if (rows.length === 0) return null;
  const longest = Math.max(...rows.map(([, seconds]) => seconds), 1e-12);
  return h("section", {}, h("h3", {}, "Computing time by phase"), h("table", {}, h("tbody", {}, ...rows.map(([name, seconds]) => {
    const bar = h("div", { class: "phase" });
    bar.style.width = `${(100 * seconds) / longest}%`;
    return h("tr", {}, h("th", { scope: "row" }, name), h("td", { class: "figure" }, `${number(seconds, 3)} s`), h("td", { class: "wide" }, bar));
  }))));
}
