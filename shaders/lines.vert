#version 330 core
#include "frame.glsl"
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in float z;

#ifdef COLORED
#include "values.glsl"
out float vertex_value;
#endif

void main() {
  gl_Position = clip_from_world * vec4(x, y, z, 1.0);
#ifdef COLORED
  vertex_value = particle_value(gl_VertexID);
#endif
}
