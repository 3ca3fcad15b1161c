// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a page: the types of the data contract (formats/PAGE.md), as read from JSON.

export interface ArrayEntry {
  block: number;
  at?: number;
  type: "i16" | "u16" | "u32" | "f32" | "u8";
  shape: number[];
  packed?: boolean;
  scale?: number | number[];
  offset?: number | number[];
  scaled?: "first" | "last" | "all";
}

export type Vector3 = [number, number, number];

/** Where something sits: fixed in a body, fixed in the world, or a history of its own. */
export interface PlaceEntry {
  body?: number;
  point?: Vector3;
  rotation?: [number, number, number, number] | ArrayEntry;
  position?: ArrayEntry;
  rest?: Vector3 | null;
  /** From the node at `rest` to the place, in axes of the place: a rigid arm, which keeps its length. */
  arm?: Vector3;
}

export interface BodyEntry {
  name: string;
  kind: string;
  shape: number | null;
  position: ArrayEntry;
  rotation: ArrayEntry;
  amplitudes: ArrayEntry | null;
  mass: number | null;
  /** #rrggbb in place of one of the page's own. */
  colour?: string;
}

export interface StressEntry {
  quantity: string;
  modes: ArrayEntry;
  /** The largest at any vertex and instant: its value, place in axes of the part, and instant. */
  largest?: { value: number; place: Vector3; time: number } | null;
}

export interface ShapeEntry {
  vertices: ArrayEntry;
  triangles: ArrayEntry | null;
  lines: ArrayEntry | null;
  /** Element of each triangle. */
  elements?: ArrayEntry | null;
  points?: boolean;
  modes: ArrayEntry | null;
  stress?: StressEntry | null;
  largest?: number | null;
  error?: number | null;
  source?: string;
  thinned?: { vertices: number; kept: number } | null;
}

export interface NodeEntry {
  name: string;
  body: number;
  place: PlaceEntry;
  also?: string[];
}

export interface JointEntry {
  name: string;
  kind: string;
  bodies: (number | null)[];
  place: PlaceEntry;
  coordinates?: number[];
}

export interface SpringEntry {
  name: string;
  kind: string;
  ends: [PlaceEntry, PlaceEntry];
  channels?: number[];
}

export interface ArrowEntry {
  name: string;
  kind: string;
  place: PlaceEntry;
  channels: number[];
  axes?: "world" | "place";
}

export interface ChannelEntry {
  path: string;
  unit: string;
  values: ArrayEntry;
  times?: ArrayEntry;
  group?: string;
}

export interface ReferenceEntry {
  name: string;
  channel: string;
  x: ArrayEntry;
  y: ArrayEntry;
}

export interface ModeEntry {
  /** In place of its number. */
  name?: string;
  frequency: number | null;
  damping: number | null;
  bodies: { body: number; translation: number[][]; rotation: number[][]; amplitudes?: number[][] | null }[];
}

export interface ReportEntry {
  notes?: string[];
  doubts?: string[];
  lines?: [string, string][];
  phases?: [string, number][];
  energy?: Record<string, number>;
  steps?: number | null;
  effects?: [string, string][];
}

export interface RunEntry {
  name: string;
  file?: string;
  kind: string;
  completed?: boolean;
  reason?: string;
  units: Record<string, string>;
  up: Vector3;
  gravity?: Vector3 | null;
  times: ArrayEntry;
  thinned?: { rows: number; kept: number } | null;
  box: [Vector3, Vector3];
  /** What moves: box over all instants, largest diagonal at one of them, and the body that a camera follows. */
  moving?: { box: [Vector3, Vector3]; size: number; follow: number | null };
  /** Pascal in a unit of stress; absent: unnamed units. */
  pascal?: number;
  bodies: BodyEntry[];
  shapes: ShapeEntry[];
  nodes: NodeEntry[];
  nodes_left_out?: number;
  joints: JointEntry[];
  springs: SpringEntry[];
  arrows: ArrowEntry[];
  channels: ChannelEntry[];
  channels_left_out?: { count: number; why: string } | null;
  references: ReferenceEntry[];
  modes: ModeEntry[] | null;
  report: ReportEntry;
  scene?: string | null;
}

export interface Header {
  format: string;
  version: number;
  title: string;
  program: string;
  runs: RunEntry[];
  blocks: [number, number][];
}
