// A bilateral filter over 3 x 3 texels. It averages the noise of the taps, which repeats after as many
// texels. Only texels that the edges connect and whose AO is similar take part.
uniform sampler2D nook_ao;  // AO, edges, and the bent normal in passes that have it

uint nook_edge_bits(float packed_edges) {
  return uint(255.0 * packed_edges + 0.5);
}

// Left, right, below, above; each is 0 to 3.
vec4 nook_edges_of(uint bits) {
  return vec4(bits >> 6u, bits >> 4u & 3u, bits >> 2u & 3u, bits & 3u);
}

struct NookFilterSum {
  float ao, weight;
  vec2 bent;
};

// centre and texel are values of nook_ao.
void nook_add_texel(inout NookFilterSum sum, vec4 centre, vec4 texel, float connected) {
  float weight = connected * clamp(2.0 - nook_range_sharpness * abs(texel.r - centre.r), 0.0, 1.0);
  sum.ao += weight * texel.r;
  sum.weight += weight;
#if NOOK_BENT_NORMALS
  sum.bent += weight * texel.ba;
#endif
}

// Weighs a corner. horizontal and vertical: the centre's edges on the way to it. back: the corner's edges on
// the way to the centre's neighbours, (along x, along y).
void nook_add_corner(inout NookFilterSum sum, vec4 centre, vec4 texel, float horizontal, float vertical, vec2 back) {
  nook_add_texel(sum, centre, texel, max(horizontal * back.y, vertical * back.x) / 9.0);
}

// Returns a texel after the filter; its edges stay the same.
vec4 nook_filtered(ivec2 texel, ivec2 last) {
  ivec2 low = max(texel - 1, ivec2(0)), high = min(texel + 1, last);
  vec4 centre = texelFetch(nook_ao, texel, 0);
  vec4 edges = nook_filter_strength * nook_edges_of(nook_edge_bits(centre.g));
  NookFilterSum sum = NookFilterSum(centre.r, 1.0, centre.ba);
  nook_add_texel(sum, centre, texelFetch(nook_ao, ivec2(low.x, texel.y), 0), edges.x / 3.0);
  nook_add_texel(sum, centre, texelFetch(nook_ao, ivec2(high.x, texel.y), 0), edges.y / 3.0);
  nook_add_texel(sum, centre, texelFetch(nook_ao, ivec2(texel.x, low.y), 0), edges.z / 3.0);
  nook_add_texel(sum, centre, texelFetch(nook_ao, ivec2(texel.x, high.y), 0), edges.w / 3.0);
  vec4 corner = texelFetch(nook_ao, low, 0);
  nook_add_corner(sum, centre, corner, edges.x, edges.z, nook_edges_of(nook_edge_bits(corner.g)).yw);
  corner = texelFetch(nook_ao, ivec2(high.x, low.y), 0);
  nook_add_corner(sum, centre, corner, edges.y, edges.z, nook_edges_of(nook_edge_bits(corner.g)).xw);
  corner = texelFetch(nook_ao, ivec2(low.x, high.y), 0);
  nook_add_corner(sum, centre, corner, edges.x, edges.w, nook_edges_of(nook_edge_bits(corner.g)).yz);
  corner = texelFetch(nook_ao, high, 0);
  nook_add_corner(sum, centre, corner, edges.y, edges.w, nook_edges_of(nook_edge_bits(corner.g)).xz);
  return vec4(sum.ao / sum.weight, centre.g, sum.bent / sum.weight);
}
