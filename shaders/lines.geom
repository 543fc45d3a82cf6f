#version 330 core
#include "frame.glsl"
// A line as a rectangle on the screen: thick lines are no part of OpenGL's core profile.
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
uniform float spacing;    // m between lines
uniform float max_width;  // px
out float strength;       // how much of a line of one pixel it is, and how near
#ifdef COLORED
in float vertex_value[];
out float value;
float end_value;  // of the end that corners are made of
#endif

void corner(vec4 at, vec2 offset_px, float s) {
  strength = s;
#ifdef COLORED
  value = end_value;
#endif
  gl_Position = vec4(at.xy + offset_px * (2.0 * at.w / viewport.xy), at.zw);
  EmitVertex();
}

// Lines get thinner where they stand close, and fainter once they would be thinner than a pixel.
float width_at(vec4 at) { return min(0.13 * spacing * eye.w / at.w, max_width); }
float strength_at(vec4 at, float width) {
#ifdef COLORED
  return clamp(width, 0.3, 1.0);  // colors are to be compared with a legend, near and far
#endif
  float depth = (at.w - length(eye.xyz - focus.xyz)) / focus.w;  // -1 nearest to 1 farthest, about
  return clamp(width, 0.3, 1.0) * clamp(0.8 - 0.35 * depth, 0.3, 1.0);
}

void main() {
  vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
  float near = 1e-4;
  if (a.w < near && b.w < near) return;
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport.xy;
  float size = length(along);
  vec2 side = size > 1e-6 ? vec2(-along.y, along.x) / size : vec2(0.0, 1.0);
  float width_a = width_at(a), width_b = width_at(b);
  float strength_a = strength_at(a, width_a), strength_b = strength_at(b, width_b);
  vec2 half_a = side * (0.5 * max(width_a, 1.0)), half_b = side * (0.5 * max(width_b, 1.0));
#ifdef COLORED
  end_value = vertex_value[0];
#endif
  corner(a, half_a, strength_a);
  corner(a, -half_a, strength_a);
#ifdef COLORED
  end_value = vertex_value[1];
#endif
  corner(b, half_b, strength_b);
  corner(b, -half_b, strength_b);
  EndPrimitive();
}
