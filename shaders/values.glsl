// The value of a vertex's particle.
uniform sampler2D values;  // a texel a particle
uniform int stride;        // particles a row of the arrays

float particle_value(int vertex) {
  int i = vertex / stride;
  return texelFetch(values, ivec2(vertex - i * stride, i), 0).r;
}
