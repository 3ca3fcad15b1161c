// SPDX-License-Identifier: GPL-3.0-or-later
// Materials over the shaders; uniforms that all share are one object.
import { DataTexture, DoubleSide, GLSL3, LinearFilter, RawShaderMaterial, RGBAFormat, UnsignedByteType, Vector2, Vector4 } from "three";
import type { IUniform } from "three";
import { mapBytes } from "./colours";
import type { MapName } from "./colours";
import {
  EDGE_FRAGMENT, PICK_FRAGMENT, POINT_FRAGMENT, SEGMENT_FRAGMENT, SEGMENT_VERTEX, SURFACE_FRAGMENT, SURFACE_VERTEX,
} from "./shaders";

export type Uniforms = Record<string, IUniform>;

/** What every material of the picture reads. */
export function sharedUniforms(): Uniforms {
  const map = new DataTexture(mapBytes("viridis"), 256, 1, RGBAFormat, UnsignedByteType);
  map.minFilter = map.magFilter = LinearFilter;
  map.needsUpdate = true;
  return {
    map: { value: map },
    colouring: { value: 0 },
    range: { value: new Vector2(0, 1) },
    viewport: { value: new Vector2(1, 1) },
    parallel: { value: false },
    ink: { value: new Vector4(0, 0, 0, 0.55) },
    pointSize: { value: 4 },
  };
}

export function setMap(shared: Uniforms, name: MapName): void {
  const texture = shared["map"]!.value as DataTexture;
  (texture.image.data as Uint8Array).set(mapBytes(name));
  texture.needsUpdate = true;
}

function material(vertexShader: string, fragmentShader: string, uniforms: Uniforms): RawShaderMaterial {
  return new RawShaderMaterial({ glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, side: DoubleSide });
}

export interface Materials {
  surface: RawShaderMaterial;
  edge: RawShaderMaterial;
  point: RawShaderMaterial;
  segment: RawShaderMaterial;
  pick: RawShaderMaterial;
}

/** One set for bodies (`mapped`: by the coloured quantity) and one for what keeps its colours. */
export function materialsOf(shared: Uniforms, mapped: boolean): Materials {
  const own = { opacity: { value: 1 }, chosen: { value: -1 }, tint: { value: new Vector4(0, 0, 0, 0) }, mapped: { value: mapped } };
  const uniforms: Uniforms = { ...shared, ...own, ...(mapped ? {} : { colouring: { value: 0 } }) };
  const surface = material(SURFACE_VERTEX, SURFACE_FRAGMENT, uniforms);
  surface.polygonOffset = true;
  surface.polygonOffsetFactor = surface.polygonOffsetUnits = 1;
  return {
    surface,
    edge: material(SURFACE_VERTEX, EDGE_FRAGMENT, uniforms),
    point: material(SURFACE_VERTEX, POINT_FRAGMENT, uniforms),
    segment: material(SEGMENT_VERTEX, SEGMENT_FRAGMENT, { ...uniforms, width: { value: 2.6 } }),
    pick: material(SURFACE_VERTEX, PICK_FRAGMENT, { ...uniforms, firstId: { value: 1 } }),
  };
}

export function setOpacity(materials: Materials, opacity: number): void {
  for (const m of [materials.surface, materials.edge, materials.point, materials.segment]) {
    m.uniforms["opacity"]!.value = m === materials.edge ? opacity * opacity : opacity;
    m.transparent = opacity < 1;
  }
}
