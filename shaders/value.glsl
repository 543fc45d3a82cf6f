// The color of a value, sRGB, for a cloth that is colored by values instead of its texture.
uniform sampler2D color_map;  // one row, from the least value to the greatest
uniform vec3 value_range;     // the least; 1 / (greatest - least); 1 where colors follow the square root

vec3 value_color(float value) {
  if (isnan(value)) return vec3(0.5);
  float at = clamp((value - value_range.x) * value_range.y, 0.0, 1.0);
  if (value_range.z > 0.5) at = sqrt(at);
  float texels = float(textureSize(color_map, 0).x);
  return texture(color_map, vec2((at * (texels - 1.0) + 0.5) / texels, 0.5)).rgb;
}
