// A little noise, less than a step of 8 bits, keeps a dark gradient from banding.
float dither(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5; }
