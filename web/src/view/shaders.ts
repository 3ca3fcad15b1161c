// GLSL of bodies: poses, modal amplitudes and modes are textures; a vertex is position + rotation (V + sum a_k mode_k).
// A record (body or glyph) is six texels: place and scale; quaternion (x y z w); first amplitude, modes, first texel of its
// modes, of its stresses; place at the start; quaternion at the start; colour.

export const RECORD_TEXELS = 6;
export const RECORDS_PER_ROW = 128;
export const AMPLITUDES_PER_ROW = 1024;
export const MODE_TEXELS_PER_ROW = 4096;

const HEAD = `precision highp float;
precision highp int;
precision highp isampler2D;
uniform mat4 viewMatrix, projectionMatrix;
uniform sampler2D records, amplitudes;
uniform isampler2D modes, stresses;
uniform float exaggeration;
uniform int colouring;
struct Vertex { vec3 rigid; vec3 world; float value; vec4 colour; vec4 turn; };

vec4 record(int i, int k) {
  return texelFetch(records, ivec2((i % ${RECORDS_PER_ROW}) * ${RECORD_TEXELS} + k, i / ${RECORDS_PER_ROW}), 0);
}
ivec4 stored(isampler2D table, int i) {
  return texelFetch(table, ivec2(i % ${MODE_TEXELS_PER_ROW}, i / ${MODE_TEXELS_PER_ROW}), 0);
}
vec4 amplitude(int i) { return texelFetch(amplitudes, ivec2(i % ${AMPLITUDES_PER_ROW}, i / ${AMPLITUDES_PER_ROW}), 0); }
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

float misesStress(int first, int count, int base, int vertex) {
  vec4 normal = vec4(0.0);
  vec2 shear = vec2(0.0);
  for (int k = 0; k < count; ++k) {
    float a = amplitude(first + k).y;
    int at = base + 2 * (vertex * count + k);
    normal += a * vec4(stored(stresses, at));
    shear += a * vec2(stored(stresses, at + 1).xy);
  }
  vec3 d = normal.xyz - normal.yzx;
  return sqrt(0.5 * dot(d, d) + 3.0 * (normal.w * normal.w + dot(shear, shear)));
}

Vertex place(vec3 rest, int body, int vertex) {
  vec4 at = record(body, 0), turn = record(body, 1), meta = record(body, 2);
  vec3 u = vec3(0.0), u0 = vec3(0.0);
  int first = int(meta.x), count = int(meta.y), base = int(meta.z);
  for (int k = 0; k < count; ++k) {
    vec3 mode = vec3(stored(modes, base + vertex * count + k).xyz);
    vec4 a = amplitude(first + k);
    u += a.x * mode;
    u0 += a.z * mode;
  }
  Vertex v;
  v.turn = turn;
  v.rigid = at.xyz + turned(turn, at.w * rest);
  v.world = v.rigid + turned(turn, exaggeration * u);
  v.colour = record(body, 5);
  v.value = 0.0;
  if (colouring == 1) v.value = length(u);
  if (colouring == 2)
    v.value = distance(at.xyz + turned(turn, rest + u), record(body, 3).xyz + turned(record(body, 4), rest + u0));
  if (colouring == 3 && meta.w >= 0.0) v.value = misesStress(first, count, int(meta.w), vertex);
  return v;
}
`;

export const SURFACE_VERTEX = `${HEAD}
in vec3 position;
in vec3 normal;
in uvec2 source;
uniform vec2 range;
uniform float pointSize;
out vec3 seen, rigid, toward;
out float share;
out vec4 colour;
flat out int owner;
void main() {
  Vertex v = place(position, int(source.x), int(source.y));
  seen = (viewMatrix * vec4(v.world, 1.0)).xyz;
  rigid = (viewMatrix * vec4(v.rigid, 1.0)).xyz;
  toward = mat3(viewMatrix) * turned(v.turn, normal);
  share = (v.value - range.x) / max(range.y - range.x, 1e-30);
  colour = v.colour;
  owner = int(source.x);
  gl_PointSize = pointSize;
  gl_Position = projectionMatrix * vec4(seen, 1.0);
}`;

const COLOUR = `
uniform sampler2D map;
uniform int colouring;
uniform vec4 tint;
vec3 painted(vec4 own, float share) {
  vec3 base = colouring > 0 && own.a > 0.5 ? texture(map, vec2(clamp(share, 0.0, 1.0) * 0.996 + 0.002, 0.5)).rgb : own.rgb;
  return mix(base, tint.rgb, tint.a);
}`;

// The smooth normal of the undeformed surface follows the turn of its facet.
export const SURFACE_FRAGMENT = `precision highp float;
precision highp int;
in vec3 seen, rigid, toward;
in float share;
in vec4 colour;
flat in int owner;
uniform float opacity;
uniform bool parallel;
uniform int chosen;
${COLOUR}
out vec4 result;
vec3 followed(vec3 n, vec3 from, vec3 to) {
  vec3 axis = cross(from, to);
  float c = dot(from, to);
  return c < -0.99 ? to : c * n + cross(axis, n) + axis * dot(axis, n) / (1.0 + c);
}
void main() {
  vec3 before = cross(dFdx(rigid), dFdy(rigid)), after = cross(dFdx(seen), dFdy(seen));
  vec3 n = normalize(toward);
  if (dot(before, before) > 0.0 && dot(after, after) > 0.0) n = followed(n, normalize(before), normalize(after));
  vec3 eye = parallel ? vec3(0.0, 0.0, 1.0) : normalize(-seen);
  if (dot(n, eye) < 0.0) n = -n;
  float key = max(dot(n, vec3(0.34, 0.56, 0.755)), 0.0), fill = 0.5 + 0.5 * dot(n, vec3(-0.6, -0.2, 0.77));
  float shine = pow(max(dot(n, normalize(vec3(0.34, 0.56, 0.755) + eye)), 0.0), 40.0);
  vec3 base = painted(colour, share);
  if (owner == chosen) base = mix(base, vec3(1.0, 0.72, 0.2), 0.55);
  result = vec4(base * (0.30 + 0.52 * key + 0.24 * fill) + 0.10 * shine, opacity);
}`;

export const EDGE_FRAGMENT = `precision highp float;
precision highp int;
in vec4 colour;
in float share;
flat in int owner;
uniform float opacity;
uniform vec4 ink;
out vec4 result;
void main() { result = vec4(mix(colour.rgb, ink.rgb, ink.a), opacity); }`;

export const POINT_FRAGMENT = `precision highp float;
precision highp int;
in vec4 colour;
in float share;
flat in int owner;
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
flat in int owner;
uniform int firstId;
out vec4 result;
void main() {
  int id = firstId + owner;
  result = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 255.0) / 255.0;
}`;

// Segments as quads of a width in pixels. A segment with owner.x < 0 is in world axes.
export const SEGMENT_VERTEX = `${HEAD}
in vec3 position;
in vec3 from, to;
in ivec3 owner3;
in vec4 paint;
uniform vec2 range, viewport;
uniform float width;
out vec4 colour;
out float share;
flat out int owner;
void main() {
  Vertex a, b;
  if (owner3.x >= 0) {
    a = place(from, owner3.x, owner3.y);
    b = place(to, owner3.x, owner3.z);
    colour = paint.a > 0.0 ? paint : a.colour;
  } else {
    a.world = from; b.world = to; a.value = 0.0; b.value = 0.0;
    colour = paint;
  }
  vec4 p = projectionMatrix * viewMatrix * vec4(a.world, 1.0), q = projectionMatrix * viewMatrix * vec4(b.world, 1.0);
  float near = 1e-4;
  if (p.w < near && q.w > near) p = mix(p, q, (near - p.w) / (q.w - p.w));
  if (q.w < near && p.w > near) q = mix(q, p, (near - q.w) / (p.w - q.w));
  vec2 along = (q.xy / q.w - p.xy / p.w) * viewport;
  along = dot(along, along) > 1e-12 ? normalize(along) : vec2(1.0, 0.0);
  vec4 here = position.x < 0.5 ? p : q;
  vec2 aside = vec2(-along.y, along.x) * position.y + along * (position.x * 2.0 - 1.0) * 0.5;
  here.xy += aside * width / viewport * here.w;
  share = ((position.x < 0.5 ? a.value : b.value) - range.x) / max(range.y - range.x, 1e-30);
  owner = owner3.x;
  gl_Position = here;
}`;

export const SEGMENT_FRAGMENT = `precision highp float;
precision highp int;
in vec4 colour;
in float share;
flat in int owner;
uniform float opacity;
${COLOUR}
out vec4 result;
void main() { result = vec4(painted(vec4(colour.rgb, owner >= 0 ? 1.0 : 0.0), share), opacity * colour.a); }`;
