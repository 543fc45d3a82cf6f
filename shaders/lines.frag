in float strength;
uniform vec4 ink;  // sRGB and opacity
out vec4 color;   // premultiplied

#ifdef COLORED
#include "value.glsl"
in float value;
vec3 own_color() { return value_color(value); }
#else
vec3 own_color() { return ink.rgb; }
#endif

void main() { color = vec4(own_color(), 1.0) * (ink.a * strength); }
