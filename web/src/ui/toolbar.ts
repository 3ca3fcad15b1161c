// SPDX-License-Identifier: GPL-3.0-or-later
// The bar above the picture: view, colour, deformation, what is shown, capture.
import { button, checkbox, h, select } from "./dom";
import type { Standard } from "../view/camera";
import { STRESS_UNITS } from "../view/settings";
import type { Colouring, Settings, Switch } from "../view/settings";
import type { MapName } from "../view/colours";

export interface ToolbarActions {
  view(view: Standard): void;
  fit(): void;
  follow(body: string): void;
  changed(): void;
  picture(): void;
  video(): void;
}

const SWITCHES: [Switch, string, string][] = [
  ["edges", "Edges of surfaces", "E"], ["elements", "Edges of elements", "D"], ["grid", "Ground grid", "G"], ["worldAxes", "World axes", "A"], ["bodyAxes", "Body axes", "B"],
  ["nodes", "Nodes", "N"], ["names", "Names of nodes", "M"], ["joints", "Joints", "J"], ["springs", "Springs", "S"], ["arrows", "Forces and moments", "V"],
];

export class Toolbar {
  readonly element: HTMLElement;
  readonly video: HTMLButtonElement;
  private readonly controls: Partial<Record<keyof Settings, HTMLInputElement | HTMLSelectElement>> = {};
  private readonly projection: HTMLButtonElement;

  constructor(private readonly settings: Settings, private readonly actions: ToolbarActions, has: { stress: boolean; modes: boolean; arrows: boolean; elements: boolean; pascal: boolean; bodies: string[] }) {
    const views = (["iso", "front", "back", "left", "right", "top", "bottom"] as Standard[])
      .map((view): [string, string] => [view, view === "iso" ? "Oblique" : view[0]!.toUpperCase() + view.slice(1)]);
    const view = select("Standard view", [["", "View"], ...views], "", (value) => {
      if (value) actions.view(value as Standard);
      view.value = "";
    });
    const colourings: [Colouring, string][] = [["body", "Colour: body"], ["displacement", "Colour: displacement"],
      ...(has.modes ? [["deformation", "Colour: deformation"] as [Colouring, string]] : []), ...(has.stress ? [["stress", "Colour: stress"] as [Colouring, string]] : [])];
    const colour = select("Colour by (C)", colourings, settings.colouring, (value) => this.set("colouring", value as Colouring));
    this.projection = button("Parallel", "Parallel or perspective picture (P)", () => this.set("parallel", !settings.parallel), { "aria-pressed": "false" });
    this.video = button("Video", "Record a video of the picture (R); press again to stop", actions.video, { "aria-pressed": "false" });
    const show = h("details", { class: "menu" }, h("summary", { title: "Choose what is shown" }, "Show"), h("div", { class: "menu-body" },
      ...SWITCHES.filter(([key]) => key !== "elements" || has.elements).map(([key, text, letter]) => this.check(key, text, letter)),
      has.arrows ? this.factor("arrowScale", "Arrows", 0.1, 10) : null,
      this.factor("glyphScale", "Joint glyphs", 0.2, 5),
      has.stress && has.pascal ? h("label", { class: "field" }, h("span", {}, "Stress in"), (this.controls.stressUnit =
        select("Unit of stress", [["", "unit of the scene"], ...Object.keys(STRESS_UNITS).map((unit): [string, string] => [unit, unit])], settings.stressUnit, (value) => this.set("stressUnit", value)))) : null,
      h("label", { class: "field" }, h("span", {}, "Colour map"),
        (this.controls.map = select("Colour map", [["viridis", "Viridis"], ["cividis", "Cividis"]], settings.map, (value) => this.set("map", value as MapName))))));
    this.controls.colouring = colour;
    if (has.bodies.length > 0)
      this.controls.follow = select("Body that the camera follows", [["", "Camera fixed"], ...has.bodies.map((name): [string, string] => [name, `Follows ${name}`])], settings.follow, (value) => actions.follow(value));
    this.element = h("div", { class: "toolbar", role: "toolbar", "aria-label": "Picture" },
      view, button("Fit", "Show everything (F)", actions.fit), this.projection, this.controls.follow ?? null, colour,
      has.modes ? this.deformation() : null, show, h("span", { class: "grow" }),
      button("Picture", "Save the picture as PNG (K)", actions.picture), this.video);
    document.addEventListener("pointerdown", (event) => {
      if (show.open && event.target instanceof Node && !show.contains(event.target)) show.open = false;
    });
    show.addEventListener("keydown", (event) => {
      if (event.key === "Escape") show.open = false;
    });
  }

  private set<K extends keyof Settings>(key: K, value: Settings[K]): void {
    this.settings[key] = value;
    this.actions.changed();
    this.follow();
  }

  private check(key: Switch, text: string, letter: string): HTMLElement {
    const label = checkbox(text, this.settings[key], (on) => this.set(key, on), `${text} (${letter})`);
    this.controls[key] = label.querySelector("input")!;
    label.append(h("kbd", {}, letter));
    return label;
  }

  /** A factor on a logarithmic slider. */
  private factor(key: "arrowScale" | "glyphScale", text: string, low: number, high: number): HTMLElement {
    const slider = h("input", { type: "range", min: Math.log10(low), max: Math.log10(high), step: 0.01, value: 0, "aria-label": `Size: ${text}`,
      oninput: () => this.set(key, 10 ** Number(slider.value)) });
    return h("label", { class: "field" }, h("span", {}, text), slider);
  }

  private deformation(): HTMLElement {
    const field = h("input", { type: "number", min: 0, step: "any", value: this.settings.exaggeration, "aria-label": "Factor on deformations", class: "factor",
      onchange: () => this.set("exaggeration", Number.isFinite(field.valueAsNumber) ? Math.max(0, field.valueAsNumber) : 1) });
    this.controls.exaggeration = field;
    return h("label", { class: "inline", title: "Factor on deformations; rigid motion is not changed (X: less, Y: more)" }, h("span", {}, "Deformation ×"), field);
  }

  follow(): void {
    for (const [key, control] of Object.entries(this.controls)) {
      const value = this.settings[key as keyof Settings];
      if (control instanceof HTMLInputElement && control.type === "checkbox") control.checked = value as boolean;
      else if (document.activeElement !== control || control instanceof HTMLSelectElement) control.value = String(value);
    }
    this.projection.setAttribute("aria-pressed", String(this.settings.parallel));
  }
}
