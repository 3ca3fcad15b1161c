// SPDX-License-Identifier: GPL-3.0-or-later
// Pages that `mechanism view` wrote, in a real browser: what they show against the results file, as `mechanism export` tells it.
// Arguments: folder of the programs, source folder. Ends with 77 where node, Chromium or `reducer` is missing.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { Browser, CHROMIUM } from "./browser.mjs";
import { corner, differ, near, quiet } from "./checks.mjs";
import { decodePng } from "./png.mjs";

const [bin, source] = process.argv.slice(2);
if (!CHROMIUM || !existsSync(join(bin, "reducer"))) {
  process.stdout.write(CHROMIUM ? "not tested: there is no reducer here\n" : "not tested: there is no chromium here (apt-get install chromium)\n");
  process.exit(77);
}

const folder = mkdtempSync(join(tmpdir(), "tisserand-pages-")), file = (name) => join(folder, name);
let browser;

const call = (program, ...words) => execFileSync(join(bin, program), words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, OPENBLAS_NUM_THREADS: "1" } });

/** The shell and beam of an example, or another part, with its recovery file. */
const reduce = (part, name) => call("reducer", "run", join(source, "examples", part), "--set", "recovery=yes", "-o", `${name}.superelement.h5`);

/** Runs a scene and opens its page. */
async function open(scene, name, ...settings) {
  call("mechanism", "run", scene, "-o", `${name}.results.h5`, ...settings);
  call("mechanism", "view", `${name}.results.h5`);
  const page = await browser.page();
  await page.open(file(`${name}.html`));
  assert.equal(await page.evaluate("tisserand.failure"), null);
  return page;
}

/** Columns of a results file by channel, without units. */
function columns(name, ...channels) {
  call("mechanism", "export", `${name}.results.h5`, ...channels.flatMap((channel) => ["-c", channel]), "-o", `${name}.csv`);
  const [heads, ...rows] = readFileSync(file(`${name}.csv`), "utf8").trim().split(/\r?\n/).map((line) => line.split(","));
  return Object.fromEntries(heads.map((head, i) => [head.replace(/ \[.*\]$/, ""), rows.map((row) => Number(row[i]))]));
}

const nodesOf = (table, quantity) => [...new Set(Object.keys(table).filter((key) => key.startsWith(quantity)).map((key) => key.slice(quantity.length + 1).replace(/\/[xyz](\/.*)?$/, "")))];

/** All nodes at rows and between them, where positions are linear: within 1e-4 of the size of the motion. */
async function motionIsThatOfTheResults(page, name) {
  const table = columns(name, "nodes/position"), time = table.time, nodes = nodesOf(table, "nodes/position");
  const at = (node, row) => [..."xyz"].map((axis) => table[`nodes/position/${node}/${axis}`][row]);
  const all = nodes.flatMap((node) => time.map((_, row) => at(node, row))).flat(), size = Math.max(...all) - Math.min(...all);
  assert.ok(nodes.length >= 2 && size > 0);
  for (const share of [0, 0.3, 0.57, 1]) {
    const place = share * (time.length - 1), row = Math.min(Math.floor(place), Math.max(0, time.length - 2)), s = time.length > 1 ? place - row : 0;
    const t = time.length > 1 ? time[row] + s * (time[row + 1] - time[row]) : time[0];
    const shown = await page.evaluate(`${JSON.stringify(nodes)}.map((node) => tisserand.nodePosition(0, node, ${t}))`);
    for (const [i, node] of nodes.entries()) {
      const before = at(node, row), after = at(node, Math.min(row + 1, time.length - 1));
      near(shown[i], before.map((x, c) => x + s * (after[c] - x)), 1e-4 * size, `${node} at t = ${t}`);
    }
  }
}

/** The body covers the points between two of its nodes in the picture, and a click there finds it. */
async function bodyIsDrawnThere(page, body, a, b) {
  await page.until("tisserand.quality === 2");
  const box = await corner(page), [from, to] = await page.evaluate(`[${JSON.stringify(a)}, ${JSON.stringify(b)}].map((node) => tisserand.nodePixel(0, node))`);
  const picture = decodePng(await page.screenshot()), ground = picture.at(box.left + 6, box.top + 6);
  for (const s of [0.3, 0.5, 0.8]) {
    const x = from.x + s * (to.x - from.x), y = from.y + s * (to.y - from.y);
    assert.ok(differ(picture.at(box.left + x, box.top + y), ground) > 40, `${body} at ${s} between ${a} and ${b}`);
    assert.equal((await page.evaluate(`tisserand.pick(${x}, ${y})`))?.body, body);
  }
}

test("pages of the program", async (suite) => {
  browser = await Browser.start();
  suite.after(async () => {
    await browser.stop();
    rmSync(folder, { recursive: true, force: true });
  });

  await suite.test("a beam on a hinge with its mesh", async () => {
    reduce("hinged_beam/beam.part.yaml", "beam");
    const page = await open(join(source, "examples/hinged_beam/floating_a.scene.yaml"), "hinged", "--set", `bodies.beam.file=${file("beam.superelement.h5")}`, "--set", "integrator.end=8");
    await motionIsThatOfTheResults(page, "hinged");
    for (const t of [0, 8]) {
      await page.evaluate(`tisserand.seek(${t})`);
      await bodyIsDrawnThere(page, "beam", "beam/base", "beam/tip");
    }
    // The mesh follows its coordinates: the end of the surface stays at the node, which the results hold on their own.
    assert.ok((await page.evaluate("tisserand.vertices")) > 100);
    await quiet(page);
  });

  await suite.test("an arm of rigid links", async () => {
    writeFileSync(file("arm.yaml"), `scene: arm
gravity: [0, 0, -9.81]
bodies:
  column: {type: rigid, mass: 20, inertia: [1, 1, 0.5], nodes: {top: {position: [0, 0, 0.8]}}, shape: {type: cylinder, from: [0, 0, 0], to: [0, 0, 0.8], radius: 0.12}}
  upper: {type: rigid, mass: 8, inertia: [0.2, 0.4, 0.4], pose: {position: [0.3, 0, 0.8]}, nodes: {elbow: {position: [0.3, 0, 0]}}, shape: {type: box, size: [0.6, 0.1, 0.12]}}
  lower: {type: rigid, mass: 4, inertia: [0.1, 0.2, 0.2], pose: {position: [0.85, 0, 0.8]}, nodes: {hand: {position: [0.25, 0, 0]}}, shape: {type: tube, points: [[-0.25, 0, 0], [0.25, 0, 0]], radius: 0.04}}
joints:
  turn: {type: revolute, a: ground, b: column, axis: [0, 0, 1]}
  shoulder: {type: revolute, a: column/top, b: upper, axis: [0, 1, 0], position: [0, 0, 0.8]}
  elbow: {type: revolute, a: upper/elbow, b: lower, axis: [0, 1, 0], position: [0.6, 0, 0.8]}
motions:
  turn: {coordinate: turn, value: "0.8 * t^2"}
  shoulder: {coordinate: shoulder, value: "-0.6 * sin(2 * t)"}
  elbow: {coordinate: elbow, value: "1.2 * sin(3 * t)"}
integrator: {step: 0.01, end: 1.5}
`);
    const page = await open("arm.yaml", "arm");
    await motionIsThatOfTheResults(page, "arm");
    for (const t of [0, 0.5, 1.5]) {
      await page.evaluate(`tisserand.seek(${t})`);
      await bodyIsDrawnThere(page, "lower", "lower", "lower/hand");
      await bodyIsDrawnThere(page, "upper", "upper", "upper/elbow");
    }
    await quiet(page);
  });

  await suite.test("a car with its tyres on their road", async () => {
    call("mechanism", "run", join(source, "examples/vehicle/car.scene.yaml"), "-o", "car.results.h5", "--set", "integrator.end=1");
    const name = "car.drive";
    call("mechanism", "view", `${name}.results.h5`);
    const page = await browser.page();
    await page.open(file(`${name}.html`));
    assert.equal(await page.evaluate("tisserand.failure"), null);
    await motionIsThatOfTheResults(page, name);
    assert.equal((await state(page)).camera.follows, "chassis");
    assert.deepEqual((await state(page)).panels[0].paths.map((path) => path.slice(-2)), ["/x"], "the curve of what moves most");
    await page.evaluate("tisserand.seek(0.9)");
    await page.until("tisserand.quality === 2");
    const seen = new Set();
    const { width, height } = await page.evaluate("(({ clientWidth, clientHeight }) => ({ width: clientWidth, height: clientHeight }))(document.querySelector('canvas.picture'))");
    for (let i = 1; i < 24; ++i)
      for (let k = 1; k < 16; ++k) {
        const picked = await page.evaluate(`tisserand.pick(${(i * width) / 24}, ${(k * height) / 16})`);
        if (picked) seen.add(picked.body);
      }
    assert.ok([...seen].some((body) => /road|ground|track/.test(body)), [...seen].join());
    // The car fills the picture, not the road.
    const [front, rear] = await page.evaluate("['front_left/wheel', 'rear_left/wheel'].map((node) => tisserand.nodePixel(0, node))");
    assert.ok(Math.hypot(front.x - rear.x, front.y - rear.y) > 0.2 * width, "wheels apart in the picture");
    await page.key("m");
    await page.until("[...document.querySelectorAll('.labels span')].some((label) => !label.hidden && label.textContent.includes('chassis'))");
    await quiet(page);
  });

  await suite.test("a chassis with its mesh, coloured by stress", async () => {
    reduce("chassis/chassis.part.yaml", "chassis");
    const corners = ["front_lower_l", "front_lower_r", "rear_arm_l", "rear_arm_r"];
    writeFileSync(file("drop.yaml"), `scene: chassis on four bushings
units: {length: m, mass: kg, time: s}
gravity: [0, 0, -9.81]
bodies:
  chassis: {type: superelement, file: chassis.superelement.h5, second_order: off, damping: {ratio: 0.05}}
bushings:
${corners.map((corner) => `  at_${corner}: {a: ground, b: chassis/${corner}, stiffness: [1e5, 1e5, 1e5, 0, 0, 0], damping: [1e3, 1e3, 1e3, 0, 0, 0]}`).join("\n")}
integrator: {step: 0.002, end: 0.3}
`);
    call("mechanism", "run", "drop.yaml", "-o", "drop.results.h5");
    call("mechanism", "view", "drop.results.h5", "--stress");
    const page = await browser.page();
    await page.open(file("drop.html"));
    assert.equal(await page.evaluate("tisserand.failure"), null);
    await motionIsThatOfTheResults(page, "drop");
    await page.evaluate("tisserand.seek(0.3)");
    for (let i = 0; i < 4 && (await state(page)).settings.colouring !== "stress"; ++i) await page.key("c");
    const { legend, settings } = await state(page);
    assert.equal(settings.colouring, "stress");
    assert.equal(legend.title, "von Mises stress [Pa]");
    // What `reducer recover` finds at the nodes of the same run, the worst of both faces: the page shows one face at 60 instants.
    const found = call("reducer", "recover", "chassis.recovery.h5", "drop.results.h5", "-o", "recovered").toString();
    const worst = Math.max(...[...found.matchAll(/largest (?:stress of beams|von Mises of shells) +([0-9.e+-]+)/g)].map((match) => Number(match[1])));
    assert.ok(legend.range[1] > 0.5 * worst && legend.range[1] < 1.05 * worst, `${legend.range[1]} on the page, ${worst} recovered: ${found}`);
    await quiet(page);
  });

  await suite.test("a weight on a bracket, exaggerated, and a picture of nothing", async () => {
    const trials = join(source, "tests/verification/references/trials"), root = process.getuid?.() === 0 ? ["--no-sandbox"] : [];
    for (const name of ["bracket.part.yaml", "arm_exaggerated.scene.yaml"]) writeFileSync(file(name), readFileSync(join(trials, name)));
    call("reducer", "run", "bracket.part.yaml");
    call("mechanism", "run", "arm_exaggerated.scene.yaml");
    const draw = (...words) => call("mechanism", "picture", "arm_exaggerated.results.h5", "--time", "0.005", "-o", "arm.png", ...root, ...words);
    // Pixels of the bracket (blue) and of the weight (orange): they fill the picture, exaggerated or not.
    for (const words of [["--exaggerate", "1"], ["--exaggerate", "100"], ["--exaggerate", "100", "--hide", "joints"]]) {
      draw(...words);
      const picture = decodePng(readFileSync(file("arm.png"))), count = { bracket: 0, weight: 0 };
      for (let x = 0; x < picture.width; x += 4)
        for (let y = 0; y < picture.height; y += 4) {
          const [r, , b] = picture.at(x, y);
          if (b > r + 40) ++count.bracket;
          if (r > b + 40) ++count.weight;
        }
      assert.ok(16 * count.bracket > 0.02 * 1200 * 700 && 16 * count.weight > 2000, `${words}: ${JSON.stringify(count)}`);
    }
    assert.throws(() => draw("--view", "front", "--zoom", "20", "--hide", "joints"), /the picture would be empty/);
    call("mechanism", "view", "arm_exaggerated.results.h5", "--stress");
    const page = await browser.page();
    await page.open(file("arm_exaggerated.html"));
    for (let i = 0; i < 4 && (await state(page)).settings.colouring !== "stress"; ++i) await page.key("c");
    const { legend } = await state(page), found = call("reducer", "recover", "bracket.recovery.h5", "arm_exaggerated.results.h5", "-o", "recovered").toString();
    const [, worst, when] = /largest von Mises of shells +([0-9.e+-]+) Pa at ([0-9.]+) s/.exec(found).map(Number);
    // `recover` has single elements, the page means of them at nodes: the legend says so.
    assert.ok(legend.range[1] > 0.95 * worst && legend.range[1] <= worst, `${legend.range[1]} on the page, ${worst} recovered`);
    assert.match(legend.notes.join(" "), new RegExp(`'bracket', t = ${when} s .*recover.*may be larger`));
    await page.evaluate("tisserand.seek(0.005)");
    await page.until("tisserand.quality === 2");
    const box = await corner(page), at = await page.evaluate("tisserand.nodePixel(0, 'weight')"), colour = decodePng(await page.screenshot()).at(box.left + at.x, box.top + at.y);
    assert.ok(Math.max(...colour) - Math.min(...colour) < 25, `the weight is grey: ${colour}`);
    await quiet(page);
  });

  await suite.test("a mesh with the edges of its elements", async () => {
    call("reducer", "view", "bracket.part.yaml");
    const page = await browser.page();
    await page.open(file("bracket.part.html"));
    assert.deepEqual(await page.evaluate("[...document.querySelectorAll('[role=tab]')].map((tab) => tab.textContent)"), ["Mesh", "Groups"]);
    assert.equal(await page.evaluate("document.querySelector('.transport').hidden"), true, "nothing plays");
    await page.until("tisserand.quality === 2");
    const before = decodePng(await page.screenshot());
    await page.key("d");
    await page.until("tisserand.state.settings.elements && tisserand.quality === 2");
    const after = decodePng(await page.screenshot()), box = await corner(page);
    let changed = 0;
    for (let x = 0; x < 700; ++x) for (let y = 0; y < 500; ++y) if (differ(before.at(box.left + x, box.top + y), after.at(box.left + x, box.top + y)) > 20) ++changed;
    assert.ok(changed > 1000, `${changed} pixels of edges`);
    await quiet(page);
  });

  await suite.test("a geometry with the numbers of its faces", async () => {
    call("reducer", "view", join(source, "meshes/bracket.step"), "-o", "bracket.html");
    const page = await browser.page();
    await page.open(file("bracket.html"));
    assert.equal(await page.evaluate("tisserand.failure"), null);
    const shown = () => page.evaluate("[...document.querySelectorAll('.labels span')].filter((label) => !label.hidden).map((label) => label.textContent).sort()");
    await page.until("document.querySelectorAll('.labels span').length > 0");
    // A block with a hole has seven faces; of the outer ones three are seen from any side, and the opposite three from there.
    const seen = [];
    for (const key of ["1", "2", "3", "4", "5", "6", "7"]) {
      await page.key(key);
      await page.evaluate("new Promise((done) => setTimeout(() => requestAnimationFrame(done), 300))");
      seen.push(await shown());
      assert.ok(seen.at(-1).length < 7, seen.at(-1).join());
    }
    assert.deepEqual([...new Set(seen.flat())].sort(), [1, 2, 3, 4, 5, 6, 7].map((face) => `face ${face}`));
    await quiet(page);
  });

  await suite.test("modes of a plate with its mesh", async () => {
    reduce("stiffened_plate/plate.part.yaml", "plate");
    const page = await open(join(source, "examples/stiffened_plate/plate.scene.yaml"), "plate", "--set", `bodies.plate.file=${file("plate.superelement.h5")}`);
    await page.until("tisserand.state.mode !== null && tisserand.state.phase > 0.1");
    await page.key(" ");
    const table = columns("plate", "modes/translation"), nodes = nodesOf(table, "modes/translation");
    for (const mode of [0, 4]) {
      await page.evaluate(`document.querySelectorAll('.modes tbody button')[${mode}].click()`);
      await page.until(`tisserand.state.mode.index === ${mode} && tisserand.state.phase > 0.2`);
      await page.key(" ");
      // A slow machine moves by eighths of a cycle: at a quarter the real part is nothing.
      while (Math.abs(Math.cos((await state(page)).phase)) < 0.1) await page.key("ArrowRight");
      const phase = (await state(page)).phase, list = JSON.stringify(nodes);
      const moved = await page.evaluate(`${list}.map((node) => tisserand.nodeDrawn(0, node).map((x, c) => x - tisserand.nodePosition(0, node, 0)[c]))`);
      const shape = nodes.map((node) => [..."xyz"].map((axis) => {
        const [re, im] = ["real", "imaginary"].map((part) => table[`modes/translation/${node}/${axis}/${part}`][mode]);
        return re * Math.cos(phase) - im * Math.sin(phase);
      }));
      // One factor for all nodes: that of least squares; the rest is the error of the stored shapes, 1e-3.
      const dot = (a, b) => a.flat().reduce((sum, x, i) => sum + x * b.flat()[i], 0), factor = dot(moved, shape) / dot(shape, shape);
      const largest = Math.max(...moved.flat().map(Math.abs));
      assert.ok(largest > 0 && factor > 0);
      for (const [i, node] of nodes.entries()) near(moved[i], shape[i].map((x) => factor * x), 2e-3 * largest, `${node} in mode ${mode + 1}`);
    }
    await quiet(page);
  });
});

const state = (page) => page.evaluate("tisserand.state");
