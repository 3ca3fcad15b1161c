// SPDX-License-Identifier: GPL-3.0-or-later
// One picture of one or more states, side by side, with nothing of the page about it: what `mechanism picture` writes.
import type { App } from "../app";
import type { Vec } from "../data/rotation";
import type { Standard } from "../view/camera";
import type { Settings } from "../view/settings";
import { compose } from "./capture";
import { number } from "./numbers";

export interface Still {
  /** Pixels of the whole picture. */
  width: number;
  height: number;
  /** One state each, from left to right. */
  times: number[];
  /** In place of times: index of a mode of the first run that has some, and its phases [rad], one state each. */
  mode?: number;
  phases?: number[];
  /** A name, or azimuth about the vertical and elevation over the ground of where the camera stands [rad]. */
  view: Standard | [number, number];
  /** 1: what is shown fills the picture. */
  zoom: number;
  /** Names of nodes whose paths are drawn. */
  traces?: string[];
  /** Body that the camera follows through the states, "": none; absent: the page chooses. */
  follow?: string;
  /** Title and times are written on the picture. */
  captions: boolean;
  settings: Partial<Settings>;
}

/** Moves the page to each state in turn; `shown` is called when it is there. */
function throughStates(app: App, request: Still, shown: (caption: string) => void): void {
  const { player } = app;
  player.playing = false;
  if (request.mode === undefined)
    for (const time of request.times) {
      player.seek(time);
      app.render(true);
      shown(`t = ${number(time, 4)} ${app.runs[0]!.unit("time")}`.trim() + (app.settings.exaggeration === 1 || !app.deforms ? "" : `, deformation × ${number(app.settings.exaggeration)}`));
    }
  else
    for (const phase of request.phases ?? [0]) {
      player.seekPhase(phase);
      app.render(true);
      const mode = app.runs[player.mode!.run]!.entry.modes![request.mode]!;
      shown(`mode ${mode.name ?? request.mode + 1}${mode.frequency === null ? "" : `: ${number(mode.frequency, 4)} Hz`}`);
    }
}

/** The PNG in base64; of a state in which nothing is to be seen "". Throws where the browser cannot draw, or where the run has no such mode or node. */
export async function still(app: App, request: Still): Promise<string> {
  const { viewport, player } = app;
  if (!viewport) throw new Error("this browser cannot draw the 3-D picture");
  const states = request.mode === undefined ? request.times.length : (request.phases ?? [0]).length;
  viewport.fixed = { width: Math.round(request.width / states), height: request.height };
  Object.assign(app.settings, request.settings);
  if (request.mode !== undefined) player.choose({ run: app.runs.findIndex((run) => run.entry.modes && run.entry.modes.length > request.mode!), index: request.mode });
  else player.choose(null);
  for (const name of request.traces ?? [])
    for (const view of viewport.views) {
      const node = view.run.nodes.findIndex((n) => n.name === name || (n.also ?? []).includes(name));
      if (node >= 0) view.traced.add(node);
      view.retrace();
    }
  if (request.follow !== undefined) viewport.follow(request.follow);
  await app.readArrows();
  app.recolour();
  viewport.quality = 2;
  const low: Vec = [Infinity, Infinity, Infinity], high: Vec = [-Infinity, -Infinity, -Infinity];
  throughStates(app, request, () => viewport.extend(low, high));
  viewport.camera.standard(request.view);
  if (low.every(Number.isFinite)) viewport.camera.fit({ centre: low.map((x, i) => (x + high[i]!) / 2) as Vec, half: low.map((x, i) => (high[i]! - x) / 2) as Vec });
  viewport.camera.zoom(1 / request.zoom);
  const canvas = document.createElement("canvas"), { title, legend } = app.caption();
  canvas.width = request.width;
  canvas.height = request.height;
  const context = canvas.getContext("2d")!, width = request.width / states;
  let drawn = 0, empty = false;
  throughStates(app, request, (time) => {
    empty ||= viewport.isEmpty;
    const text = request.captions ? { title: states === 1 ? title : "", time } : { title: "", time: "" };
    compose(context, viewport.canvas, { ...text, legend: drawn === 0 ? legend : null }, width * drawn++, width);
  });
  return empty ? "" : canvas.toDataURL("image/png").split(",")[1]!;
}
