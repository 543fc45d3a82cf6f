#include "frame.glsl"
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in float z;
uniform float spacing;   // m between particles
uniform vec3 diameter;   // part of the spacing; least and most pixels
uniform float toward;   // part of the scene's radius by which the mark stands nearer, to lie upon the cloth
#ifdef COLORED
#include "values.glsl"
out float value;
#endif
out float strength;
flat out float radius;   // px

void main() {
  vec3 at = vec3(x, y, z);
  gl_Position = clip_from_world * vec4(at, 1.0);
  gl_PointSize = clamp(diameter.x * spacing * eye.w / gl_Position.w, diameter.y, diameter.z);
  radius = 0.5 * gl_PointSize;
  float depth = (gl_Position.w - length(eye.xyz - focus.xyz)) / focus.w;
  strength = clamp(0.8 - 0.35 * depth, 0.35, 1.0);
#ifdef COLORED
  strength = 1.0;  // colors are to be compared with a legend, near and far
  value = particle_value(gl_VertexID);
#endif
  if (toward > 0.0) {
    vec4 nearer = clip_from_world * vec4(mix(at, eye.xyz, min(toward * focus.w / length(eye.xyz - at), 0.5)), 1.0);
    gl_Position.z = nearer.z / nearer.w * gl_Position.w;
    strength = 1.0;
  }
}
