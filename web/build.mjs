// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the viewer into one HTML file: script, style and licences inlined, both named in the policy of the page by their hashes.
// Arguments: file to write (dist/view.html), and beside it LICENSES. scripts/bundle_viewer calls it.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const read = (...path) => readFileSync(join(here, ...path), "utf8");

/** Packages whose code is in the bundle. */
function bundled(metafile) {
  const names = new Set();
  for (const output of Object.values(metafile.outputs))
    for (const [input, { bytesInOutput }] of Object.entries(output.inputs)) {
      const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
      if (found && bytesInOutput > 0) names.add(found[1]);
    }
  return [...names].sort();
}

function licences(packages) {
  const parts = packages.map((name) => {
    const { version, license } = JSON.parse(read("node_modules", name, "package.json"));
    return `${name} ${version} (${license})\n\n${read("node_modules", name, "LICENSE").trim()}\n`;
  });
  const own = "Tisserand viewer: GPL-3.0-or-later, the authors of Tisserand. Its source is the folder web/ of Tisserand.\n";
  return [own, "The page contains, minified:\n", ...parts].join("\n");
}

const hash = (text) => `sha256-${createHash("sha256").update(text, "utf8").digest("base64")}`;

const options = { absWorkingDir: here, bundle: true, minify: true, write: false, metafile: true, charset: "ascii", legalComments: "none" };
const script = await build({ ...options, entryPoints: ["src/main.ts"], format: "iife", target: ["chrome100", "firefox113", "safari16.4"] });
const style = await build({ ...options, stdin: { contents: '@import "uplot/dist/uPlot.min.css"; @import "./src/style.css";', resolveDir: here, loader: "css" } });

const text = (result) => result.outputFiles[0].text.trim();
const code = text(script).replaceAll("</script", "<\\/script");
const notices = licences(bundled(script.metafile));
if (notices.includes("</")) throw new Error("a licence holds markup");
const parts = { style: text(style), script: code, licences: notices, "style-hash": hash(text(style)), "script-hash": hash(code) };
const html = read("src", "page.html").replace(/\{(style|script|licences|style-hash|script-hash)\}/g, (_, name) => parts[name]);

const target = process.argv[2] ?? join(here, "dist", "view.html");
mkdirSync(dirname(target), { recursive: true });
writeFileSync(target, html);
writeFileSync(join(dirname(target), "LICENSES"), notices);
process.stdout.write(`${target}: ${html.length} bytes, of which script ${code.length}, from ${bundled(script.metafile).join(", ")}\n`);
