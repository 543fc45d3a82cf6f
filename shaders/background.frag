#include "frame.glsl"
#include "dither.glsl"
out vec4 color;

void main() {
  float height = gl_FragCoord.y / viewport.y;
  vec3 gradient = mix(background_bottom.rgb, background_top.rgb, smoothstep(0.0, 1.0, height));
  color = vec4(gradient + dither(gl_FragCoord.xy) / 255.0, 1.0);
}
