// SPDX-License-Identifier: GPL-3.0-or-later
// What a panel of curves shows, as columns over one abscissa: values, differences of runs, or spectra.
import uPlot from "uplot";
import { LINE_COLOURS, lineColour } from "../view/colours";
import type { Run } from "../data/run";
import { spectrumOf, valueAt } from "./fourier";

export type Presentation = "values" | "difference" | "spectrum";

export interface Column {
  label: string;
  unit: string;
  colour: string;
  /** 0: first run, solid; others dashed; -1: a reference, points. */
  rank: number;
  x: Float64Array;
  y: Float64Array;
}

export interface Table {
  columns: Column[];
  /** Joined: abscissa, then a column each; null where a column has no row. */
  data: (number | null | undefined)[][];
  abscissa: { label: string; unit: string };
  remark: string;
}

export interface Curve {
  run: Run;
  path: string;
  unit: string;
  values: Float64Array;
  times: Float64Array;
}

export async function curvesOf(runs: Run[], paths: string[]): Promise<Curve[]> {
  const curves: Curve[] = [];
  for (const path of paths)
    for (const run of runs) {
      const index = run.entry.channels.findIndex((channel) => channel.path === path);
      if (index < 0) continue;
      const entry = run.entry.channels[index]!;
      const times = entry.times ? await run.array(entry.times, `times of '${path}'`) : run.times;
      curves.push({ run, path, unit: entry.unit, values: await run.channel(index), times });
    }
  return curves;
}

async function references(runs: Run[], paths: string[], unit: string): Promise<Column[]> {
  const columns: Column[] = [];
  for (const run of runs)
    for (const reference of run.entry.references)
      if (paths.includes(reference.channel))
        columns.push({
          label: reference.name, unit, colour: lineColour(6), rank: -1,
          x: await run.array(reference.x, `reference '${reference.name}'`), y: await run.array(reference.y, `reference '${reference.name}'`),
        });
  return columns;
}

const colourOf = (paths: string[], path: string): string => lineColour(paths.indexOf(path) % (LINE_COLOURS.length - 1));
const named = (curve: Curve, many: boolean): string => (many ? `${curve.path} [${curve.run.name}]` : curve.path);

function differences(curves: Curve[], paths: string[]): Column[] {
  return curves.flatMap((curve) => {
    const base = curves.find((other) => other.path === curve.path)!;
    if (base === curve) return [];
    const y = base.times.map((t, i) => valueAt(curve.times, curve.values, t) - base.values[i]!);
    const label = `${curve.path} [${curve.run.name} - ${base.run.name}]`;
    return [{ label, unit: curve.unit, colour: colourOf(paths, curve.path), rank: curve.run.index, x: base.times, y }];
  });
}

function spectra(curves: Curve[], paths: string[], range: [number, number] | null, many: boolean): { columns: Column[]; remark: string } {
  let remark = "No spectrum: it needs at least eight rows without a gap.";
  const columns = curves.flatMap((curve) => {
    const begin = Math.max(curve.times[0]!, range?.[0] ?? -Infinity), end = Math.min(curve.times[curve.times.length - 1]!, range?.[1] ?? Infinity);
    const found = spectrumOf(curve.times, curve.values, begin, end);
    if (!found) return [];
    const unit = curve.run.unit("time");
    remark = `Hann window, mean removed, ${found.samples} samples every ${found.interval.toPrecision(3)} ${unit} from ${begin.toPrecision(4)} to ${end.toPrecision(4)} ${unit}`
      + " (interpolated linearly); the ordinate is the amplitude of a sine";
    return [{ label: named(curve, many), unit: curve.unit, colour: colourOf(paths, curve.path), rank: curve.run.index, x: found.frequency, y: found.amplitude }];
  });
  return { columns, remark };
}

export async function tableOf(runs: Run[], paths: string[], how: Presentation, range: [number, number] | null): Promise<Table> {
  const curves = await curvesOf(runs, paths), many = runs.length > 1;
  const time = runs[0]?.unit("time") ?? "";
  let columns: Column[] = [], remark = "";
  if (how === "spectrum") ({ columns, remark } = spectra(curves, paths, range, many));
  else if (how === "difference") {
    columns = differences(curves, paths);
    remark = columns.length > 0 ? "Difference from the first run shown, at its instants." : "A difference needs two runs with this channel.";
  } else {
    columns = curves.map((curve) => ({
      label: named(curve, many), unit: curve.unit, colour: colourOf(paths, curve.path), rank: runs.indexOf(curve.run), x: curve.times, y: curve.values,
    }));
    columns.push(...(await references(runs, paths, columns[0]?.unit ?? "")));
  }
  const finite = (values: Float64Array): (number | null)[] => Array.from(values, (y) => (Number.isFinite(y) ? y : null));
  const joined = columns.length > 0
    ? uPlot.join(columns.map((column) => [Array.from(column.x), finite(column.y)] as uPlot.AlignedData))
    : ([[]] as unknown as uPlot.AlignedData);
  const abscissa = how === "spectrum" ? { label: "frequency", unit: time ? (time === "s" ? "Hz" : `1/${time}`) : "" } : { label: "time", unit: time };
  return { columns, data: joined as unknown as Table["data"], abscissa, remark };
}

/** RFC 4180; a name that a spreadsheet would take for a formula is led by an apostrophe. */
export function csvOf(table: Table): string {
  const cell = (text: string): string => {
    const safe = /^[=+\-@\t]/.test(text) ? `'${text}` : text;
    return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
  };
  const heading = (label: string, unit: string): string => cell(unit ? `${label} [${unit}]` : label);
  const lines = [[heading(table.abscissa.label, table.abscissa.unit), ...table.columns.map((column) => heading(column.label, column.unit))].join(",")];
  const rows = table.data[0]?.length ?? 0;
  for (let i = 0; i < rows; ++i) lines.push(table.data.map((column) => (column[i] === null || column[i] === undefined ? "" : String(column[i]))).join(","));
  return lines.join("\r\n") + "\r\n";
}
