#include "frame.glsl"
layout(location = 0) in vec3 point;
uniform mat4 placed;

void main() {
  gl_Position = vec4((shadow_from_world * (placed * vec4(point, 1.0))).xyz * 2.0 - 1.0, 1.0);
}
