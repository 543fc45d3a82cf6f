// Light in linear color. Display values are squared and rooted (gamma 2), which is close to sRGB and cheap.
uniform sampler2DShadow shadow_map;

vec3 linear(vec3 display) { return display * display; }
vec3 display(vec3 linear_color) { return sqrt(max(linear_color, 0.0)); }

// Bends bright light over, so that a light cloth in full light keeps its color.
vec3 exposed(vec3 light) { return light * (1.14 + 0.30 * light) / (1.0 + light); }

const vec3 key_light = vec3(1.48, 1.39, 1.26);
const vec3 sky_light = vec3(0.34, 0.38, 0.46);
const vec3 floor_light = vec3(0.11, 0.11, 0.12);

// Part of the key light that reaches p, 0 to 1, softened over a few texels. `n` is the side of the surface that is
// turned to the light: p is looked up a little off the surface, so that a surface does not shade itself.
float sunlight(vec3 p, vec3 n, float blur) {
  if (to_light.w == 0.0) return 1.0;
  vec3 s = (shadow_from_world * vec4(p + n * (2.2 * viewport.z), 1.0)).xyz;
  if (any(lessThan(s.xy, vec2(0.0))) || any(greaterThan(s.xy, vec2(1.0)))) return 1.0;
  s.z = min(s.z, 1.0);
  vec2 texel = blur / vec2(textureSize(shadow_map, 0));
  float sum = texture(shadow_map, s);
  if (to_light.w > 1.5) return sum;
  sum += texture(shadow_map, s + vec3(texel * vec2(0.94, 0.35), 0.0));
  sum += texture(shadow_map, s + vec3(texel * vec2(-0.35, 0.94), 0.0));
  sum += texture(shadow_map, s + vec3(texel * vec2(-0.94, -0.35), 0.0));
  sum += texture(shadow_map, s + vec3(texel * vec2(0.35, -0.94), 0.0));
  return sum * 0.2;
}

vec3 ambient(vec3 n) { return mix(floor_light, sky_light, 0.5 + 0.5 * n.y); }
