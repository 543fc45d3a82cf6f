#include "frame.glsl"
in vec3 position;
out vec4 color;  // premultiplied

// Coverage of lines `width` pixels thick at whole numbers of `at`; fades to its mean where lines crowd.
float lines(vec2 at, float width) {
  vec2 per_pixel = max(fwidth(at), 1e-6);
  vec2 distance_px = abs(fract(at - 0.5) - 0.5) / per_pixel;
  vec2 cover = clamp(0.5 * width + 0.5 - distance_px, 0.0, 1.0) * (1.0 - smoothstep(0.25, 0.6, per_pixel));
  return max(cover.x, cover.y);
}

void main() {
  float away = length(position.xz - focus.xz) / focus.w;
  float fade = 1.0 - smoothstep(1.0, 8.5, away);
  fade *= fade;
  vec2 at = position.xz / grid.w;
  // Faint, since it must not look like a floor: a cloth falls through it.
  float line = max(0.10 * lines(at, 1.0), 0.22 * lines(at / 5.0, 1.0)) * fade;
  color = vec4(grid.rgb * line, line);
}
