// SPDX-License-Identifier: GPL-3.0-or-later
// window.tisserand: what the page tells of itself to tests and to the curious (web/README.md lists it).
import type { App } from "./app";
import { csvOf } from "./curves/table";
import type { Vec } from "./data/rotation";
import { still } from "./ui/still";
import type { Still } from "./ui/still";

export interface SelfTest {
  ready: boolean;
  failure: string | null;
  [key: string]: unknown;
}

export function selfTestOf(app: App, openedAfter: number): SelfTest {
  const nodeOf = (run: number, name: string) => {
    const node = app.runs[run]?.nodes.find((n) => n.name === name || (n.also ?? []).includes(name));
    if (!node) throw new Error(`run ${run} has no node '${name}'`);
    return node;
  };
  return {
    ready: true,
    failure: null,
    openedAfter,
    get pictures() { return app.viewport?.pictures ?? 0; },
    get bodies() { return app.runs.map((run) => run.bodies.length); },
    get vertices() { return app.viewport?.vertices ?? 0; },
    get webglErrors() { return app.viewport ? [app.viewport.error].filter((code) => code !== 0).length + (app.viewport.fault ? 1 : 0) : -1; },
    get shaderFault() { return app.viewport?.fault ?? ""; },
    get contextLost() { return app.viewport?.contextLost ?? true; },
    get software() { return app.viewport?.software ?? true; },
    get framesPerSecond() { return app.framesPerSecond; },
    get quality() { return app.viewport?.quality ?? 0; },
    get time() { return app.player.time; },
    get state() {
      return {
        playing: app.player.playing, loop: app.player.loop, speed: app.player.speed, mode: app.player.mode, phase: app.player.phase,
        tab: app.tabs.current, chosen: app.inspector.name, help: app.help.open, recording: app.recording, settings: { ...app.settings },
        panels: app.curves.panels.map((panel) => ({ paths: [...panel.paths], presentation: panel.presentation, columns: panel.table?.columns.map((c) => c.label) ?? [] })),
        legend: app.legend.element.hidden ? null : { title: app.legend.title, range: app.legend.shown, notes: app.legend.notes },
        camera: app.viewport ? { azimuth: app.viewport.camera.azimuth, elevation: app.viewport.camera.elevation, distance: app.viewport.camera.distance, follows: app.settings.follow } : null,
      };
    },
    seek(time: number) {
      app.player.pause();
      app.player.seek(time);
      app.render(true);
    },
    /** World position of a node at time t, from the data of the page. */
    nodePosition: (run: number, name: string, t: number): Vec => app.runs[run]!.placeAt(nodeOf(run, name).place, t).position,
    /** As it is drawn now: exaggerated, in a mode. */
    nodeDrawn: (run: number, name: string): Vec => app.runs[run]!.drawn(nodeOf(run, name).place).position,
    /** Pixel of the picture, from its upper left corner, in CSS pixels. */
    nodePixel: (run: number, name: string) => app.viewport?.project(app.runs[run]!.drawn(nodeOf(run, name).place).position) ?? null,
    bodyPose: (run: number, body: string, t: number) => {
      const b = app.runs[run]!.bodies.findIndex((entry) => entry.name === body);
      return app.runs[run]!.placeAt({ entry: { body: b }, position: null, rotation: null, body: b }, t);
    },
    channelValue: async (run: number, path: string, row: number) => {
      const index = app.runs[run]!.entry.channels.findIndex((channel) => channel.path === path);
      return (await app.runs[run]!.channel(index))[row];
    },
    /** Abscissa and ordinate of a column of a panel of curves, as it is drawn. */
    curve: (panel: number, column: number) => {
      const found = app.curves.panels[panel]?.table?.columns[column];
      return found ? { label: found.label, unit: found.unit, x: [...found.x], y: [...found.y] } : null;
    },
    csv: (panel: number) => (app.curves.panels[panel]?.table ? csvOf(app.curves.panels[panel].table) : ""),
    /** A picture of one or more states, as base64 of a PNG: `mechanism picture`. */
    still: (request: Still) => still(app, request),
    /** Bytes of the picture that is offered for saving. */
    picture: async () => (await app.savePicture())?.size ?? 0,
    pick: (x: number, y: number) => {
      const picked = app.viewport?.pick(x, y);
      return picked ? { run: picked.run.index, body: picked.run.bodies[picked.body]!.name, node: picked.node === null ? null : picked.run.nodes[picked.node]!.name } : null;
    },
  };
}
