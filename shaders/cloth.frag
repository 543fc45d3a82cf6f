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

#ifdef FRAYED
in vec2 site;
in float away;
flat in vec3 threads;

float random(vec2 of) { return fract(sin(dot(of, vec2(127.1, 311.7))) * 43758.5453); }

// How much of a pixel the ends of threads side by side cover: `at` counts threads.
float thread_ends(float at, float line) {
  const float half_width = 0.3, longest = 0.6;
  float pixel = max(fwidth(at), 1e-4);
  float own = random(vec2(floor(at), line));
  float bend = 1.2 * away * sin(7.0 * away + 6.3 * own);
  float size = mix(0.10, longest, own * own);
  float inside = half_width * (1.0 - 0.5 * away / size) - abs(fract(at) - 0.5 + bend);
  float near = clamp(inside / pixel + 0.5, 0.0, 1.0) * clamp((size - away) / max(fwidth(away), 1e-4) + 0.5, 0.0, 1.0);
  // Of threads thinner than a pixel the mean is seen.
  float far = 2.0 * half_width * (1.0 - sqrt(clamp((away - 0.1) / (longest - 0.1), 0.0, 1.0)));
  return mix(near, far, smoothstep(0.7, 1.4, pixel));
}

float covered() {
  const float a_cell = 8.0;  // threads
  vec2 ends = vec2(thread_ends(a_cell * site.x, threads.z), thread_ends(a_cell * site.y, threads.z + 0.5));
  return away < 0.0 ? 1.0 : max(ends.x * threads.x, ends.y * threads.y);
}
#else
float covered() { return 1.0; }
#endif

const vec3 back_tint = vec3(0.40, 0.56, 0.58);  // sRGB

#ifdef COLORED
vec3 own_color() { return linear(value_color(value)); }
float own_darkness() { return 0.0; }
#else
vec3 own_color() {
  vec3 albedo = linear(texture(cloth, across).rgb);
  // The back is tinted, so that it is told from the front in a fold too.
  return gl_FrontFacing ? albedo : mix(albedo, linear(back_tint), 0.46);
}
// 1 for a cloth that is dark itself.
float own_darkness() {
  float whole = dot(linear(textureLod(cloth, vec2(0.5), 16.0).rgb), vec3(0.3, 0.6, 0.1));
  return 1.0 - smoothstep(0.03, 0.10, whole);
}
#endif

void main() {
  float cover = covered();
#ifdef FRAYED
  if (cover < 0.02) discard;
#endif
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
  color = vec4(display(albedo * mix(0.45, 1.0, shade)), 1.0) * cover;
#else
  vec3 halfway = normalize(to_light.xyz + to_eye);
  float sheen = (0.22 + 0.5 * dark) * grazing * grazing * grazing;
  float gloss = facing > 0.0 ? 0.05 * pow(clamp(dot(n, halfway), 0.0, 1.0), 14.0) : 0.0;
  vec3 reflected = albedo * light * (1.0 + sheen * 2.0) + sheen * 0.05 * sky_light + gloss * lit;
  color = vec4(display(exposed(reflected)), 1.0) * cover;
#endif
}
