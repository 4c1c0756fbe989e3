#version 330 core
// Computes the mean of 4 x 4 pixels, which is the period of the noise. It ignores depth and normals (J.
// Chapman's tutorial of SSAO, 2013).
uniform sampler2D ao_image;
uniform ivec2 size_px;

out float result;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float sum = 0.0;
  for (int y = -2; y < 2; ++y)
    for (int x = -2; x < 2; ++x) sum += texelFetch(ao_image, clamp(pixel + ivec2(x, y), ivec2(0), size_px - 1), 0).r;
  result = sum / 16.0;
}
