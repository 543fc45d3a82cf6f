#include "frame.glsl"
layout(location = 0) in vec3 point;
uniform vec4 placed;

void main() {
  vec3 position = placed.xyz + placed.w * point;
  gl_Position = vec4((shadow_from_world * vec4(position, 1.0)).xyz * 2.0 - 1.0, 1.0);
}
