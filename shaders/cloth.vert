#include "frame.glsl"
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in float z;
layout(location = 3) in float normal_x;
layout(location = 4) in float normal_y;
layout(location = 5) in float normal_z;
#ifdef COLORED
#include "values.glsl"
out float value;
#else
uniform int stride;        // particles a row of the arrays
#endif
uniform vec2 texture_step;  // 1/(C-1), 1/(R-1)
uniform int site_rows, columns;
uniform highp usampler2D copy_sites;  // column and row of the site of each copy, in the rows after those of the sites
out vec3 position;
out vec3 normal;
out vec2 across;  // 0..1 along the columns and down the rows

void main() {
  int i = gl_VertexID / stride;
  int j = gl_VertexID - i * stride;
  if (i >= site_rows) {
    int copy = (i - site_rows) * columns + j;
    uvec2 site = texelFetch(copy_sites, ivec2(copy & 4095, copy >> 12), 0).rg;
    i = int(site.y), j = int(site.x);
  }
  across = vec2(j, i) * texture_step;
  position = vec3(x, y, z);
  normal = vec3(normal_x, normal_y, normal_z);
#ifdef COLORED
  value = particle_value(gl_VertexID);
#endif
  gl_Position = clip_from_world * vec4(position, 1.0);
}
