// Data common to all stages of a frame, set by app/render/cloth_renderer.cpp.
layout(std140) uniform Frame {
  mat4 clip_from_world;
  mat4 shadow_from_world;  // to 0..1 in each axis
  vec4 eye;                // xyz, m; w: pixels per meter at a depth of 1 m
  vec4 to_light;           // unit vector; w: 1 with soft shadows, 2 with hard ones, 0 without
  vec4 viewport;           // width, height in pixels; z: m per texel of the shadow map; w: height of the ground, m
  vec4 focus;              // center of the scene, m; w: its radius
  vec4 background_top;     // sRGB
  vec4 background_bottom;
  vec4 grid;               // sRGB; w: spacing of the ground's lines, m
};
