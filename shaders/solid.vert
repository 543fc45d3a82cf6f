#include "frame.glsl"
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 point_normal;
uniform vec4 placed;  // xyz: where the mesh's origin stands; w: its scale
out vec3 position;
out vec3 normal;

void main() {
  position = placed.xyz + placed.w * point;
  normal = point_normal;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
