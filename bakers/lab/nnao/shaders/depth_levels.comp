#version 430 core
// Makes all of XeGTAO's depth levels in the same way as the original. Each thread reads four pixels. Coarser
// levels are made from shared memory by fewer threads.
#include "bakers/lab/nnao/shaders/edges.glsl"
#include "bakers/lab/nnao/shaders/depth_levels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(r32f, binding = 0) writeonly uniform image2D level_0;
layout(r32f, binding = 1) writeonly uniform image2D level_1;
layout(r32f, binding = 2) writeonly uniform image2D level_2;
layout(r32f, binding = 3) writeonly uniform image2D level_3;
layout(r32f, binding = 4) writeonly uniform image2D level_4;
uniform sampler2D depth_image;
uniform vec2 texel;  // 1 / size

shared float depths[64];

// Makes a texel of the next coarser level. The threads that hold neighbouring texels of the current level are
// `apart` threads from each other. Returns 0 in threads that make no texel.
float next_level(uint apart) {
  barrier();
  uint at = gl_LocalInvocationIndex;
  float depth = 0.0;
  if (((gl_LocalInvocationID.x | gl_LocalInvocationID.y) & (2u * apart - 1u)) == 0u) {
    depth = coarser_depth(vec4(depths[at], depths[at + apart], depths[at + 8u * apart], depths[at + 9u * apart]));
    // This write is safe, because no other thread reads the value before the next barrier.
    depths[at] = depth;
  }
  return depth;
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  vec4 four = min(textureGather(depth_image, vec2(2 * at + 1) * texel), vec4(far_depth));
  imageStore(level_0, 2 * at, vec4(four.w));
  imageStore(level_0, 2 * at + ivec2(1, 0), vec4(four.z));
  imageStore(level_0, 2 * at + ivec2(0, 1), vec4(four.x));
  imageStore(level_0, 2 * at + ivec2(1, 1), vec4(four.y));
  float depth = coarser_depth(four);
  imageStore(level_1, at, vec4(depth));
  depths[gl_LocalInvocationIndex] = depth;
  depth = next_level(1u);
  if (depth > 0.0) imageStore(level_2, at / 2, vec4(depth));
  depth = next_level(2u);
  if (depth > 0.0) imageStore(level_3, at / 4, vec4(depth));
  depth = next_level(4u);
  if (depth > 0.0) imageStore(level_4, at / 8, vec4(depth));
}
