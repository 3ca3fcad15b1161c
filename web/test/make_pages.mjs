// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the synthetic pages into a folder, to look at: node test/make_pages.mjs dist/view.html folder [scene...]
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { SCENES, sceneBlocks } from "./scenes.mjs";
import { pageOf } from "./writer.mjs";

const [viewer, folder, ...names] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
for (const name of names.length > 0 ? names : Object.keys(SCENES)) {
  const { header, blocks } = sceneBlocks(name), html = pageOf(readFileSync(viewer, "utf8"), header, blocks);
  writeFileSync(join(folder, `${name}.html`), html);
  process.stdout.write(`${name}.html ${(html.length / 1e6).toFixed(2)} MB\n`);
}
