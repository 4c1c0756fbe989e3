// Finds the terms of a tensor for a view. sdk/src/gl/material/material_glsl.cpp writes this text once for the
// BTF and once for the VOTF. It replaces "tensor" by "btf" or "votf", and "TENSOR" by "BTF" or "VOTF". Both
// cannot share functions, because some tensors have no membership texture.

// Returns four modes of a cluster, averaged over several places.
vec4 nook_tensor_mean(int cluster, int mode, NookMaterialFetches at) {
  vec4 mean = nook_tensor_mode(cluster, mode, at.place[0], at.level);
  for (int i = 1; i < at.count; ++i)
    mean += (nook_tensor_mode(cluster, mode, at.place[i], at.level) - mean) / float(i + 1);
  return mean;
}

// Finds the terms of a view. `place` is the nook_parabolic_place of the view, and `cell` is the cell that
// contains it.
NookMaterialTerms nook_tensor_terms(vec2 place, ivec2 cell) {
#if NOOK_TENSOR_BLENDED
  uvec4 last = texelFetch(nook_tensor_membership, ivec3(cell, NOOK_TENSOR_TERMS / 4), 0);
  return NookMaterialTerms(nook_material_blend(place, cell, int(last[NOOK_TENSOR_TERMS % 4])), uvec4(0u), last);
#else
  return NookMaterialTerms(NookMaterialCell(cell, cell, cell, 0.0, 0.0), uvec4(0u), uvec4(0u));
#endif
}

// Returns the cluster of term k. Call it for all terms in ascending order, because it fetches the clusters of
// four terms at once and keeps them in `terms`.
int nook_tensor_cluster(inout NookMaterialTerms terms, int k) {
#if NOOK_TENSOR_CLUSTERS > 1
#if NOOK_TENSOR_BLENDED
  if (k % 4 == 0)
    terms.clusters = k / 4 == NOOK_TENSOR_TERMS / 4
                         ? terms.last
                         : texelFetch(nook_tensor_membership, ivec3(terms.cell.cell, k / 4), 0);
#else
  if (k % 4 == 0) terms.clusters = texelFetch(nook_tensor_membership, ivec3(terms.cell.cell, k / 4), 0);
#endif
#endif
  return int(terms.clusters[k % 4]);
}

// Returns the coefficients of the view for modes 4 b to 4 b + 3 of term k.
vec4 nook_tensor_weights(NookMaterialTerms terms, int k, int b) {
#if NOOK_TENSOR_BLENDED
  return nook_material_blended(nook_tensor_coefficients, terms.cell, k * NOOK_TENSOR_VIEW_VEC4_COUNT + b);
#else
  return texelFetch(nook_tensor_coefficients, ivec3(terms.cell.cell, k * NOOK_TENSOR_VIEW_VEC4_COUNT + b), 0);
#endif
}
