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
  grid: boolean;
  worldAxes: boolean;
  bodyAxes: boolean;
  nodes: boolean;
  names: boolean;
  joints: boolean;
  springs: boolean;
  arrows: boolean;
  parallel: boolean;
}

export const INITIAL: Settings = {
  colouring: "body",
  map: "viridis",
  exaggeration: 1,
  arrowScale: 1,
  glyphScale: 1,
  edges: true,
  grid: true,
  worldAxes: false,
  bodyAxes: false,
  nodes: false,
  names: false,
  joints: true,
  springs: true,
  arrows: true,
  parallel: false,
};

export type Switch = { [K in keyof Settings]: Settings[K] extends boolean ? K : never }[keyof Settings];
