// The coloured forms of the kernels: the term of each sphere is multiplied by rho, the relative light behind
// the sphere. Include this file after shadow_kernels_impl.inl, in the same namespace.

namespace {

template <class F>
struct SeenDirection {
  Direction<F> offset;  // from the key point to the sphere's centre, in sphere radii
  F xi, delta2;
};

template <class F>
SeenDirection<F> see_direction(const SphereSoa& spheres, std::uint32_t i, const Points<F>& p) {
  const F inverse_radius = F(broadcast(spheres.inverse_radius[i]));
  const Direction<F> o{(F(broadcast(spheres.x[i])) - p.x) * inverse_radius,
                       (F(broadcast(spheres.y[i])) - p.y) * inverse_radius,
                       (F(broadcast(spheres.z[i])) - p.z) * inverse_radius};
  return {o, fma(o.x, p.nx, fma(o.y, p.ny, o.z * p.nz)), fma(o.x, o.x, fma(o.y, o.y, o.z * o.z))};
}

template <class F>
Direction<F> normal_of(const Points<F>& p) {
  return {p.nx, p.ny, p.nz};
}

Colour<Float> load_colour(float* const* rgb, std::uint32_t k) {
  return {load(rgb[0] + k), load(rgb[1] + k), load(rgb[2] + k)};
}
void store_colour(float* const* rgb, std::uint32_t k, const Colour<Float>& colour) {
  store(rgb[0] + k, colour.r);
  store(rgb[1] + k, colour.g);
  store(rgb[2] + k, colour.b);
}

template <KernelForm Form, NormPower P>
void directional_norm(const SphereSoa& spheres, const KeyPointSoa& points, float gamma,
                      const LightBands& light, float* const* rgb) {
  const Float exponent = broadcast(gamma);
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const Direction<Float> n = normal_of(p);
    GatheredBands<Float> gathered = GatheredBands<Float>::none();
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const SeenDirection<Float> seen = see_direction(spheres, i, p);
      const Float y = shadow_term(Form, seen.xi, seen.delta2);
      gather(gathered, n, sight_of(n, seen.offset, seen.xi, seen.delta2), y, raised<P>(y, exponent));
    }
    const Colour<Float> sum = coloured_sum(gathered, light, n), before = load_colour(rgb, k);
    store_colour(rgb, k, {before.r + sum.r, before.g + sum.g, before.b + sum.b});
  }
}

template <KernelForm Form>
void directional_norm_of_form(const SphereSoa& spheres, const KeyPointSoa& points, float gamma,
                              const LightBands& light, float* const* rgb) {
  switch (norm_power(gamma)) {
    case NormPower::one:
      return directional_norm<Form, NormPower::one>(spheres, points, gamma, light, rgb);
    case NormPower::three_halves:
      return directional_norm<Form, NormPower::three_halves>(spheres, points, gamma, light, rgb);
    case NormPower::two:
      return directional_norm<Form, NormPower::two>(spheres, points, gamma, light, rgb);
    case NormPower::general:
      return directional_norm<Form, NormPower::general>(spheres, points, gamma, light, rgb);
  }
}

void directional_norm_sum(const SphereSoa& spheres, const KeyPointSoa& points, const Kernel& kernel,
                          const LightBands& light, float* const* rgb) {
  switch (kernel.form) {
    case KernelForm::paper:
      return directional_norm_of_form<KernelForm::paper>(spheres, points, kernel.gamma, light, rgb);
    case KernelForm::nook:
      return directional_norm_of_form<KernelForm::nook>(spheres, points, kernel.gamma, light, rgb);
    case KernelForm::rational:
      return directional_norm_of_form<KernelForm::rational>(spheres, points, kernel.gamma, light, rgb);
  }
}

void directional_hemisphere(const KeyPointSoa& points, const LightView& light, float* const* inverse) {
  for (std::uint32_t k = 0; k < points.padded_count; k += width)
    store_colour(inverse, k, inverse_hemisphere(light, normal_of(load_points<Float>(points, k))));
}

template <class F>
JointSight<F> joint_sight(const SphereSoa& spheres, const Points<F>& p) {
  const Direction<F> n = normal_of(p);
  JointSight<F> joint;
  for (std::uint32_t i = 0; i < spheres.count; ++i) {
    const SeenDirection<F> seen = see_direction(spheres, i, p);
    joint.add(sight_of(n, seen.offset, seen.xi, seen.delta2),
              form_factor_fast(seen.xi, seen.delta2) * F(broadcast(spheres.caster_weight[i])));
  }
  return joint;
}

void add_depth(const JointSight<Float>& joint, const Points<Float>& p, const LightView& light,
               float* const* inverse, std::uint32_t k, float* const* rgb) {
  const Direction<Float> n = normal_of(p);
  const Colour<Float> ratio = light_ratio(light, load_colour(inverse, k), n, joint.mean(n),
                                          min(joint.taken, broadcast(1.0f)), joint.sharpest());
  const Colour<Float> total = load_colour(rgb, k);
  const Float depth = solid_depth(joint.taken);
  store_colour(rgb, k,
               {fma(depth, ratio.r, total.r), fma(depth, ratio.g, total.g), fma(depth, ratio.b, total.b)});
}

void directional_depth(const SphereSoa& spheres, const KeyPointSoa& points, const LightView& light,
                       float* const* inverse, float* const* rgb) {
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    add_depth(joint_sight(spheres, p), p, light, inverse, k, rgb);
  }
}

Colour<Float> left_of(const Colour<Float>& open, Float share, const Colour<Float>& ratio) {
  const Float one = broadcast(1.0f);
  return {open.r * (one - min(share * ratio.r, one)), open.g * (one - min(share * ratio.g, one)),
          open.b * (one - min(share * ratio.b, one))};
}

void directional_open(const SphereSoa& spheres, const KeyPointSoa& points, const LightView& light,
                      float* const* inverse, float* const* rgb) {
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const Direction<Float> n = normal_of(p);
    Colour<Float> open = load_colour(rgb, k);
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const SeenDirection<Float> seen = see_direction(spheres, i, p);
      const Float share = min(form_factor_exact(seen.xi, seen.delta2), broadcast(1.0f));
      open =
          left_of(open, share,
                  light_ratio(light, load_colour(inverse, k), n,
                              sight_of(n, seen.offset, seen.xi, seen.delta2), share, broadcast(no_sharpest)));
    }
    store_colour(rgb, k, open);
  }
}

void directional_ground(const SphereSoa& ground, const KeyPointSoa& points, const LightView& light, Vec3 up,
                        float* const* rgb) {
  const Direction<Float> above{broadcast(up.x), broadcast(up.y), broadcast(up.z)};
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const SeenDirection<Float> seen = see_direction(ground, 0, p);
    const Float share = min(form_factor_exact(seen.xi, seen.delta2), broadcast(1.0f));
    store_colour(rgb, k, left_of(load_colour(rgb, k), share, ground_ratio(light, normal_of(p), above)));
  }
}

// The sums over the key points, for `width` vertices.
struct DirectionalSum {
  Float shadow = broadcast(0.0f);
  Float coloured[3] = {shadow, shadow, shadow}, occlusion[3] = {shadow, shadow, shadow};
};

template <bool Added>
DirectionalSum directional_sum(const LinearView& layer, const LinearBlock& block, std::uint32_t lane,
                               const float* shadow, const float* const* coloured,
                               const float* const* occlusion) {
  DirectionalSum sum;
  for (std::uint32_t pair = block.first_pair; pair < block.first_pair + block.pairs; ++pair) {
    const std::size_t at = std::size_t{pair} * linear_pair_weights + 2 * lane;
    Float alpha[2], blend[2];
    load_pairs(layer.alpha + at, alpha[0], alpha[1]);
    if constexpr (Added) load_pairs(layer.blend + at, blend[0], blend[1]);
    for (std::uint32_t c = 0; c < 2; ++c) {
      const std::uint32_t k = layer.key_points[pair] >> 16 * c & 0xffff;
      const Float shaded = alpha[c] * broadcast(layer.alpha_step);
      sum.shadow = fma(shaded, broadcast(shadow[k]), sum.shadow);
      for (int i = 0; i < 3; ++i) sum.coloured[i] = fma(shaded, broadcast(coloured[i][k]), sum.coloured[i]);
      if constexpr (!Added) continue;
      const Float dark = blend[c] * broadcast(layer.blend_step);
      for (int i = 0; i < 3; ++i) sum.occlusion[i] = fma(dark, broadcast(occlusion[i][k]), sum.occlusion[i]);
    }
  }
  return sum;
}

template <bool Added>
void directional_blocks(const LinearView& layer, const float* shadow, const float* const* coloured,
                        const float* const* occlusion, float* const* rgb) {
  const Float one = broadcast(1.0f);
  for (std::uint32_t b = 0; b < layer.block_count; ++b)
    for (std::uint32_t lane = 0; lane < linear_block_vertices; lane += width) {
      const DirectionalSum sum =
          directional_sum<Added>(layer, layer.blocks[b], lane, shadow, coloured, occlusion);
      const std::uint32_t slot = b * linear_block_vertices + lane;
      const Float dark = max(sum.shadow + (one - load(layer.open_bias + slot)), broadcast(0.0f));
      for (int c = 0; c < 3; ++c) {
        Float open = clamped_open(one - dark * vertex_light_ratio(sum.coloured[c], sum.shadow));
        if constexpr (Added) open = open * clamped_open(one - sum.occlusion[c]);
        store(rgb[c] + slot, open);
      }
    }
}

void directional_linear_layer(const LinearView& layer, const float* shadow, const float* const* coloured,
                              const float* const* occlusion, float* const* rgb) {
  if (occlusion)
    directional_blocks<true>(layer, shadow, coloured, occlusion, rgb);
  else
    directional_blocks<false>(layer, shadow, coloured, nullptr, rgb);
}

}  // namespace
