#include "frame.glsl"
#include "light.glsl"
in vec3 position;
in vec3 normal;
in vec2 across;
#ifdef COLORED
#include "value.glsl"
in float value;
#else
uniform sampler2D cloth;  // its first row is the cloth's top edge
#endif
uniform vec3 hem;         // sRGB
uniform vec2 hem_width;   // in units of `across`
out vec4 color;

#ifdef COLORED
vec3 own_color() { return linear(value_color(value)); }
float own_darkness() { return 0.0; }
#else
vec3 own_color() {
  vec3 albedo = linear(texture(cloth, across).rgb);
  if (!gl_FrontFacing) albedo = mix(albedo, vec3(dot(albedo, vec3(0.3, 0.6, 0.1))) * 1.1 + 0.01, 0.28);
  return albedo;
}
// 1 for a cloth that is dark itself.
float own_darkness() {
  float whole = dot(linear(textureLod(cloth, vec2(0.5), 16.0).rgb), vec3(0.3, 0.6, 0.1));
  return 1.0 - smoothstep(0.03, 0.10, whole);
}
#endif

void main() {
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);
  vec3 to_eye = normalize(eye.xyz - position);

  vec3 albedo = own_color();
  vec2 pixel = fwidth(across);
  vec2 width = max(hem_width, 1.1 * pixel);
  vec2 inside = (min(across, 1.0 - across) - width) / pixel;
  // The hem is darker than the cloth, but lighter than a cloth that is dark itself: it is there to be seen.
  float dark = own_darkness();
  vec3 edge = mix(mix(linear(hem), albedo, 0.34), 1.6 * albedo + 0.10, dark);
  albedo = mix(edge, albedo, clamp(min(inside.x, inside.y) + 0.5, 0.0, 1.0));

  float facing = dot(n, to_light.xyz);
  float lit = sunlight(position, facing < 0.0 ? -n : n, 1.6);
  // The far side of the weave lets a part of the light through.
  float diffuse = facing > 0.0 ? facing : -0.24 * facing;
  float grazing = 1.0 - clamp(dot(n, to_eye), 0.0, 1.0);
  vec3 light = ambient(n) * (1.1 - 0.5 * grazing) + key_light * (lit * diffuse);
#ifdef COLORED
  // As much light as folds need to be seen, and as little as colors need to be compared with the legend: between two
  // thirds of them and all.
  float shade = clamp(dot(light, vec3(0.3, 0.6, 0.1)) / 1.3, 0.0, 1.0);
  color = vec4(display(albedo * mix(0.45, 1.0, shade)), 1.0);
#else
  vec3 halfway = normalize(to_light.xyz + to_eye);
  float sheen = (0.22 + 0.5 * dark) * grazing * grazing * grazing;
  float gloss = facing > 0.0 ? 0.05 * pow(clamp(dot(n, halfway), 0.0, 1.0), 14.0) : 0.0;
  color = vec4(display(exposed(albedo * light * (1.0 + sheen * 2.0) + sheen * 0.05 * sky_light + gloss * lit)), 1.0);
#endif
}
