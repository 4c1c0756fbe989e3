// Computes a texel of XeGTAO's coarser depth levels as a weighted mean of four texels. Texels far in front of
// the farthest texel get less weight.
uniform float level_radius_m;  // three quarters of the tuned radius
uniform float falloff;         // share of the radius over which weights fall

float coarser_depth(vec4 depth) {
  float farthest = max(max(depth.x, depth.y), max(depth.z, depth.w));
  vec4 weight = clamp((1.0 - (farthest - depth) / level_radius_m) / falloff, 0.0, 1.0);
  return dot(weight, depth) / dot(weight, vec4(1.0));
}
