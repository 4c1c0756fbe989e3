#version 430 core
// The edge-aware denoiser as XeGTAO runs it: each thread computes two adjacent pixels from texture gathers.
#include "bakers/lab/nnao/shaders/denoise.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(r8, binding = 0) writeonly uniform image2D target;
uniform sampler2D ao_image;
uniform sampler2D edge_image;
uniform vec2 texel;  // 1 / size

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * ivec2(2, 1);
  vec2 corner = vec2(pixel) * texel;
  // In a gather, x and y are the upper left and right texels, and w and z the lower left and right texels.
  vec4 e0 = textureGather(edge_image, corner), e1 = textureGather(edge_image, corner + vec2(2.0, 0.0) * texel);
  vec4 e2 = textureGather(edge_image, corner + vec2(1.0, 2.0) * texel);
  vec4 a0 = textureGather(ao_image, corner), a1 = textureGather(ao_image, corner + vec2(2.0, 0.0) * texel);
  vec4 a2 = textureGather(ao_image, corner + vec2(0.0, 2.0) * texel), a3 = textureGather(ao_image, corner + 2.0 * texel);
  vec4 left = unpack_edges(e0.y), right = unpack_edges(e1.x);
  Edges first = Edges(left, unpack_edges(e0.x), right, unpack_edges(e0.z), unpack_edges(e2.w));
  Edges second = Edges(right, left, unpack_edges(e1.y), unpack_edges(e1.w), unpack_edges(e2.z));
  imageStore(target, pixel, vec4(denoised(first, a0.y, vec4(a0.x, a1.x, a0.z, a2.z), vec4(a0.w, a1.w, a2.w, a3.w))));
  imageStore(target, pixel + ivec2(1, 0),
             vec4(denoised(second, a1.x, vec4(a0.y, a1.y, a1.w, a3.w), vec4(a0.z, a1.z, a2.z, a3.z))));
}
