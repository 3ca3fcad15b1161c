// SPDX-License-Identifier: GPL-3.0-or-later
// Measures opening and playing of the synthetic pages `crowd` (1000 bodies, 2000 instants) and `fine` (20 000 vertices, 8 modes):
// node web/test/measure.mjs [viewer]. Processor time counts all processes of the browser, so it holds on a busy machine too.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser } from "./browser.mjs";
import { sceneBlocks } from "./scenes.mjs";
import { pageOf } from "./writer.mjs";

const SECONDS = 4, PICTURES = 40;
const viewer = readFileSync(process.argv[2] ?? join(dirname(fileURLToPath(import.meta.url)), "..", "dist", "view.html"), "utf8");
const folder = mkdtempSync(join(tmpdir(), "tisserand-pages-")), browser = await Browser.start();
const processes = async () => new Map((await browser.send("SystemInfo.getProcessInfo")).processInfo.map(({ id, cpuTime }) => [id, cpuTime]));
/** Processor time [s] since `before` of the processes that there are. */
const since = async (before) => [...(await processes())].reduce((sum, [id, time]) => sum + time - (before.get(id) ?? 0), 0);
/** Processor time of a picture [s] at one pixel drawn for each of the screen, whatever the load of the machine. */
async function allPixels(page) {
  const show = `new Promise((done) => { let i = 0; const next = () => { tisserand.seek(0.02 * i++); if (i < ${PICTURES}) requestAnimationFrame(next); else done(); }; next(); })`;
  await page.evaluate(show);
  const start = await processes();
  await page.evaluate(show);
  return (await since(start)) / PICTURES;
}

try {
  process.stdout.write(`viewer ${viewer.length} bytes\n`);
  for (const name of ["crowd", "fine"]) {
    const { header, blocks } = sceneBlocks(name), file = join(folder, `${name}.html`), html = pageOf(viewer, header, blocks);
    writeFileSync(file, html);
    const page = await browser.page();
    const before = await processes();
    await page.open(file);
    const opened = await since(before);
    const whole = await allPixels(page);
    await page.evaluate("tisserand.seek(0)");
    await page.key(" ");
    await new Promise((resolve) => setTimeout(resolve, 1500));
    const [first, start, clock] = [await page.evaluate("tisserand.pictures"), await processes(), Date.now()];
    await new Promise((resolve) => setTimeout(resolve, 1000 * SECONDS));
    const [last, spent, elapsed] = [await page.evaluate("tisserand.pictures"), await since(start), (Date.now() - clock) / 1000];
    const told = await page.evaluate("({opened: tisserand.openedAfter, vertices: tisserand.vertices, quality: tisserand.quality, bodies: tisserand.bodies})");
    process.stdout.write(`${name}: ${(html.length / 1e6).toFixed(2)} MB, ${told.bodies} bodies, ${told.vertices} vertices drawn; opened after ${(told.opened / 1000).toFixed(2)} s`
      + ` (${opened.toFixed(2)} s of processor time); ${((last - first) / elapsed).toFixed(1)} pictures/s at quality ${told.quality},`
      + ` ${((1000 * spent) / (last - first)).toFixed(0)} ms of processor time a picture, ${(1000 * whole).toFixed(0)} with all pixels\n`);
    await page.close();
  }
} finally {
  await browser.stop();
  rmSync(folder, { recursive: true, force: true });
}
