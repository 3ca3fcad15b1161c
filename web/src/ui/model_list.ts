// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies, nodes and joints as a list: what a click in the picture chooses can be chosen here by keyboard.
import { button, h } from "./dom";
import { number } from "./numbers";
import type { Run } from "../data/run";
import type { Picked } from "../view/viewport";

const MOST = 300;

export function modelList(runs: Run[], choose: (picked: Picked) => void): HTMLElement {
  const list = h("div", { class: "model-list" });
  const search = h("input", { type: "search", placeholder: "Search bodies, nodes, joints", "aria-label": "Search bodies, nodes and joints", oninput: () => draw() });
  const draw = (): void => {
    const word = search.value.toLowerCase();
    list.replaceChildren(...runs.flatMap((run) => sections(run, word, choose, runs.length > 1)));
  };
  draw();
  return h("div", { class: "pad" }, search, list);
}

function sections(run: Run, word: string, choose: (picked: Picked) => void, many: boolean): HTMLElement[] {
  const section = (title: string, rows: { name: string; remark: string; pick: Picked | null }[], left = 0): HTMLElement | null => {
    const found = rows.filter((row) => row.name.toLowerCase().includes(word));
    if (found.length === 0) return null;
    const items = found.slice(0, MOST).map((row) => h("li", {},
      row.pick ? button(row.name, `Choose ${row.name}`, () => choose(row.pick!), { class: "link" }) : h("span", { class: "name" }, row.name),
      h("span", { class: "remark" }, row.remark)));
    const more = found.length > MOST ? `${found.length - MOST} more: use the search. ` : "";
    return h("details", { open: rows.length <= 40 || word !== "" }, h("summary", {}, `${title} (${found.length})`), h("ul", { class: "plain" }, ...items),
      h("p", { class: "remark" }, more + (left > 0 ? `${left} nodes are not in this page.` : "")));
  };
  const shapes = (b: number): string => {
    const body = run.bodies[b]!, shape = body.shape === null ? null : run.shapes[body.shape]!;
    const thinned = shape?.thinned ? `, ${shape.thinned.kept} of ${shape.thinned.vertices} vertices` : "";
    const error = shape?.error ? `, error of its deformation ${number(shape.error, 2)} ${run.unit("length")}` : "";
    return `${body.kind}${shape?.source ? `, shape from ${shape.source}` : ""}${thinned}${error}`;
  };
  return [
    many ? h("h3", {}, run.name) : null,
    section("Bodies", run.bodies.map((body, b) => ({ name: body.name, remark: shapes(b), pick: { run, body: b, node: null } }))),
    section("Nodes", run.nodes.map((node, n) => ({
      name: node.name, remark: (node.also ?? []).join(", "), pick: { run, body: node.body, node: n },
    })), run.entry.nodes_left_out ?? 0),
    section("Joints", run.joints.map((joint) => ({
      name: joint.name, pick: null,
      remark: `${joint.kind}: ${joint.bodies.map((b) => (b === null ? "ground" : run.bodies[b]?.name ?? "-")).join(" and ")}`,
    }))),
    section("Springs", run.springs.map((spring) => ({ name: spring.name, remark: spring.kind, pick: null }))),
  ].filter((element) => element !== null);
}
