// The table of one instruction set. Include this file after the other parts of the kernels, in the same
// namespace.

namespace {

constexpr ShadowKernels table{isa,
                              isa_name(isa),
                              self_norm_sum,
                              tree_sum,
                              norm_root,
                              composed_depth,
                              exact_open,
                              composed_occlusion,
                              encode_points,
                              linear_layer,
                              pose_spheres,
                              pose_key_points,
                              directional_norm_sum,
                              directional_hemisphere,
                              directional_depth,
                              directional_open,
                              directional_ground,
                              directional_linear_layer};

}  // namespace

const ShadowKernels& kernels() {
  return table;
}
