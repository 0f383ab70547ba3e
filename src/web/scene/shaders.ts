// The one shader of the blocks. Everything about a point or a block is fetched from textures by number, so that one
// buffer of four bytes a corner, uploaded once, draws all blocks in one call.

/// Texels in a row of the textures that hold points, blocks and motions.
export const rowLength = 2048;

/// Which triangles a draw shows.
export const Pass = { solid: 0, ghost: 1, joints: 2, pick: 3, count: 4 } as const;

/// What a block's flags say; the shader has the same numbers.
export const Flag = { solid: 0, hidden: 1, ghost: 2, selected: 4 } as const;

export const vertexShader = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp isampler2D;

in uint aCorner;    // point · 8 + sides that are edges
in uint aOrigin;    // into the origins

uniform mat4 viewMatrix, projectionMatrix;
uniform sampler2D uPoint;    // x, y, z, block
uniform sampler2D uBlock;    // centroid, flags
uniform sampler2D uValue;    // 0 … 1 along the map, below 0: none
uniform int uValueOf;        // 0 blocks, 1 points, 2 origins; 3 length of the displacement, 4 … 6 its parts
uniform float uLow, uHigh;   // limits of the map for a displacement
uniform int uPass, uJoint;   // uJoint: the origin to show, −2 all joints
uniform sampler2D uOrigin;   // kind, colour
uniform float uExplode, uMagnify, uShare;
#if MOTION == 1
uniform isampler2D uFrom, uTo;
uniform float uUnitFrom, uUnitTo;
#elif MOTION == 2
uniform sampler2D uFrom, uTo, uMiddle;
#endif

out vec3 vPosition, vRest, vSides;
out float vValue;
flat out vec3 vEdges, vJointColour;
flat out int vBlock, vFlags;

ivec2 texel(int i) { return ivec2(i % ${rowLength}, i / ${rowLength}); }

#if MOTION == 2
vec3 moved(sampler2D motion, int block, vec3 x) {
  vec4 a = texelFetch(motion, texel(3 * block), 0), b = texelFetch(motion, texel(3 * block + 1), 0),
       c = texelFetch(motion, texel(3 * block + 2), 0);
  return a.xyz + vec3(dot(vec3(a.w, b.xy), x), dot(vec3(b.zw, c.x), x), dot(c.yzw, x));
}
#endif

vec3 displacement(int point, int block, vec3 x) {
#if MOTION == 1
  return mix(uUnitFrom * vec3(texelFetch(uFrom, texel(point), 0).xyz), uUnitTo * vec3(texelFetch(uTo, texel(point), 0).xyz), uShare);
#elif MOTION == 2
  vec3 arm = x - texelFetch(uMiddle, texel(block), 0).xyz;
  return mix(moved(uFrom, block, arm), moved(uTo, block, arm), uShare);
#else
  return vec3(0.0);
#endif
}

bool isShown(int flags, int origin, vec4 kind) {
  if ((flags & ${Flag.hidden}) != 0) return false;
  bool ghost = (flags & ${Flag.ghost}) != 0;
  if (uPass == ${Pass.ghost}) return ghost;
  if (uPass == ${Pass.joints}) return kind.w == 0.0 && (uJoint == -2 || uJoint == origin);
  return !ghost;
}

void main() {
  int point = int(aCorner >> 3u), origin = int(aOrigin), sides = int(aCorner & 7u);
  vec4 rest = texelFetch(uPoint, texel(point), 0);
  vBlock = int(rest.w);
  vec4 block = texelFetch(uBlock, texel(vBlock), 0);
  vFlags = int(block.w);
  vec4 kind = texelFetch(uOrigin, texel(origin), 0);
  vJointColour = kind.rgb;
  vRest = rest.xyz;
  vec3 u = displacement(point, vBlock, rest.xyz);
  vPosition = rest.xyz + uMagnify * u + uExplode * block.xyz;
  vValue = uValueOf > 2 ? clamp(((uValueOf == 3 ? length(u) : u[uValueOf - 4]) - uLow) / (uHigh - uLow), 0.0, 1.0)
                        : texelFetch(uValue, texel(uValueOf == 0 ? vBlock : uValueOf == 1 ? point : origin), 0).r;
  int c = gl_VertexID % 3;
  vSides = vec3(c == 0, c == 1, c == 2);
  // A side lies opposite to the corner whose weight vanishes on it.
  vEdges = vec3((sides >> 1) & 1, (sides >> 2) & 1, sides & 1);
  gl_Position = isShown(vFlags, origin, kind) ? projectionMatrix * viewMatrix * vec4(vPosition, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
`;

export const fragmentShader = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;

in vec3 vPosition, vRest, vSides;
in float vValue;
flat in vec3 vEdges, vJointColour;
flat in int vBlock, vFlags;

uniform mat4 viewMatrix;
uniform vec3 cameraPosition;
uniform vec4 uClip[3];       // normal, distance; a zero normal cuts nothing
uniform sampler2D uMap, uRock;
uniform int uPass;
uniform bool uEdges, uTexture;
uniform bool uBacks;         // this draw shows the backs of faces (three.js then calls them front)
uniform float uGhost, uGhostEdge, uDepth, uGrain, uEdgeWidth;
uniform vec3 uNone, uInk, uAccent;

out vec4 colour;

float grain(vec3 x, vec3 n) {
  vec3 weight = pow(abs(n), vec3(4.0));
  weight /= weight.x + weight.y + weight.z;
  vec3 p = x / uGrain;
  float coarse = texture(uRock, p.yz).r * weight.x + texture(uRock, p.zx).r * weight.y + texture(uRock, p.xy).r * weight.z;
  vec3 q = p * 0.23 + 0.37;  // hides that the picture repeats
  coarse = 0.6 * coarse + 0.4 * (texture(uRock, q.zy).r * weight.x + texture(uRock, q.xz).r * weight.y + texture(uRock, q.yx).r * weight.z);
  p *= 4.7;
  float fine = texture(uRock, p.yz).r * weight.x + texture(uRock, p.zx).r * weight.y + texture(uRock, p.xy).r * weight.z;
  return 0.6 * coarse + 0.4 * fine;
}

// How near a fragment is to an edge of its block: 1 on it. Fades where triangles are only a few pixels wide.
float edge() {
  vec3 pixel = fwidth(vSides);
  vec3 near = 1.0 - smoothstep(vec3(uEdgeWidth - 0.5), vec3(uEdgeWidth + 0.5), vSides / max(pixel, 1e-6));
  near *= 1.0 - smoothstep(0.4, 1.1, pixel);
  near *= vEdges;
  return max(near.x, max(near.y, near.z));
}

// Where the line of sight enters and leaves what the planes keep, in shares of the way from the eye to the fragment;
// enter = 0: the eye is in it. Also the normal of the plane through which it enters.
void keptSpan(out float enter, out float leave, out vec3 normal) {
  vec3 ray = vPosition - cameraPosition;
  enter = 0.0;
  leave = 1e9;
  normal = vec3(0.0);
  for (int i = 0; i < 3; ++i) {
    float height = dot(uClip[i].xyz, cameraPosition) - uClip[i].w;
    float climb = dot(uClip[i].xyz, ray);
    if (height <= 0.0) { if (climb > 0.0) leave = min(leave, -height / climb); }
    else if (climb >= 0.0) leave = -1.0;
    else if (-height / climb > enter) { enter = -height / climb; normal = uClip[i].xyz; }
  }
}

void main() {
  float enter, leave;
  vec3 plane;
  keptSpan(enter, leave, plane);
  if (enter > 1.0) discard;
  if (uPass == ${Pass.count}) { colour = vec4(0.0); return; }
  bool capped = uBacks && enter > 0.0;
  if ((capped ? enter : 1.0) > leave) discard;
  vec3 at = vPosition, rest = vRest;
  vec3 normal = normalize(cross(dFdx(vPosition), dFdy(vPosition)));
  vec3 restNormal = normalize(cross(dFdx(vRest), dFdy(vRest)));
  float line = uEdges ? edge() : 0.0;
  if (capped) {
    rest = at = cameraPosition + enter * (vPosition - cameraPosition);
    restNormal = normal = plane;
    line = 0.0;
  }
  if (uPass == ${Pass.pick}) { colour = vec4(at, float(vBlock + 1)); return; }

  vec3 base = vValue < -0.5 ? uNone : texture(uMap, vec2((255.0 * clamp(vValue, 0.0, 1.0) + 0.5) / 256.0, 0.5)).rgb;
  if (uPass == ${Pass.joints}) base = vJointColour;
  if (uTexture && uPass != ${Pass.joints}) base *= 1.0 + uDepth * (grain(rest, restNormal) - 0.5);

  if (dot(normal, cameraPosition - at) < 0.0) normal = -normal;
  vec3 n = mat3(viewMatrix) * normal;
  float lit = 0.44 + 0.42 * max(0.0, dot(n, normalize(vec3(-0.45, 0.6, 0.66)))) + 0.17 * normal.z + 0.08 * n.z;
  if (capped) lit = 0.86;
  if (uBacks && !capped) lit *= 0.55;  // from within a block
  vec3 shade = base * lit;
  bool selected = (vFlags & ${Flag.selected}) != 0;
  if (selected && uPass != ${Pass.joints}) {
    shade = mix(shade, uAccent * (0.55 + 0.6 * lit), 0.62);
    line *= 1.6;
  }
  shade = mix(shade, selected ? vec3(1.0) : uInk, min(1.0, 0.62 * line));
  float alpha = uPass == ${Pass.ghost} ? min(1.0, uGhost + uGhostEdge * line * (1.0 - uGhost)) : uPass == ${Pass.joints} ? 0.8 : 1.0;
  colour = vec4(shade, alpha);
}
`;
