// SPDX-License-Identifier: GPL-3.0-or-later
// GLSL of the picture. Vertices come moved and deformed from the processor: on machines without a graphics card, where
// speed is scarce, that is several times faster than modes in textures (web/README.md has the figures).

export const SURFACE_VERTEX = `precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec2 range;
uniform float pointSize;
in vec3 position, normal;
in vec4 paint;
in float value;
in uint owner;
out vec3 seen, toward;
out float share;
out vec4 colour;
flat out int body;
void main() {
  vec4 place = viewMatrix * vec4(position, 1.0);
  seen = place.xyz;
  toward = mat3(viewMatrix) * normal;
  share = (value - range.x) / max(range.y - range.x, 1e-30);
  colour = paint;
  body = int(owner);
  gl_PointSize = pointSize;
  gl_Position = projectionMatrix * place;
}`;

const COLOUR = `
uniform sampler2D map;
uniform int colouring;
uniform vec4 tint;
vec3 painted(vec4 own, float share) {
  vec3 value = share < -1e3 ? vec3(0.72, 0.74, 0.77) : texture(map, vec2(clamp(share, 0.0, 1.0) * 0.996 + 0.002, 0.5)).rgb;
  vec3 base = colouring > 0 && own.a > 0.5 ? value : own.rgb;
  return mix(base, tint.rgb, tint.a);
}`;

export const SURFACE_FRAGMENT = `precision highp float;
precision highp int;
in vec3 seen, toward;
in float share;
in vec4 colour;
flat in int body;
uniform float opacity;
uniform bool parallel;
uniform int chosen;
${COLOUR}
out vec4 result;
void main() {
  vec3 n = normalize(toward);
  vec3 eye = parallel ? vec3(0.0, 0.0, 1.0) : normalize(-seen);
  if (dot(n, eye) < 0.0) n = -n;
  const vec3 light = vec3(0.34, 0.56, 0.755);
  float key = max(dot(n, light), 0.0), fill = 0.5 + 0.5 * dot(n, vec3(-0.6, -0.2, 0.77));
  float shine = max(dot(n, normalize(light + eye)), 0.0);
  shine *= shine;
  shine *= shine;
  shine *= shine;
  vec3 base = painted(colour, share);
  if (body == chosen) base = mix(base, vec3(1.0, 0.72, 0.2), colouring > 0 ? 0.0 : 0.55);
  // Coloured quantities are shaded less, so that they keep to the legend.
  float shade = colouring > 0 ? 0.70 + 0.26 * key + 0.10 * fill : 0.30 + 0.52 * key + 0.24 * fill;
  result = vec4(base * shade + (colouring > 0 ? 0.0 : 0.07) * shine * shine, opacity);
}`;

export const EDGE_FRAGMENT = `precision highp float;
in vec4 colour;
uniform float opacity;
uniform vec4 ink;
out vec4 result;
void main() { result = vec4(mix(colour.rgb, ink.rgb, ink.a), opacity); }`;

export const POINT_FRAGMENT = `precision highp float;
precision highp int;
in vec4 colour;
in float share;
uniform float opacity;
${COLOUR}
out vec4 result;
void main() {
  vec2 d = gl_PointCoord - 0.5;
  if (dot(d, d) > 0.25) discard;
  result = vec4(painted(colour, share), opacity);
}`;

export const PICK_FRAGMENT = `precision highp float;
precision highp int;
flat in int body;
uniform int firstId;
out vec4 result;
void main() {
  int id = firstId + body;
  result = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 255.0) / 255.0;
}`;

// Segments as quads of a width in pixels.
export const SEGMENT_VERTEX = `precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec2 range, viewport;
uniform float width;
in vec3 position, from, to;
in vec2 values;
in vec4 paint;
out vec4 colour;
out float share;
void main() {
  vec4 p = projectionMatrix * viewMatrix * vec4(from, 1.0), q = projectionMatrix * viewMatrix * vec4(to, 1.0);
  float near = 1e-4;
  if (p.w < near && q.w > near) p = mix(p, q, (near - p.w) / (q.w - p.w));
  if (q.w < near && p.w > near) q = mix(q, p, (near - q.w) / (p.w - q.w));
  vec2 along = (q.xy / q.w - p.xy / p.w) * viewport;
  along = dot(along, along) > 1e-12 ? normalize(along) : vec2(1.0, 0.0);
  vec4 here = position.x < 0.5 ? p : q;
  vec2 aside = vec2(-along.y, along.x) * position.y + along * (position.x * 2.0 - 1.0) * 0.5;
  here.xy += aside * width / viewport * here.w;
  share = ((position.x < 0.5 ? values.x : values.y) - range.x) / max(range.y - range.x, 1e-30);
  colour = paint;
  gl_Position = here;
}`;

export const SEGMENT_FRAGMENT = `precision highp float;
precision highp int;
in vec4 colour;
in float share;
uniform float opacity;
uniform bool mapped;
${COLOUR}
out vec4 result;
void main() { result = vec4(painted(vec4(colour.rgb, mapped ? 1.0 : 0.0), share), opacity * colour.a); }`;
