#include "frame.glsl"
// What closes the edges of a torn cloth: triangles of the other diagonal, and strips in which threads end. Six vertices
// are the corners of a piece's two triangles; there are no attributes.
uniform highp usampler2D pieces;  // four particles each, two a texel: app/render/cloth_mesh.h, frayed_indices
uniform sampler2D positions;      // as in lines.vert
uniform sampler2D normals;        // likewise
uniform int component;
uniform float spacing;            // m between particles
uniform vec2 texture_step;
uniform int site_rows, columns;       // as in cloth.vert
uniform highp usampler2D copy_sites;  // likewise
out vec3 position;
out vec3 normal;
out vec2 across;
out vec2 site;         // column and row
out float away;        // cells from the edge, along a thread; negative in a triangle
flat out vec3 threads; // whether threads along the columns end here, and along the rows; a number of the edge's line
#ifdef COLORED
#include "values.glsl"
out float value;
#else
uniform int stride;
#endif

const float reach = 0.6;  // cells: the longest thread

ivec2 texel(int at) { return ivec2(at & 4095, at >> 12); }
vec3 vector_of(sampler2D from, int particle) {
  vec3 found;
  for (int c = 0; c < 3; ++c) found[c] = texelFetch(from, texel(particle + c * component), 0).r;
  return found;
}
vec2 site_of(int particle) {
  int i = particle / stride, j = particle - i * stride;
  if (i < site_rows) return vec2(j, i);
  return vec2(texelFetch(copy_sites, texel((i - site_rows) * columns + j), 0).rg);
}

void main() {
  int piece = gl_VertexID / 6, vertex = gl_VertexID - 6 * piece;
  int corner = vertex < 3 ? vertex : 6 - vertex;  // 0, 1, 2 and 3, 2, 1
  ivec2 ab = ivec2(texelFetch(pieces, texel(2 * piece), 0).rg), cd = ivec2(texelFetch(pieces, texel(2 * piece + 1), 0).rg);
  vec3 a = vector_of(positions, ab.x), b = vector_of(positions, ab.y), c = vector_of(positions, cd.x);
  vec2 site_a = site_of(ab.x), site_b = site_of(ab.y), site_c = site_of(cd.x);
  int nearest = (corner & 1) == 0 ? ab.x : ab.y;
  if (ab.x == cd.y) {  // a triangle, twice its third corner
    if (corner > 1) nearest = cd.x;
    position = corner > 1 ? c : corner == 0 ? a : b;
    site = corner > 1 ? site_c : corner == 0 ? site_a : site_b;
    threads = vec3(0.0);
    away = -1.0;
  } else {  // a strip on the other side of the edge, as long as the triangle on this side is high
    vec2 edge = site_b - site_a, foot = 0.5 * (site_c + site_of(cd.y));
    float part = dot(foot - site_a, edge) / dot(edge, edge);
    away = corner > 1 ? reach : 0.0;
    position = ((corner & 1) == 0 ? a : b) + away * (mix(a, b, part) - c);
    site = ((corner & 1) == 0 ? site_a : site_b) + away * (foot - site_c);
    threads = vec3(edge.x != 0.0, edge.y != 0.0, edge.x == 0.0 ? site_a.x : edge.y == 0.0 ? site_a.y : 0.0);
    // Behind the cloth, which it may overlap.
    vec3 from_eye = position - eye.xyz;
    position += from_eye * (0.1 * spacing / max(length(from_eye), spacing));
  }
  across = site * texture_step;
  // A particle without a triangle of its own has (0, 0, 1) (app/render/cloth_mesh.h).
  normal = vector_of(normals, nearest);
  if (normal == vec3(0.0, 0.0, 1.0)) normal = ab.x == cd.y ? cross(b - a, c - a) : cross(c - a, b - a);
  normal = normalize(normal);
#ifdef COLORED
  value = particle_value(nearest);
#endif
  gl_Position = clip_from_world * vec4(position, 1.0);
}
