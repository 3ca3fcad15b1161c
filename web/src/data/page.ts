// SPDX-License-Identifier: GPL-3.0-or-later
// The two data elements of the page -> header and runs.
import { Blocks } from "./blocks";
import { Failure, require, WRITE_AGAIN } from "./failure";
import type { Header } from "./header";
import { Run } from "./run";

const VERSION = 1;

function textOf(id: string): string {
  const element = document.getElementById(id);
  if (!element)
    throw new Failure("This page holds no results: it is the empty viewer.", "Fill it with `mechanism view run.results.h5 -o run.html`.");
  return element.textContent ?? "";
}

function headerOf(text: string): Header {
  let header: Header;
  try {
    header = JSON.parse(text) as Header;
  } catch {
    throw new Failure("The header of this page is damaged: it is not JSON.", WRITE_AGAIN);
  }
  require(header !== null && typeof header === "object" && header.format === "tisserand-page", "The header is not that of a Tisserand page.");
  if (header.version !== VERSION)
    throw new Failure(`The data of this page have version ${String(header.version)}, but its viewer reads version ${VERSION}.`, WRITE_AGAIN);
  require(Array.isArray(header.blocks), "The header has no list of blocks.");
  require(Array.isArray(header.runs) && header.runs.length > 0, "The page holds no run.");
  for (const run of header.runs) {
    for (const list of ["bodies", "shapes", "nodes", "joints", "springs", "arrows", "channels", "references"] as const)
      require(Array.isArray(run[list]), `The header of run '${String(run.name)}' has no list '${list}'.`);
    run.units ??= {};
    run.report ??= {};
    run.up ??= [0, 0, 1];
    const isPoint = (p: unknown): boolean => Array.isArray(p) && p.length === 3 && p.every((x) => Number.isFinite(x));
    require(Array.isArray(run.box) && run.box.every(isPoint), `The header of run '${String(run.name)}' has no box.`);
  }
  return header;
}

export interface Page {
  header: Header;
  runs: Run[];
}

export async function readPage(): Promise<Page> {
  const header = headerOf(textOf("tisserand-header"));
  const blocks = new Blocks(textOf("tisserand-blocks"), header.blocks);
  const runs = header.runs.map((entry, i) => new Run(entry, i, blocks));
  for (const run of runs) await run.load();
  return { header, runs };
}
