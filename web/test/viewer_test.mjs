// SPDX-License-Identifier: GPL-3.0-or-later
// The committed viewer in a real browser, over pages of known motion. Skipped (exit 77) where node or Chromium is missing.
// Arguments: --small runs only two of the tests; a path names another viewer (default: dist/view.html).
// Expected values come from the formulas in scenes.mjs.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { Browser, CHROMIUM } from "./browser.mjs";
import { corner, differ, near, quiet } from "./checks.mjs";
import { decodePng } from "./png.mjs";
import { sceneBlocks, SWING } from "./scenes.mjs";
import { pageOf } from "./writer.mjs";

if (!CHROMIUM) {
  process.stdout.write("not tested: there is no chromium here (apt-get install chromium)\n");
  process.exit(77);
}

const words = process.argv.slice(2), small = words[0] === "--small";
if (small) words.shift();
const viewer = readFileSync(words[0] ?? join(dirname(fileURLToPath(import.meta.url)), "..", "dist", "view.html"), "utf8");
const folder = mkdtempSync(join(tmpdir(), "tisserand-pages-"));
let browser;

/** Opens a scene in a new tab, or in `tab`; `change` edits its header, `damage` its numbers, `edit` the text of the page. */
async function open(scene, { change = () => {}, damage, edit = (html) => html, before = "", tab = null, ...options } = {}) {
  const { header, blocks } = sceneBlocks(scene), file = join(folder, `${scene}${Math.random().toString(36).slice(2)}.html`);
  change(header);
  writeFileSync(file, edit(pageOf(viewer, header, blocks, damage ? { damage } : {})));
  const page = tab ?? (await browser.page(options));
  if (before) await page.send("Page.addScriptToEvaluateOnNewDocument", { source: before });
  await page.open(file);
  return page;
}

const state = (page) => page.evaluate("tisserand.state");

/** Of the scene `beam`: the largest |stress| over the instants and rings of vertices that the page samples; it is that of bending. */
function largestStress() {
  let largest = 0;
  for (let row = 0; row < 201; row += 4)
    for (let ring = 0; ring <= 40; ++ring) {
      const [a, b] = SWING.bending((5 * row) / 200), s = ring / 40;
      largest = Math.max(largest, Math.abs(2.1e11 * 0.05 * 0.1 * (a * (1 - s) + b * Math.sin(3 * s))));
    }
  return largest;
}

test("the viewer", async (suite) => {
  const run = suite.test.bind(suite);
  suite.test = async (name, body) => (small && !/^(shows numbers|draws the body)/.test(name) ? undefined : run(name, body));
  browser = await Browser.start();
  suite.after(async () => {
    await browser.stop();
    rmSync(folder, { recursive: true, force: true });
  });

  await suite.test("shows numbers within their quantisation, and interpolates between instants", async () => {
    const page = await open("beam"), rows = 201, end = 5, amplitude = 0.8, length = SWING.length;
    // 16 bits over at most 2 length, positions and amplitudes linear between rows: h^2/8 of the second derivative.
    const step = (2.2 * length) / 65534 + 1e-6, second = 2.5 ** 2 * amplitude ** 2 * length + 2.5 ** 2 * amplitude * length + 0.06 * 81 + 0.02 * 529;
    for (const row of [0, 17, 111, 200]) {
      const t = (end * row) / (rows - 1);
      near(await page.evaluate(`tisserand.nodePosition(0, 'beam/tip', ${t})`), SWING.tip(t, amplitude), step, `tip at row ${row}`);
    }
    const t = (end * 31.5) / (rows - 1), h = end / (rows - 1);
    near(await page.evaluate(`tisserand.nodePosition(0, 'beam/end', ${t})`), SWING.tip(t, amplitude), step + (h * h * second) / 8, "tip between rows, by its other name");
    const turn = Math.PI / 2 - SWING.angle(t, amplitude), pose = await page.evaluate(`tisserand.bodyPose(0, 'beam', ${t})`);
    near(pose.rotation, [Math.cos(turn / 2), 0, Math.sin(turn / 2), 0], 1.0 / 32767 + (h * h * 2.5 ** 2 * amplitude) / 16, "rotation between rows");
    near([await page.evaluate("tisserand.channelValue(0, 'joints/coordinate/hinge/angle', 40)")], [SWING.angle(1, amplitude)], 1e-7, "channel (32 bits)");
    await quiet(page);
  });

  await suite.test("draws the body where the results say", async () => {
    const page = await open("beam");
    for (const t of [0, 0.6, 1.3]) {
      await page.evaluate(`tisserand.seek(${t})`);
      await page.until("tisserand.quality === 2");
      const box = await corner(page);
      const tip = await page.evaluate("tisserand.nodePixel(0, 'beam/tip')"), root = await page.evaluate("tisserand.nodePixel(0, 'beam/root')");
      const picture = decodePng(await page.screenshot()), ground = picture.at(box.left + 6, box.top + 6);
      for (const s of [0.15, 0.95]) {
        const colour = picture.at(box.left + tip.x + s * (root.x - tip.x), box.top + tip.y + s * (root.y - tip.y));
        if (s < 0.5) assert.ok(colour[2] > colour[0] + 20, `blue beam at t = ${t}: ${colour}`);
        assert.ok(differ(colour, ground) > 30, `something at the beam at t = ${t}: ${colour} on ${ground}`);
      }
      assert.ok(differ(picture.at(box.left + tip.x + 60, box.top + tip.y + 40), ground) < 60, "nothing solid beside the tip");
    }
    await quiet(page);
  });

  await suite.test("obeys the keyboard", async () => {
    const page = await open("beam");
    await page.key(" ");
    await page.until("tisserand.state.playing && tisserand.time > 0.05");
    await page.key(" ");
    assert.equal((await state(page)).playing, false);
    await page.evaluate("document.querySelector('.transport input[type=range]').focus()");
    await page.key(" ");
    assert.equal((await state(page)).playing, true, "Space plays with the slider in focus");
    await page.key(" ");
    await page.evaluate("document.activeElement.blur()");
    await page.key("Home");
    assert.equal(await page.evaluate("tisserand.time"), 0);
    await page.key("ArrowRight");
    near([await page.evaluate("tisserand.time")], [0.025], 1e-6, "one instant on");
    await page.key("PageDown");
    near([await page.evaluate("tisserand.time")], [0.525], 1e-6, "twenty instants on");
    await page.key("ArrowLeft");
    near([await page.evaluate("tisserand.time")], [0.5], 1e-6, "one instant back");
    await page.key("End");
    assert.equal(await page.evaluate("tisserand.time"), 5);
    for (const [key, name] of Object.entries({ e: "edges", g: "grid", a: "worldAxes", b: "bodyAxes", n: "nodes", j: "joints", s: "springs", v: "arrows", p: "parallel" })) {
      const before = (await state(page)).settings[name];
      await page.key(key);
      assert.equal((await state(page)).settings[name], !before, `${key} switches ${name}`);
    }
    const seen = new Set();
    for (const key of "1234567") {
      await page.key(key);
      const { azimuth, elevation } = (await state(page)).camera;
      seen.add(`${azimuth} ${elevation}`);
    }
    assert.equal(seen.size, 7, "seven standard views");
    for (const expected of ["displacement", "deformation", "stress"]) {
      await page.key("c");
      const now = await state(page);
      assert.equal(now.settings.colouring, expected);
      assert.ok(now.legend.range[1] > 0);
    }
    const { legend } = await state(page);
    assert.equal(legend.title, "von Mises stress [Pa]");
    near([legend.range[1]], [largestStress()], 2e-3 * largestStress(), "largest stress over the sampled instants");
    await page.key("]");
    assert.equal((await state(page)).speed, 2);
    await page.key("l");
    assert.equal((await state(page)).loop, false);
    await page.key("y");
    assert.equal((await state(page)).settings.exaggeration, 1.25);
    await page.evaluate("tisserand.seek(1)");
    const phi = SWING.angle(1, 0.8), along = [2 * Math.sin(phi), 0, -2 * Math.cos(phi)];
    near(await page.evaluate("tisserand.nodeDrawn(0, 'beam/tip')"), SWING.tip(1, 0.8).map((x, i) => along[i] + 1.25 * (x - along[i])), 3e-4, "exaggerated tip: 16 bits of place and of turn");
    await page.key("r");
    assert.equal((await state(page)).recording, true);
    await page.key("r");
    assert.equal((await state(page)).recording, false);
    await page.key("?");
    assert.equal((await state(page)).help, true);
    await page.evaluate("document.querySelector('dialog[open] button').click()");
    assert.equal((await state(page)).help, false);
    await page.key("/");
    assert.equal(await page.evaluate("document.activeElement.type"), "search");
    assert.ok((await page.evaluate("tisserand.picture()")) > 1000, "a picture of more than a kilobyte");
    await quiet(page);
  });

  await suite.test("obeys mouse and buttons, and links curves with the time", async () => {
    const page = await open("beam");
    await page.evaluate("tisserand.seek(0.4)");
    const box = await corner(page);
    const tip = await page.evaluate("tisserand.nodePixel(0, 'beam/tip')"), root = await page.evaluate("tisserand.nodePixel(0, 'beam/root')");
    await page.click(box.left + tip.x, box.top + tip.y);
    assert.equal((await state(page)).chosen, "beam/tip");
    await page.click(box.left + 0.6 * tip.x + 0.4 * root.x, box.top + 0.6 * tip.y + 0.4 * root.y);
    assert.equal((await state(page)).chosen, "beam");
    assert.match(await page.evaluate("document.querySelector('.inspector').textContent"), /mass12\.5 kg/);
    await page.key("Escape");
    assert.equal((await state(page)).chosen, "");
    const before = (await state(page)).camera;
    await page.drag(box.left + 60, box.top + 80, 90, 30);
    const after = (await state(page)).camera;
    assert.ok(Math.abs(after.azimuth - before.azimuth) > 0.3 && after.elevation > before.elevation, "a drag turns the picture");
    await page.send("Input.dispatchMouseEvent", { type: "mouseWheel", x: box.left + 60, y: box.top + 80, deltaX: 0, deltaY: 300 });
    await page.until(`tisserand.state.camera.distance > ${after.distance}`);

    await page.until("tisserand.curve(0, 0) !== null");
    const plot = await page.evaluate("(({left, top, width, height}) => ({left, top, width, height}))(document.querySelector('.u-over').getBoundingClientRect())");
    await page.click(plot.left + plot.width / 2, plot.top + plot.height / 2);
    near([await page.evaluate("tisserand.time")], [2.5], 0.05, "a click in a curve goes to that time");
    const shown = await page.evaluate("tisserand.time");
    await page.until(`Math.abs(Number(document.querySelector('.reading').textContent) - ${SWING.tip(shown, 0.8)[0]}) < 5e-3`);  // h^2/8 of the rows
    await page.drag(plot.left + 0.2 * plot.width, plot.top + 40, 0.4 * plot.width, 0);
    await page.until("tisserand.state.panels[0].columns.length === 2");
    assert.match(await page.evaluate("tisserand.csv(0)"), /^time \[s\],nodes\/position\/beam\/tip\/x \[m\],measured \[m\]\r\n0,1\.43/);
    await page.evaluate("[...document.querySelectorAll('.transport button')].forEach((b) => b.click())");
    for (const tab of ["Report", "Model", "Curves"]) {
      await page.evaluate(`[...document.querySelectorAll('[role=tab]')].find((b) => b.textContent === '${tab}').click()`);
      assert.equal((await state(page)).tab, tab.toLowerCase());
    }
    const report = await page.evaluate("document.querySelector('.report').textContent");
    assert.ok(report.indexOf("Warnings") >= 0 && report.indexOf("Warnings") < report.indexOf("Notes") && report.indexOf("Notes") < report.indexOf("Data of the run"), "warnings and notes first");
    await quiet(page);
  });

  await suite.test("finds the frequency and the amplitude of a swing in its spectrum", async () => {
    const page = await open("beam", { change: (header) => (header.runs[0].references = [{ ...header.runs[0].references[0], channel: "joints/coordinate/hinge/angle" }]) });
    await page.evaluate("(() => { const s = document.querySelector('.panel select'); s.value = 'spectrum'; s.dispatchEvent(new Event('change')); })()");
    await page.until("tisserand.curve(0, 0)?.x.length > 100 && tisserand.state.panels[0].columns.length === 1");
    const { x, y } = await page.evaluate("tisserand.curve(0, 0)"), peak = y.indexOf(Math.max(...y));
    // Lines are 0.2 Hz apart; between two lines a Hann window reads 15 % low.
    near([x[peak]], [2.5 / (2 * Math.PI)], 0.1, "frequency");
    assert.ok(y[peak] > 0.85 * 0.8 && y[peak] < 1.02 * 0.8, `amplitude ${y[peak]}`);
    await quiet(page);
  });

  await suite.test("moves in modes", async () => {
    const page = await open("modes");
    await page.until("tisserand.state.mode !== null && tisserand.state.phase > 0.1");
    await page.key(" ");
    assert.match(await page.evaluate("document.querySelector('.modes').textContent"), /219\.71\.3Show/);
    const rest = await page.evaluate("tisserand.nodePosition(0, 'beam/tip', 0)"), moved = await page.evaluate("tisserand.nodeDrawn(0, 'beam/root')");
    near(moved, [0, 0, 0], 1e-3, "the hinge stays");
    // The first mode is the first bending shape alone, 1 at the tip, shown with 8 % of the diagonal of the box.
    const tip = await page.evaluate("tisserand.nodeDrawn(0, 'beam/tip')"), diagonal = Math.hypot(4.2, 0.6, 2.3);  // without `moving` its size is that of the box
    near([Math.hypot(...tip.map((x, i) => x - rest[i]))], [Math.abs(0.08 * diagonal * Math.cos((await state(page)).phase))], 1e-3, "motion of the tip");
    await page.evaluate("document.querySelectorAll('.modes tbody button')[1].click()");
    await page.until("tisserand.state.mode.index === 1 && tisserand.state.phase > 0.1");
    const frame = await page.evaluate("tisserand.nodeDrawn(0, 'frame/left')"), phase = (await state(page)).phase;
    assert.ok(Math.abs(frame[0]) < 1e-6 && Number.isFinite(phase), "the frame moves along y only");
    await quiet(page);
  });

  await suite.test("lays runs over one another and subtracts them", async () => {
    const page = await open("two", { dark: true });
    await page.until("tisserand.state.panels[0].columns.length === 4");
    await page.evaluate("(() => { const s = document.querySelector('.panel select'); s.value = 'difference'; s.dispatchEvent(new Event('change')); })()");
    await page.until("tisserand.state.panels[0].columns.length === 1");
    const { x, y } = await page.evaluate("tisserand.curve(0, 0)");
    for (const i of [3, 90, 180])  // rows of the second run are 1/30 s apart, between them it is linear
      near([y[i]], [SWING.tip(x[i], 0.6)[0] - SWING.tip(x[i], 0.8)[0]], ((1 / 30) ** 2 / 8) * 40, `difference at row ${i}`);
    await page.evaluate("document.querySelectorAll('.chips input')[1].click()");
    await page.until("tisserand.state.panels[0].columns.length === 0");
    assert.deepEqual(await page.evaluate("tisserand.bodies"), [3, 3]);
    await quiet(page);
  });

  await suite.test("shows markup in names as text, and runs nothing that came with the data", async () => {
    const page = await open("markup"), title = sceneBlocks("markup").header.title;
    for (const tab of ["Report", "Model", "Curves"]) await page.evaluate(`[...document.querySelectorAll('[role=tab]')].find((b) => b.textContent === '${tab}').click()`);
    assert.equal(await page.evaluate("document.title"), title.replace(/[\t\n\f\r ]+/g, " ").trim());
    assert.equal(await page.evaluate("document.querySelectorAll('img, iframe, object, embed, link').length"), 0);
    assert.equal(await page.evaluate("document.querySelector('h1').textContent"), title);
    await page.evaluate("(() => { const s = document.createElement('script'); s.textContent = 'window.injected = 1'; document.body.append(s); })()");
    assert.equal(await page.evaluate("window.injected"), undefined, "the policy lets no other script run");
    assert.equal(await page.evaluate("fetch('https://example.invalid/').then(() => 'sent', () => 'refused')"), "refused");
    assert.ok(page.complaints.every((text) => /Content Security Policy/.test(text)), page.complaints.join());
    page.complaints.length = 0;
    page.requests = page.requests.filter((url) => !url.includes("example.invalid"));
    await quiet(page);
  });

  await suite.test("tells what is wrong with damaged data", async () => {
    const cases = [
      [/not base64/, { damage: (text) => `${text.slice(0, 40)}*${text.slice(41)}` }],
      [/page is incomplete/, { damage: (text) => text.slice(0, Math.floor(text.length / 8) * 4) }],
      [/does not unpack/, { damage: (text) => `AAAA${text.slice(4)}` }],
      [/not JSON/, { edit: (html) => html.replace('id="tisserand-header">{', 'id="tisserand-header">{{') }],
      [/have version 2, but its viewer reads version 1/, { change: (header) => (header.version = 2) }],
      [/no list 'nodes'/, { change: (header) => delete header.runs[0].nodes }],
      [/there is no shape 9/, { change: (header) => (header.runs[0].bodies[0].shape = 9) }],
      [/rotation has 5 rows/, { change: (header) => (header.runs[0].bodies[0].rotation.shape = [5, 4]) }],
      [/its block holds/, { change: (header) => (header.runs[0].times.shape = [100000000]) }],
      [/empty viewer/, { edit: () => viewer }],
    ];
    let tab = null;
    for (const [message, options] of cases) {
      const page = (tab = await open("beam", { ...options, tab }));
      assert.match(await page.evaluate("tisserand.failure ?? 'opened'"), message);
      assert.match(await page.evaluate("document.querySelector('[role=alert]').innerText"), message);
    }
    await tab.close();
  });

  await suite.test("keeps half of a narrow window for the picture, and cuts nothing off", async () => {
    for (const [width, height] of [[390, 844], [820, 1180], [1600, 900]]) {
      const page = await open("beam", { width, height });
      await page.until("tisserand.curve(0, 0) !== null");
      await page.key("c");
      const box = await page.evaluate("(({ width, height }) => ({ width, height }))(document.querySelector('canvas.picture').getBoundingClientRect())");
      assert.ok(box.height >= 0.5 * height, `the picture is ${box.height} of ${height} pixels high`);
      assert.equal(await page.evaluate("document.documentElement.scrollWidth"), width);
      await page.evaluate("(document.querySelector('.menu').open = true)");
      const cut = await page.evaluate(`[...document.querySelectorAll('button, select, input, output, .unit, canvas, .legend, .tabs, .menu-body')]
        .map((e) => [e, e.getBoundingClientRect()]).filter(([, r]) => r.width > 0 && (r.left < -0.5 || r.right > ${width} + 0.5)).map(([e, r]) => \`\${e.outerHTML.slice(0, 100)} from \${r.left} to \${r.right}\`)`);
      assert.deepEqual(cut, [], `cut off at ${width} pixels`);
      const bar = await page.evaluate("(({ bottom }) => bottom)(document.querySelector('.transport').getBoundingClientRect())");
      assert.ok(bar <= height + 0.5, `the bar of time ends at ${bar} of ${height}`);
      assert.equal(await page.evaluate("(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)(document.querySelector('.time'))"), true, "the time is whole");
      await quiet(page);
    }
  });

  await suite.test("follows a body that leaves its place", async () => {
    // The whole swing goes 1 km along x in 5 s.
    const page = await open("travel"), start = (await state(page)).camera;
    assert.equal(start.follows, "frame");
    const before = await page.evaluate("tisserand.nodePixel(0, 'frame/left')");
    await page.evaluate("tisserand.seek(4)");
    const after = await page.evaluate("tisserand.nodePixel(0, 'frame/left')");
    near([after.x, after.y], [before.x, before.y], 1, "it stays where it is in the picture: 16 bits of a kilometre");
    assert.ok(start.distance < 40, `the first view is of the bodies: ${start.distance} m away`);
    await page.key("o");
    assert.equal((await state(page)).camera.follows, "");
    await page.evaluate("tisserand.seek(0)");
    assert.equal((await page.evaluate("tisserand.nodePixel(0, 'frame/left')")).inside, false, "now the camera stands");
    await quiet(page);
  });

  await suite.test("leaves what has no stress grey, and says where the largest is", async () => {
    const page = await open("beam");
    for (let i = 0; i < 3; ++i) await page.key("c");
    const { legend } = await state(page);
    assert.match(legend.notes.join(" "), /^largest [0-9.e]+ Pa at \(.*\) of the part, 'beam', t = [0-9.]+ s .*recover/);
    await page.evaluate("tisserand.seek(0.4)");
    await page.until("tisserand.quality === 2");
    const box = await corner(page), [left, root] = await page.evaluate("['frame/left', 'beam/root'].map((node) => tisserand.nodePixel(0, node))");
    const picture = decodePng(await page.screenshot()), colour = picture.at(box.left + 0.6 * left.x + 0.4 * root.x, box.top + 0.6 * left.y + 0.4 * root.y);
    assert.ok(Math.max(...colour) - Math.min(...colour) < 25, `the frame is grey: ${colour}`);
    await page.evaluate("(() => { const s = document.querySelector('select[aria-label=\"Unit of stress\"]'); s.value = 'MPa'; s.dispatchEvent(new Event('change')); })()");
    const now = (await state(page)).legend;
    assert.equal(now.title, "von Mises stress [MPa]");
    near([now.range[1]], [1e-6 * legend.range[1]], 1e-9 * legend.range[1], "MPa");
    await quiet(page);
    // kg, mm, s: a unit of stress is a kPa, and MPa are shown.
    const small = await open("beam", { change: (header) => Object.assign(header.runs[0], { pascal: 1000, units: { ...header.runs[0].units, length: "mm", stress: "kg mm^-1 s^-2" } }) });
    for (let i = 0; i < 3; ++i) await small.key("c");
    const millimetres = (await state(small)).legend;
    assert.equal(millimetres.title, "von Mises stress [MPa]");
    near([millimetres.range[1]], [1e-3 * legend.range[1]], 1e-9 * legend.range[1], "kPa to MPa");
    await quiet(small);
  });

  await suite.test("makes deformation visible where nothing else moves", async () => {
    // The beam hangs still and bends by up to 2e-6 m.
    const page = await open("tiny");
    const { settings, panels } = await state(page);
    assert.ok(settings.exaggeration >= 1e3, String(settings.exaggeration));
    assert.match(settings.exaggeration.toExponential(), /^[125]e/);
    assert.match(await page.evaluate("document.querySelector('.grid-step').textContent"), /deformation × /);
    assert.deepEqual(panels[0].paths, ["nodes/position/beam/tip/x"], "only what moves");
    await quiet(page);
  });

  await suite.test("shows the user's channels first", async () => {
    const page = await open("beam", { change: ({ runs: [run] }) => {
      run.references = [];
      run.channels.push({ ...run.channels[0], path: "channels/value/reach", group: "channels" });
    } });
    assert.deepEqual((await state(page)).panels[0].paths, ["channels/value/reach"]);
    await quiet(page);
  });

  await suite.test("has the poles of modes that do not vibrate", async () => {
    const page = await open("modes", { change: (header) => Object.assign(header.runs[0].modes[1], { frequency: 0.162472, damping: 1 }) });
    assert.match(await page.evaluate("document.querySelector('.modes').textContent"), /pole \[1\/s\]/);
    assert.match(await page.evaluate("document.querySelector('.modes').textContent"), /-1\.021/);
    for (let i = 0; i < 4 && (await state(page)).settings.colouring !== "displacement"; ++i) await page.key("c");
    const { legend } = await state(page);
    assert.equal(legend.title, "displacement", "the amplitude of a mode is arbitrary, so that its scale has no unit");
    near([legend.range[1]], [1], 1e-9, "relative to the largest");
    assert.match(legend.notes.join(" "), /the amplitude of a mode is arbitrary/);
    await quiet(page);
  });

  await suite.test("works without WebGL but for the picture", async () => {
    const page = await open("beam", { before: "const own = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return /webgl/.test(kind) ? null : own.call(this, kind, ...rest); };" });
    assert.match(await page.evaluate("document.querySelector('.stage-message').innerText"), /cannot draw the 3-D picture/);
    await page.until("tisserand.curve(0, 0) !== null");
    await page.key("ArrowRight");
    near([await page.evaluate("tisserand.time")], [0.025], 1e-6, "time steps");
    await page.evaluate("document.getElementById('tab-report').click()");
    assert.match(await page.evaluate("document.querySelector('.report').innerText"), /not refined/);
    await page.close();
  });

  await suite.test("names its controls and has contrast", async () => {
    const page = await open("beam");
    for (const theme of ["light", "dark"]) {
      await page.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: theme }] });
      const nameless = await page.evaluate(`[...document.querySelectorAll('button, input, select, [role=separator], canvas.picture')]
        .filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.labels?.[0]?.textContent.trim())).map((e) => e.outerHTML)`);
      assert.deepEqual(nameless, []);
      const colours = await page.evaluate(`Object.fromEntries(['paper', 'ground', 'stage', 'ink', 'ink-2', 'accent', 'accent-ink', 'warn', 'warn-ground', 'hover']
        .map((name) => [name, getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim()]))`);
      const luminance = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
        .reduce((sum, c, i) => sum + [0.2126, 0.7152, 0.0722][i] * c, 0);
      for (const [a, b] of [["ink", "paper"], ["ink-2", "paper"], ["ink-2", "stage"], ["ink-2", "ground"], ["ink-2", "hover"], ["accent", "paper"], ["accent-ink", "accent"], ["warn", "warn-ground"]]) {
        const [low, high] = [luminance(colours[a]), luminance(colours[b])].sort((x, y) => x - y);
        assert.ok((high + 0.05) / (low + 0.05) >= 4.5, `${theme}, ${a} on ${b}: ${((high + 0.05) / (low + 0.05)).toFixed(2)} (WCAG AA asks 4.5)`);
      }
      await page.until("document.querySelector('.curve-legend .mark') !== null");
      // Panels are built anew after the theme has changed.
      await page.until(`(getComputedStyle(document.querySelector('.curve-legend .mark')).color === "rgb(0, 114, 178)") === ${theme === "light"}`, 30000);
      const line = await page.evaluate("getComputedStyle(document.querySelector('.curve-legend .mark')).color.match(/\\d+/g).slice(0, 3).map((c) => Number(c).toString(16).padStart(2, '0')).join('')");
      const [dim, bright] = [luminance(`#${line}`), luminance(colours.paper)].sort((x, y) => x - y);
      assert.ok((bright + 0.05) / (dim + 0.05) >= 4.5, `${theme}, first curve #${line}`);
      assert.equal(colours.paper, { light: "#ffffff", dark: "#15181c" }[theme], "the page follows the system");
    }
    await quiet(page);
  });
});
