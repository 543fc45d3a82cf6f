#include "frame.glsl"
out vec4 color;

// A little noise, less than a step of 8 bits, keeps the dark gradient from banding.
float dither(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5; }

void main() {
  float height = gl_FragCoord.y / viewport.y;
  vec3 gradient = mix(background_bottom.rgb, background_top.rgb, smoothstep(0.0, 1.0, height));
  color = vec4(gradient + dither(gl_FragCoord.xy) / 255.0, 1.0);
}
