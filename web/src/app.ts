// SPDX-License-Identifier: GPL-3.0-or-later
// The page: joins runs, picture, curves, report and controls, and draws when something moved.
import { Curves } from "./curves/curves";
import type { Page } from "./data/page";
import type { Run } from "./data/run";
import { savePicture, Recorder } from "./ui/capture";
import type { Caption } from "./ui/capture";
import { listenToKeys } from "./ui/commands";
import { commandsOf } from "./ui/command_table";
import { helpDialog } from "./ui/dialogs";
import { button, h, styled } from "./ui/dom";
import { bodyPlace, Inspector } from "./ui/inspector";
import { splitter, Tabs } from "./ui/layout";
import { Labels } from "./ui/labels";
import { Legend, Triad } from "./ui/legend";
import { modelList } from "./ui/model_list";
import { Modes } from "./ui/modes";
import { number } from "./ui/numbers";
import { Player } from "./ui/player";
import { Report } from "./ui/report";
import { Toolbar } from "./ui/toolbar";
import { Transport } from "./ui/transport";
import { GHOST_COLOURS } from "./view/colours";
import { instantsOf, largestValue, storedStress, visibleFactor } from "./view/range";
import type { Largest } from "./view/range";
import { COLOURINGS, INITIAL, STRESS_UNITS } from "./view/settings";
import type { Colouring, Settings } from "./view/settings";
import { Viewport } from "./view/viewport";
import type { Picked } from "./view/viewport";

/** Seconds a picture; share of pixels; milliseconds after which a still is drawn anew, smoothed. */
const SLOW = 1 / 28, QUALITIES = [1, 0.75, 0.5], STILL = 300;

export class App {
  readonly settings: Settings = { ...INITIAL };
  readonly runs: Run[];
  readonly player: Player;
  readonly curves: Curves;
  readonly modes: Modes;
  readonly report: Report;
  readonly transport: Transport;
  readonly toolbar: Toolbar;
  readonly tabs: Tabs;
  readonly legend = new Legend();
  private readonly labels = new Labels();
  readonly inspector: Inspector;
  readonly help: HTMLDialogElement;
  readonly stage: HTMLElement;
  /** Null where the browser has no WebGL. */
  readonly viewport: Viewport | null;
  framesPerSecond = 0;
  private readonly triad = new Triad();
  private readonly scale = h("span", { class: "grid-step" });
  private readonly recorder = new Recorder();
  private readonly ranges = new Map<string, Largest>();
  /** Whether a body deforms. */
  readonly deforms: boolean;
  private readonly message = h("p", { class: "stage-message", role: "status", hidden: true });
  private moved = true;
  private before = 0;
  private readonly intervals: number[] = [];

  constructor(readonly page: Page, root: HTMLElement) {
    this.runs = page.runs;
    if (this.runs.every((run) => run.entry.kind === "part")) this.settings.nodes = true;
    if (this.runs.some((run) => run.entry.kind === "part")) this.settings.nodes = this.settings.names = true;
    this.deforms = this.runs.some((run) => run.shapes.some((shape) => shape.modes));
    const moving = this.runs[0]!.entry.moving;
    if (moving?.follow !== null && moving?.follow !== undefined) this.settings.follow = this.runs[0]!.bodies[moving.follow]?.name ?? "";
    this.settings.exaggeration = visibleFactor(this.runs);
    if (this.runs[0]!.unit("length") === "mm" && this.runs[0]!.entry.pascal) this.settings.stressUnit = "MPa";
    this.player = new Player(this.runs);
    this.curves = new Curves(this.runs, this.player);
    this.report = new Report(this.runs);
    this.modes = new Modes(this.runs, this.player, () => this.recolour());
    this.transport = new Transport(this.player, this.runs);
    const canvas = h("canvas", { class: "picture", tabindex: 0, role: "img", "aria-label": "Picture of the mechanism. Press ? for the keys." });
    const model = modelList(this.runs, (picked) => this.choose(picked));
    const hasModes = this.runs.some((run) => run.entry.modes && run.entry.modes.length > 0);
    const isPart = this.runs.every((run) => run.entry.kind === "part"), hasCurves = !isPart || this.runs.some((run) => run.entry.channels.length > 0);
    this.tabs = new Tabs([
      ...(hasCurves ? [{ key: "curves", title: "Curves", content: this.curves.element, opened: () => this.curves.rebuild() }] : []),
      ...(hasModes ? [{ key: "modes", title: "Modes", content: this.modes.element }] : []),
      { key: "report", title: isPart ? "Mesh" : "Report", content: this.report.element, opened: () => this.report.draw() },
      { key: "model", title: isPart ? "Groups" : "Model", content: model },
    ]);
    this.inspector = new Inspector({
      trace: (picked) => this.trace(picked),
      traced: (picked) => picked.node !== null && (this.viewport?.views[picked.run.index]!.traced.has(picked.node) ?? false),
      centre: (picked) => this.centre(picked),
      close: () => this.choose(null),
      curve: (path) => {
        this.curves.show(path);
        this.tabs.open("curves");
      },
    });
    this.toolbar = new Toolbar(this.settings, {
      view: (view) => {
        this.viewport?.camera.standard(view);
        this.viewport?.touch();
      },
      fit: () => {
        this.viewport?.camera.fit();
        this.viewport?.touch();
      },
      follow: (body) => {
        this.viewport?.follow(body);
        this.recolour();
      },
      changed: () => this.recolour(),
      picture: () => void this.savePicture(),
      video: () => this.record(),
    }, {
      stress: this.runs.some((run) => run.shapes.some((shape) => shape.stress)),
      modes: this.deforms,
      arrows: this.runs.some((run) => run.arrows.length > 0),
      elements: this.runs.some((run) => run.shapes.some((shape) => shape.elements.length > 0)),
      pascal: this.runs.some((run) => run.entry.pascal),
      bodies: isPart || this.runs.every((run) => run.times.length < 2) ? [] : this.runs[0]!.bodies.filter((body) => body.kind !== "road").slice(0, 200).map((body) => body.name),
    });
    this.stage = h("div", { class: "stage" }, this.toolbar.element,
      h("div", { class: "canvas-box" }, canvas, this.labels.element, this.legend.element, h("div", { class: "corner" }, this.triad.element, this.scale), this.inspector.element, this.message));
    const main = h("main", { class: "main" });
    main.append(this.stage, splitter(0.6, (share) => main.style.setProperty("--share", `${100 * share}%`)), this.tabs.element);
    const commands = commandsOf(this);
    this.help = helpDialog(commands, page.header.program);
    this.transport.element.hidden = !hasModes && this.player.end === this.player.begin;
    root.replaceChildren(this.head(), main, this.transport.element);
    document.title = page.header.title;
    this.viewport = this.openViewport(canvas);
    listenToKeys(commands);
    this.viewport?.camera.listen(canvas, () => this.viewport!.touch(), (x, y) => this.choose(this.viewport!.pick(x, y)));
    this.player.onChange(() => (this.moved = true));
    document.addEventListener("fullscreenchange", () => root.classList.toggle("full", document.fullscreenElement !== null));
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.theme());
    new ResizeObserver(() => {
      this.viewport?.touch();
      this.report.resize();
    }).observe(main);
    this.tabs.open(hasModes ? "modes" : this.runs.some((run) => run.entry.channels.length > 0 && run.times.length > 1) ? "curves" : "report");
    this.theme();
    if (hasModes) this.player.choose({ run: this.runs.findIndex((run) => run.entry.modes && run.entry.modes.length > 0), index: 0 });
    requestAnimationFrame((now) => this.frame(now));
  }

  private head(): HTMLElement {
    const isNamed = this.runs.length === 1 && this.runs[0]!.name === this.page.header.title;
    const chips = (isNamed ? [] : this.runs).map((run, i) => {
      const box = h("input", { type: "checkbox", onchange: () => this.showRun(i, box.checked) });
      box.checked = true;
      const mark = h("span", { class: "swatch" });
      mark.style.background = i === 0 ? styled("--ink-2") : GHOST_COLOURS[i % GHOST_COLOURS.length]!;
      return h("label", { class: "chip", title: run.entry.file ?? run.name }, this.runs.length > 1 ? box : null, this.runs.length > 1 ? mark : null, h("span", { class: "name" }, run.name));
    });
    const interrupted = this.runs.filter((run) => run.entry.completed === false).length;
    const doubts = this.runs.reduce((sum, run) => sum + (run.entry.report.doubts?.length ?? 0), 0);
    const warnings = [interrupted > 0 ? "interrupted" : "", doubts > 0 ? `${doubts} warning${doubts > 1 ? "s" : ""}` : ""].filter(Boolean).join(", ");
    return h("header", { class: "head" }, h("h1", {}, this.page.header.title), h("div", { class: "chips", role: "group", "aria-label": "Runs shown" }, ...chips),
      h("span", { class: "grow" }), warnings ? button(warnings, "Open the report", () => this.tabs.open("report"), { class: "warn" }) : null,
      button("Full screen", "Show the picture on the full screen (U)", () => this.fullScreen()), button("?", "Keys and mouse (?)", () => this.help.showModal()));
  }

  private openViewport(canvas: HTMLCanvasElement): Viewport | null {
    try {
      return new Viewport(canvas, this.runs, this.settings);
    } catch (error) {
      this.tell(`This browser cannot draw the 3-D picture (WebGL 2: ${(error as Error).message}). Curves and report work. For the picture, use another browser, or switch hardware acceleration on or off.`);
      return null;
    }
  }

  tell(text: string): void {
    this.message.textContent = text;
    this.message.hidden = text === "";
  }

  theme(): void {
    this.viewport?.theme(styled("--stage"), styled("--ink-2"));
    this.curves.rebuild();
    if (this.tabs.current === "report") this.report.draw();
    this.recolour();
  }

  showRun(index: number, visible: boolean): void {
    this.runs[index]!.visible = visible;
    if (!this.runs.some((run) => run.visible)) this.runs[index]!.visible = true;
    for (const [i, box] of document.querySelectorAll<HTMLInputElement>(".chips input").entries()) box.checked = this.runs[i]!.visible;
    this.viewport?.rank();
    this.curves.rebuild();
    this.recolour();
  }

  choose(picked: Picked | null): void {
    for (const view of this.viewport?.views ?? []) view.chosen = picked && view.run === picked.run ? picked.body : -1;
    this.inspector.choose(picked);
    this.viewport?.touch();
  }
  private trace(picked: Picked): void {
    const view = this.viewport?.views[picked.run.index];
    if (!view || picked.node === null) return;
    if (!view.traced.delete(picked.node)) view.traced.add(picked.node);
    view.retrace();
    this.viewport!.touch();
  }
  private centre(picked: Picked): void {
    if (!this.viewport) return;
    const place = picked.node === null ? bodyPlace(picked.body) : picked.run.nodes[picked.node]!.place;
    const p = picked.run.drawn(place).position;
    this.viewport.camera.target = [0, 1, 2].map((i) => p[i]! - this.viewport!.origin[i]!) as [number, number, number];
    this.viewport.touch();
  }

  cycleColouring(): void {
    const values = [...this.toolbar.element.querySelectorAll<HTMLOptionElement>("select[aria-label^='Colour by'] option")].map((o) => o.value as Colouring);
    const i = values.indexOf(this.settings.colouring);
    this.settings.colouring = values[(i + 1) % values.length]!;
    this.toolbar.follow();
    this.recolour();
  }

  /** The body that the page follows by default, or the chosen one, else the first; or none. */
  toggleFollow(): void {
    const run = this.runs[0]!, usual = run.bodies[run.entry.moving?.follow ?? 0]?.name ?? "", chosen = this.inspector.picked;
    this.viewport?.follow(this.settings.follow !== "" ? "" : chosen && chosen.run === run ? run.bodies[chosen.body]!.name : usual);
    this.toolbar.follow();
    this.recolour();
  }

  /** After a change of settings: range and legend of the coloured quantity, grid, picture. */
  recolour(): void {
    const { settings, viewport } = this;
    if (!viewport) return;
    if (settings.arrows) void this.readArrows();
    if (settings.colouring === "body") this.legend.hide();
    else this.showLegend();
    viewport.colour(this.legend.element.hidden ? [0, 1] : this.legend.range);
    viewport.regrid();
    this.scale.textContent = [settings.grid ? `grid ${number(viewport.gridStep)} ${this.runs[0]!.unit("length")}` : "",
      this.deforms && settings.exaggeration !== 1 ? `deformation × ${number(settings.exaggeration)}` : ""].filter(Boolean).join(", ");
    this.moved = true;
  }

  async readArrows(): Promise<void> {
    if (!this.viewport) return;
    await Promise.all(this.viewport.views.map((view) => view.readArrows()));
    this.viewport.touch();
  }

  /** The scale of the coloured quantity, with its largest value; a mode has no size, so that its scale is relative. */
  private showLegend(): void {
    const { settings } = this, isStress = settings.colouring === "stress", isMode = this.player.mode !== null;
    const visible = this.runs.filter((r) => r.visible), run = visible[0]!;
    const largest = visible.map((r) => ({ run: r, ...this.largest(r) })).reduce((a, b) => (b.value > a.value ? b : a));
    const chosen = isStress && run.entry.pascal ? STRESS_UNITS[settings.stressUnit] : undefined;
    const factor = isMode ? 1 / (largest.value || 1) : chosen ? run.entry.pascal! / chosen : 1;
    const unit = isMode ? "" : chosen ? settings.stressUnit : run.unit(isStress ? "stress" : "length");
    const title = isStress ? `${run.shapes.find((s) => s.stress)?.stress?.quantity ?? ""} stress`.trim() : settings.colouring;
    const notes = [];
    if (largest.time !== null)
      notes.push(`largest ${number(factor * largest.value)}${unit ? ` ${unit}` : ""} at (${largest.place.map((x) => number(Math.abs(x) < 1e-9 * run.size ? 0 : x)).join(", ")})${isStress ? " of the part" : ""}, '${largest.body}', t = ${number(largest.time)} ${run.unit("time")}`.trim());
    if (isMode) notes.push("relative to the largest value: the amplitude of a mode is arbitrary");
    else notes.push({ displacement: "relative to the first instant", deformation: "within the body, not exaggerated", body: "",
      stress: "Mean values at the drawn nodes. `reducer recover` gives the largest stress of an element, which may be larger." }[settings.colouring]);
    this.legend.show(title, unit, [0, largest.value || 1], factor, settings.map, notes);
  }

  private largest(run: Run): Largest {
    const mode = this.player.mode?.run === run.index ? this.player.mode : null;
    const key = `${run.index} ${COLOURINGS.indexOf(this.settings.colouring)} ${mode ? `${mode.index} ${this.modes.share}` : ""}`;
    let value = this.ranges.get(key);
    if (value === undefined) {
      const amplitude = mode ? this.modes.amplitude(run, mode.index) : 0;
      const states = mode ? Array.from({ length: 16 }, (_, i) => () => run.seekMode(mode.index, amplitude, (i * Math.PI) / 8)) : instantsOf(run);
      const stored = this.settings.colouring === "stress" && !mode ? storedStress(run) : null;
      value = stored ?? largestValue(run, this.settings.colouring, states, mode === null);
      this.ranges.set(key, value);
    }
    this.place();
    return value;
  }

  /** Moves all runs to the time of the player, or into its mode. */
  private place(): void {
    for (const run of this.runs) {
      const mode = this.player.mode?.run === run.index ? this.player.mode : null;
      if (mode) run.seekMode(mode.index, this.modes.amplitude(run, mode.index), this.player.phase);
      else if (run.visible) run.seek(this.player.time);
    }
  }

  private lastMode = "";
  private frame(now: number): void {
    requestAnimationFrame((next) => this.frame(next));
    const seconds = Math.min(0.25, (now - this.before) / 1000);
    if (this.player.playing) this.measure(seconds);
    else this.intervals.length = 0;
    this.before = now;
    this.player.advance(seconds);
    const mode = this.player.mode ? `${this.player.mode.run} ${this.player.mode.index}` : "";
    if (mode !== this.lastMode) {
      this.lastMode = mode;
      this.recolour();
    }
    this.render();
  }

  /** Draws if something moved; `always` for pictures and tests. */
  render(always = false): void {
    const moved = this.moved;
    if (moved) {
      this.moved = false;
      this.place();
      this.curves.follow();
      this.inspector.follow();
      this.viewport?.touch();
    }
    if (!this.viewport) return;
    if (!this.player.playing && !this.viewport.fixed) this.viewport.quality = this.viewport.software && this.viewport.still > STILL ? 2 : 1;
    if (this.viewport.draw(always)) {
      this.triad.follow(this.viewport.camera);
      this.labels.follow(this.viewport);
      if (this.recorder.recording) this.recorder.picture(this.viewport.canvas, this.caption());
      if (this.viewport.fault) this.tell(`The picture cannot be drawn: ${this.viewport.fault}`);
    }
  }

  private measure(seconds: number): void {
    this.intervals.push(seconds);
    if (this.intervals.length < 20) return;
    const mean = this.intervals.reduce((sum, s) => sum + s, 0) / this.intervals.length;
    this.framesPerSecond = 1 / mean;
    this.intervals.length = 0;
    if (!this.viewport || mean < SLOW) return;
    this.viewport.quality = QUALITIES[Math.min(QUALITIES.length - 1, QUALITIES.indexOf(this.viewport.quality) + 1)]!;
  }

  caption(): Caption {
    const { legend, settings } = this;
    return { title: this.page.header.title, time: this.transport.text, legend: legend.element.hidden ? null : { title: legend.title, range: legend.shown, map: settings.map, notes: legend.notes } };
  }
  savePicture(): Promise<Blob | null> {
    if (!this.viewport) return Promise.resolve(null);
    this.viewport.quality = 2;
    return savePicture(this.viewport.canvas, () => this.viewport!.draw(true), this.caption());
  }
  record(): void {
    if (!this.viewport) return;
    if (!Recorder.possible) return this.tell("This browser cannot record a video (no MediaRecorder).");
    if (this.recorder.recording) this.recorder.stop();
    else this.recorder.start(this.viewport.canvas, this.page.header.title);
    this.toolbar.video.setAttribute("aria-pressed", String(this.recorder.recording));
    this.toolbar.video.textContent = this.recorder.recording ? "Stop video" : "Video";
    this.viewport.touch();
  }
  get recording(): boolean {
    return this.recorder.recording;
  }
  fullScreen(): void {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void document.documentElement.requestFullscreen?.().catch(() => this.tell("This browser does not allow full screen here."));
  }
}
