#version 330 core
in float strength;
uniform vec4 ink;  // sRGB and opacity
out vec4 colour;   // premultiplied

void main() { colour = vec4(ink.rgb, 1.0) * (ink.a * strength); }
