// How the puzzle is drawn: one mesh, with a row of two small tables for each piece.

const VERTEX = `
attribute float piece;
uniform sampler2D tints;  // colour in linear light; alpha is 0 where a piece is hidden
uniform sampler2D moves;  // the way out; w is how much of its colour a piece keeps
uniform sampler2D slides;  // how far from its place a piece is that is going in
uniform float amount;
flat varying vec4 tint;
varying vec3 toEye;
varying vec3 bent;
#ifdef UV
  attribute vec2 look;
  varying vec2 place;
  flat varying float shows;
#endif
#ifdef RGB
  attribute vec4 look;
  varying vec4 shown;
#endif
void main() {
  int k = int(piece + 0.5);
  ivec2 row = ivec2(k % ROW, k / ROW);
  tint = texelFetch(tints, row, 0);
  vec4 move = texelFetch(moves, row, 0);
  if (tint.a == 0.0) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  #ifdef IDS
    tint = vec4(vec3(ivec3(k + 1) >> ivec3(0, 8, 16) & 255) / 255.0, 1.0);
  #else
    tint.a = move.w;
  #endif
  vec4 seen = modelViewMatrix * vec4(position + amount * move.xyz + texelFetch(slides, row, 0).xyz, 1.0);
  toEye = -seen.xyz;
  bent = normalMatrix * normal;
  #ifdef UV
    shows = look.x == 65535.0 && look.y == 65535.0 ? 0.0 : 1.0;
    place = look / 65534.0;
  #endif
  #ifdef RGB
    shown = look;
  #endif
  gl_Position = projectionMatrix * seen;
}`;

// A lamp over the left shoulder, a sky above, a faint dark rim.
const FRAGMENT = `
uniform vec3 pale;  // what muted pieces fade to
uniform bool picture;
flat varying vec4 tint;
varying vec3 toEye;
varying vec3 bent;
#ifdef UV
  uniform sampler2D image;
  varying vec2 place;
  flat varying float shows;
#endif
#ifdef RGB
  varying vec4 shown;
#endif
void main() {
  vec3 colour = tint.rgb;
  #ifdef UV
    vec3 pixel = texture2D(image, place).rgb;
    if (picture && shows > 0.5) colour = pixel;
  #endif
  #ifdef RGB
    if (picture && shown.a > 0.5) colour = pow(shown.rgb, vec3(2.2));
  #endif
  colour = mix(pale, colour, tint.a);
  vec3 n = normalize(bent), eye = normalize(toEye);
  float facing = clamp(dot(n, eye), 0.0, 1.0);
  float rim = 1.0 - 0.35 * pow(1.0 - facing, 3.0);
  float lamp = max((dot(n, normalize(vec3(-0.45, 0.65, 0.62))) + 0.15) / 1.15, 0.0);
  gl_FragColor = vec4(colour * rim * (0.42 + 0.14 * n.y + 0.72 * lamp), 1.0);
  #include <colorspace_fragment>
}`;

const FRAGMENT_IDS = `
flat varying vec4 tint;
void main() { gl_FragColor = tint; }`;

const ROW = 256; // pieces in a row of a table
