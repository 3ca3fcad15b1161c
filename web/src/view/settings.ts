// SPDX-License-Identifier: GPL-3.0-or-later
// What the picture shows: one object, changed by controls and keys.
import type { MapName } from "./colours";

export type Colouring = "body" | "deformation" | "displacement" | "stress";
export const COLOURINGS: Colouring[] = ["body", "deformation", "displacement", "stress"];

export interface Settings {
  colouring: Colouring;
  map: MapName;
  exaggeration: number;
  arrowScale: number;
  glyphScale: number;
  edges: boolean;
  elements: boolean;
  grid: boolean;
  worldAxes: boolean;
  bodyAxes: boolean;
  nodes: boolean;
  names: boolean;
  joints: boolean;
  springs: boolean;
  arrows: boolean;
  parallel: boolean;
  /** Name of the body that the camera follows; empty: it stands. */
  follow: string;
  /** Unit in which stress is shown: Pa, kPa, MPa, GPa; empty: that of the run. */
  stressUnit: string;
}

/** Pascal in each. */
export const STRESS_UNITS: Record<string, number> = { Pa: 1, kPa: 1e3, MPa: 1e6, GPa: 1e9 };

export const INITIAL: Settings = {
  colouring: "body",
  map: "viridis",
  exaggeration: 1,
  arrowScale: 1,
  glyphScale: 1,
  edges: true,
  elements: false,
  grid: true,
  worldAxes: false,
  bodyAxes: false,
  nodes: false,
  names: false,
  joints: true,
  springs: true,
  arrows: true,
  parallel: false,
  follow: "",
  stressUnit: "",
};

export type Switch = { [K in keyof Settings]: Settings[K] extends boolean ? K : never }[keyof Settings];
