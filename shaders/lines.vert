#include "frame.glsl"
// A line as a rectangle on the screen: thick lines are no part of OpenGL's core profile. Six vertices are the corners of
// its two triangles; there are no attributes.
uniform highp usampler2D lines;  // two particles, by their vertex index, for each; as positions: app/render/field_colors.h
uniform sampler2D positions;     // the vertex buffer: x, y and z of a row of particles one after the other
uniform int component;           // from x to y and from y to z
uniform float spacing;           // m between lines
uniform float max_width;         // px
out float strength;              // how much of a line of one pixel it is, and how near

#ifdef COLORED
#include "values.glsl"
out float value;
#endif

ivec2 texel(int at) { return ivec2(at & 4095, at >> 12); }
float number_at(int at) { return texelFetch(positions, texel(at), 0).r; }
vec4 clip_position(int particle) {
  vec3 at = vec3(number_at(particle), number_at(particle + component), number_at(particle + 2 * component));
  return clip_from_world * vec4(at, 1.0);
}

// Lines get thinner where they stand close, and fainter once they would be thinner than a pixel.
float width_at(vec4 at) { return min(0.13 * spacing * eye.w / at.w, max_width); }
float strength_at(vec4 at, float width) {
#ifdef COLORED
  return clamp(width, 0.3, 1.0);  // colors are to be compared with a legend, near and far
#else
  float depth = (at.w - length(eye.xyz - focus.xyz)) / focus.w;  // -1 nearest to 1 farthest, about
  return clamp(width, 0.3, 1.0) * clamp(0.8 - 0.35 * depth, 0.3, 1.0);
#endif
}

void main() {
  int line = gl_VertexID / 6, vertex = gl_VertexID - 6 * line;
  int corner = vertex < 3 ? vertex : 6 - vertex;  // 0, 1, 2 and 3, 2, 1
  bool last = corner > 1;
  float sign = (corner & 1) == 0 ? 1.0 : -1.0;
  uvec2 ends = texelFetch(lines, texel(line), 0).rg;
  vec4 a = clip_position(int(ends.x)), b = clip_position(int(ends.y));
  strength = 0.0;
#ifdef COLORED
  value = particle_value(int(last ? ends.y : ends.x));
#endif
  float near = 1e-4;
  if (a.w < near && b.w < near) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // behind the eye: outside of what is drawn
    return;
  }
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport.xy;
  float size = length(along);
  vec2 side = size > 1e-6 ? vec2(-along.y, along.x) / size : vec2(0.0, 1.0);
  vec4 at = last ? b : a;
  float width = width_at(at);
  strength = strength_at(at, width);
  vec2 offset_px = sign * side * (0.5 * max(width, 1.0));
  gl_Position = vec4(at.xy + offset_px * (2.0 * at.w / viewport.xy), at.zw);
}
