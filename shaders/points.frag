in float strength;
flat in float radius;
uniform vec4 ink;    // sRGB and opacity
uniform float rim;   // px of dark rim round a mark, 0: a plain ball
uniform float ring;  // px of thickness of an empty ring, 0: filled
out vec4 color;     // premultiplied
#ifdef COLORED
#include "value.glsl"
in float value;
vec3 own_color() { return value_color(value); }
#else
vec3 own_color() { return ink.rgb; }
#endif

void main() {
  vec2 from_middle = gl_PointCoord * 2.0 - 1.0;
  float r = length(from_middle) * radius;
  float cover = clamp(radius - r, 0.0, 1.0);
  if (cover == 0.0) discard;
  vec3 ball = own_color();
  if (ring > 0.0) {
    // White between two dark edges is seen on every ground.
    float white = clamp(radius - 1.0 - r, 0.0, 1.0) * clamp(r - (radius - 1.5 - ring), 0.0, 1.0);
    cover *= clamp(r - (radius - 2.5 - ring), 0.0, 1.0);
    ball *= white;
  } else {
    // Lit from above left, like everything else.
    float light = 1.0 - 0.30 * length(from_middle - vec2(-0.3, -0.4));
    ball *= min(light * 1.12, 1.0) * clamp(radius - rim - r + 0.5, rim > 0.0 ? 0.08 : 1.0, 1.0);
  }
  color = vec4(ball, 1.0) * (cover * strength * ink.a);
}
