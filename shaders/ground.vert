#include "frame.glsl"
uniform vec4 area;  // least x and z, greatest x and z, m
out vec3 position;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 xz = mix(area.xy, area.zw, corner);
  position = vec3(xz.x, viewport.w, xz.y);
  gl_Position = clip_from_world * vec4(position, 1.0);
}
