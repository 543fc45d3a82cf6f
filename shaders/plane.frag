#include "frame.glsl"
#include "light.glsl"
#include "dither.glsl"
// The disc that stands for a plane: matte, with the shadow of what is over it, darkest where that touches.
in vec3 position;
uniform vec4 disc;  // x and z of its middle, its radius, m; opacity
uniform vec3 ink;   // sRGB, where it is lit
out vec4 color;     // premultiplied

const vec3 up = vec3(0.0, 1.0, 0.0);
const float blur = 4.0;

// How much of the light is taken by what is nearer than that, m, seen from a place of which `shade` is taken in all.
float taken_near(float reach, float shade) {
  return max(shade - (1.0 - sunlight(position + reach * to_light.xyz, up, blur)), 0.0);
}

void main() {
  float away = length(position.xz - disc.xy);
  float inside = clamp((disc.z - away) / max(fwidth(away), 1e-6) + 0.5, 0.0, 1.0);
  if (inside == 0.0) discard;
  float shade = 1.0 - sunlight(position, up, blur);
  float contact = 0.5 * (taken_near(0.05 * focus.w, shade) + taken_near(0.16 * focus.w, shade));
  float dim = 0.36 * shade + 0.36 * contact + 0.16 * smoothstep(0.3, 1.0, away / disc.z);
  color = vec4(ink * (1.0 - dim) + dither(gl_FragCoord.xy) / 255.0, 1.0) * (inside * disc.w);
}
