#include "frame.glsl"
#include "light.glsl"
in vec3 position;
out vec4 color;  // premultiplied

void main() {
  float away = length(position.xz - focus.xz) / focus.w;
  // On a light ground a shadow of the same strength looks darker.
  float strength = mix(0.46, 0.20, background_bottom.g);
  float shade = strength * (1.0 - sunlight(position, vec3(0.0, 1.0, 0.0), 4.0));
  color = vec4(0.0, 0.0, 0.0, shade * (1.0 - smoothstep(2.0, 4.0, away)));
}
