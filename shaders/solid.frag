#include "frame.glsl"
#include "light.glsl"
in vec3 position;
in vec3 normal;
uniform vec3 base;  // sRGB
uniform float gloss;
uniform float own_light;  // 1: shows its color as it is, unlit
out vec4 color;

void main() {
  vec3 n = normalize(normal);
  vec3 to_eye = normalize(eye.xyz - position);
  float facing = dot(n, to_light.xyz);
  float lit = facing > 0.0 ? sunlight(position, n, 1.6) : 0.0;
  vec3 halfway = normalize(to_light.xyz + to_eye);
  float grazing = 1.0 - clamp(dot(n, to_eye), 0.0, 1.0);
  float shine = gloss * pow(clamp(dot(n, halfway), 0.0, 1.0), 40.0) * lit;
  vec3 light = ambient(n) * (1.1 - 0.5 * grazing) + key_light * (lit * max(facing, 0.0));
  vec3 shaded = display(exposed(linear(base) * light + shine + 0.06 * grazing * grazing * grazing * sky_light));
  color = vec4(mix(shaded, base, own_light), 1.0);
}
