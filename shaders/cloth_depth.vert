#include "frame.glsl"
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in float z;

void main() { gl_Position = vec4((shadow_from_world * vec4(x, y, z, 1.0)).xyz * 2.0 - 1.0, 1.0); }
