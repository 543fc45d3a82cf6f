#include "frame.glsl"
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 point_normal;
uniform mat4 placed;  // from the mesh to the world
out vec3 position;
out vec3 normal;

void main() {
  position = vec3(placed * vec4(point, 1.0));
  normal = normalize(transpose(inverse(mat3(placed))) * point_normal);
  gl_Position = clip_from_world * vec4(position, 1.0);
}
