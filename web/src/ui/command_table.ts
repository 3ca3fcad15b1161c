// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of the page.
import type { App } from "../app";
import type { Standard } from "../view/camera";
import type { Switch } from "../view/settings";
import type { Command } from "./commands";

export function commandsOf(app: App): Command[] {
  const { player, settings } = app;
  const camera = (move: () => void) => (): void => {
    move();
    app.viewport?.touch();
  };
  const view = (key: string, name: Standard, text: string): Command =>
    ({ keys: [key], name: text, group: "View", run: camera(() => app.viewport?.camera.standard(name)) });
  const toggle = (key: string, name: Switch, text: string): Command => ({
    keys: [key], name: text, group: "Show", run: () => {
      settings[name] = !settings[name];
      app.toolbar.follow();
      app.recolour();
    },
  });
  const deform = (factor: number) => (): void => {
    settings.exaggeration = Number((settings.exaggeration * factor).toPrecision(3)) || 1;
    app.toolbar.follow();
    app.recolour();
  };
  const turn = (azimuth: number, elevation: number): (() => void) => camera(() => app.viewport?.camera.orbit(azimuth, elevation));
  return [
    { keys: [" "], name: "Play or pause", group: "Time", run: () => player.toggle() },
    { keys: ["ArrowRight"], name: "Next stored instant", group: "Time", run: () => player.step(1) },
    { keys: ["ArrowLeft"], name: "Previous stored instant", group: "Time", run: () => player.step(-1) },
    { keys: ["PageDown"], name: "Twenty instants forward", group: "Time", run: () => player.step(20) },
    { keys: ["PageUp"], name: "Twenty instants back", group: "Time", run: () => player.step(-20) },
    { keys: ["Home"], name: "Go to the start", group: "Time", run: () => player.seek(player.begin) },
    { keys: ["End"], name: "Go to the end", group: "Time", run: () => player.seek(player.end) },
    { keys: ["]"], name: "Faster", group: "Time", run: () => player.faster(1) },
    { keys: ["["], name: "Slower", group: "Time", run: () => player.faster(-1) },
    { keys: ["l"], name: "Loop", group: "Time", run: () => {
      player.loop = !player.loop;
      player.changed();
    } },
    { keys: ["f"], name: "Fit", group: "View", run: camera(() => app.viewport?.camera.fit()) },
    view("1", "iso", "Oblique"), view("2", "front", "Front"), view("3", "right", "Right"), view("4", "top", "Top"),
    view("5", "back", "Back"), view("6", "left", "Left"), view("7", "bottom", "Bottom"),
    { keys: ["Shift+ArrowLeft"], name: "Turn left", group: "View", run: turn(-0.08, 0) },
    { keys: ["Shift+ArrowRight"], name: "Turn right", group: "View", run: turn(0.08, 0) },
    { keys: ["Shift+ArrowUp"], name: "Turn up", group: "View", run: turn(0, 0.08) },
    { keys: ["Shift+ArrowDown"], name: "Turn down", group: "View", run: turn(0, -0.08) },
    { keys: ["+", "="], name: "Nearer", group: "View", run: camera(() => app.viewport?.camera.zoom(0.85)) },
    { keys: ["-"], name: "Farther", group: "View", run: camera(() => app.viewport?.camera.zoom(1 / 0.85)) },
    toggle("p", "parallel", "Parallel picture"),
    { keys: ["o"], name: "Camera follows a body or is fixed", group: "View", run: () => app.toggleFollow() },
    { keys: ["c"], name: "Next colouring", group: "Show", run: () => app.cycleColouring() },
    { keys: ["y"], name: "More deformation", group: "Show", run: deform(1.25) },
    { keys: ["x"], name: "Less deformation", group: "Show", run: deform(0.8) },
    toggle("e", "edges", "Edges"), toggle("d", "elements", "Edges of elements"), toggle("g", "grid", "Grid"), toggle("a", "worldAxes", "World axes"), toggle("b", "bodyAxes", "Body axes"),
    toggle("n", "nodes", "Nodes"), toggle("m", "names", "Names of nodes"), toggle("j", "joints", "Joints"), toggle("s", "springs", "Springs"), toggle("v", "arrows", "Forces and moments"),
    { keys: ["/"], name: "Search channels", group: "Page", run: () => {
      app.tabs.open("curves");
      app.curves.tree.focus();
    } },
    { keys: ["k"], name: "Save a picture", group: "Page", run: () => void app.savePicture() },
    { keys: ["r"], name: "Record a video, stop", group: "Page", run: () => app.record() },
    { keys: ["u"], name: "Full screen", group: "Page", run: () => app.fullScreen() },
    { keys: ["Escape"], name: "Clear the selection", group: "Page", run: () => app.choose(null) },
    { keys: ["?", "Shift+?"], name: "This help", group: "Page", run: () => app.help.showModal() },
  ];
}
