// The kernels over one vector type. Each instruction set includes this file inside its own namespace, after
// it has defined
//   isa, its Isa,
//   Float, a vector of `width` numbers with the operations of core/simd_scalar.h,
//   broadcast, load and store.
// Everything here has internal linkage or a name that contains the instruction set's type, so that code for a
// newer processor can never be merged into a function that an older one runs.

namespace {

// Loads and stores of a number type, which is one vector or a pair of them.
template <class F>
struct Lanes {
  static constexpr std::uint32_t count = width;
  static F read(const float* p) { return load(p); }
  static void write(float* p, F a) { store(p, a); }
};
template <class V>
struct Lanes<simd::Pair<V>> {
  static constexpr std::uint32_t count = 2 * width;
  static simd::Pair<V> read(const float* p) { return {load(p), load(p + width)}; }
  static void write(float* p, simd::Pair<V> a) {
    store(p, a.a);
    store(p + width, a.b);
  }
};

enum class NormPower { one, three_halves, two, general };

constexpr NormPower norm_power(float gamma) {
  if (gamma == 1.0f) return NormPower::one;
  if (gamma == 1.5f) return NormPower::three_halves;
  if (gamma == 2.0f) return NormPower::two;
  return NormPower::general;
}

template <NormPower P, class F>
F raised(F y, [[maybe_unused]] F gamma) {
  if constexpr (P == NormPower::one) return y;
  if constexpr (P == NormPower::three_halves) return power_three_halves(y);
  if constexpr (P == NormPower::two) return y * y;
  if constexpr (P == NormPower::general) return power(y, gamma);
}

template <class F>
struct Points {
  F x, y, z, nx, ny, nz;
};

template <class F>
Points<F> load_points(const KeyPointSoa& points, std::uint32_t k) {
  return {Lanes<F>::read(points.x + k),  Lanes<F>::read(points.y + k),  Lanes<F>::read(points.z + k),
          Lanes<F>::read(points.nx + k), Lanes<F>::read(points.ny + k), Lanes<F>::read(points.nz + k)};
}

template <class F>
struct Seen {
  F xi, delta2;
};

template <class F>
Seen<F> see(const SphereSoa& spheres, std::uint32_t i, const Points<F>& p) {
  const F dx = F(broadcast(spheres.x[i])) - p.x;
  const F dy = F(broadcast(spheres.y[i])) - p.y;
  const F dz = F(broadcast(spheres.z[i])) - p.z;
  const F inverse_radius = F(broadcast(spheres.inverse_radius[i]));
  const F height = fma(dx, p.nx, fma(dy, p.ny, dz * p.nz));
  const F distance2 = fma(dx, dx, fma(dy, dy, dz * dz));
  return {height * inverse_radius, distance2 * inverse_radius * inverse_radius};
}

template <KernelForm Form, NormPower P, class F>
void norm_sum_at(const SphereSoa& spheres, const KeyPointSoa& points, float gamma, std::uint32_t k,
                 float* sum) {
  const F exponent = F(broadcast(gamma));
  const Points<F> p = load_points<F>(points, k);
  F total = Lanes<F>::read(sum + k);
  for (std::uint32_t i = 0; i < spheres.count; ++i) {
    const Seen<F> seen = see(spheres, i, p);
    total = total + raised<P>(shadow_term(Form, seen.xi, seen.delta2), exponent);
  }
  Lanes<F>::write(sum + k, total);
}

template <KernelForm Form, NormPower P>
void norm_sum(const SphereSoa& spheres, const KeyPointSoa& points, float gamma, float* sum) {
  std::uint32_t k = 0;
  for (; k + Lanes<Wide>::count <= points.padded_count; k += Lanes<Wide>::count)
    norm_sum_at<Form, P, Wide>(spheres, points, gamma, k, sum);
  for (; k < points.padded_count; k += width) norm_sum_at<Form, P, Float>(spheres, points, gamma, k, sum);
}

template <KernelForm Form>
void norm_sum_of_form(const SphereSoa& spheres, const KeyPointSoa& points, float gamma, float* sum) {
  switch (norm_power(gamma)) {
    case NormPower::one:
      return norm_sum<Form, NormPower::one>(spheres, points, gamma, sum);
    case NormPower::three_halves:
      return norm_sum<Form, NormPower::three_halves>(spheres, points, gamma, sum);
    case NormPower::two:
      return norm_sum<Form, NormPower::two>(spheres, points, gamma, sum);
    case NormPower::general:
      return norm_sum<Form, NormPower::general>(spheres, points, gamma, sum);
  }
}

void self_norm_sum(const SphereSoa& spheres, const KeyPointSoa& points, const Kernel& kernel, float* sum) {
  switch (kernel.form) {
    case KernelForm::paper:
      return norm_sum_of_form<KernelForm::paper>(spheres, points, kernel.gamma, sum);
    case KernelForm::nook:
      return norm_sum_of_form<KernelForm::nook>(spheres, points, kernel.gamma, sum);
    case KernelForm::rational:
      return norm_sum_of_form<KernelForm::rational>(spheres, points, kernel.gamma, sum);
  }
}

template <class F>
struct SeenMass {
  F h, d2_and_core;
};

template <class F>
SeenMass<F> see_mass(const MassSphere& sphere, const Points<F>& p) {
  const F dx = F(broadcast(sphere.x)) - p.x;
  const F dy = F(broadcast(sphere.y)) - p.y;
  const F dz = F(broadcast(sphere.z)) - p.z;
  return {fma(dx, p.nx, fma(dy, p.ny, dz * p.nz)),
          fma(dx, dx, fma(dy, dy, fma(dz, dz, F(broadcast(sphere.core)))))};
}

template <class F>
F shadow_of_mass(const MassSphere& sphere, const SeenMass<F>& seen) {
  return shadow_nook_of_mass(seen.h, seen.d2_and_core, F(broadcast(sphere.softness)),
                             F(broadcast(sphere.mass)));
}

// One group of key points.
constexpr std::uint32_t group_parts = key_point_group / width;

std::uint64_t tree_sum_at(const SphereTreeView& tree, const KeyPointSoa& points, std::uint32_t k,
                          float* sum) {
  Points<Float> p[group_parts];
  Float total[group_parts];
  for (std::uint32_t i = 0; i < group_parts; ++i) {
    p[i] = load_points<Float>(points, k + i * width);
    total[i] = load(sum + k + i * width);
  }
  std::uint64_t evaluated = 0;
  for (std::uint32_t n = 0; n < tree.count;) {
    const SphereTreeNode& shape = tree.shape[n];
    const MassNode& node = tree.nodes[n];
    SeenMass<Float> seen[group_parts];
    std::uint32_t near = 0;
    for (std::uint32_t i = 0; i < group_parts; ++i) {
      seen[i] = see_mass(node.merged, p[i]);
      near |= bits(less(seen[i].d2_and_core, broadcast(node.reach)));
    }
    if (!near) {
      for (std::uint32_t i = 0; i < group_parts; ++i)
        total[i] = total[i] + shadow_of_mass(node.merged, seen[i]);
      ++evaluated;
    } else if (shape.next == n + 1) {
      for (std::uint32_t s = shape.begin; s < shape.end; ++s)
        for (std::uint32_t i = 0; i < group_parts; ++i)
          total[i] = total[i] + shadow_of_mass(tree.spheres[s], see_mass(tree.spheres[s], p[i]));
      evaluated += shape.end - shape.begin;
    } else {
      ++n;
      continue;
    }
    n = shape.next;
  }
  for (std::uint32_t i = 0; i < group_parts; ++i) store(sum + k + i * width, total[i]);
  return evaluated;
}

std::uint64_t tree_sum(const SphereTreeView& tree, const KeyPointSoa& points, float* sum) {
  std::uint64_t evaluated = 0;
  for (std::uint32_t k = 0; k < points.padded_count; k += key_point_group)
    evaluated += key_point_group * tree_sum_at(tree, points, k, sum);
  return evaluated;
}

void norm_root(const float* sum, std::uint32_t padded_count, float gamma, float* shadow) {
  const NormPower p = norm_power(gamma);
  const Float exponent = broadcast(1 / gamma);
  for (std::uint32_t k = 0; k < padded_count; k += width) {
    const Float s = load(sum + k);
    store(shadow + k, p == NormPower::one ? s : p == NormPower::two ? sqrt(s) : power(s, exponent));
  }
}

template <class F>
void composed_depth_at(const SphereSoa& spheres, const KeyPointSoa& points, std::uint32_t k, float* depth) {
  const Points<F> p = load_points<F>(points, k);
  F sum = F(broadcast(0.0f));
  for (std::uint32_t i = 0; i < spheres.count; ++i) {
    const Seen<F> seen = see(spheres, i, p);
    sum = fma(F(broadcast(spheres.caster_weight[i])), form_factor_fast(seen.xi, seen.delta2), sum);
  }
  Lanes<F>::write(depth + k, Lanes<F>::read(depth + k) + solid_depth(sum));
}

void composed_depth(const SphereSoa& spheres, const KeyPointSoa& points, float* depth) {
  std::uint32_t k = 0;
  for (; k + Lanes<Wide>::count <= points.padded_count; k += Lanes<Wide>::count)
    composed_depth_at<Wide>(spheres, points, k, depth);
  for (; k < points.padded_count; k += width) composed_depth_at<Float>(spheres, points, k, depth);
}

void exact_open(const SphereSoa& spheres, const KeyPointSoa& points, float* open) {
  const Float one = broadcast(1.0f);
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    Float product = load(open + k);
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const Seen<Float> seen = see(spheres, i, p);
      const Float weight = spheres.caster_weight ? broadcast(spheres.caster_weight[i]) : one;
      product = product * (one - min(weight * form_factor_exact(seen.xi, seen.delta2), one));
    }
    store(open + k, product);
  }
}

void composed_occlusion(const float* depth, const float* open, std::uint32_t padded_count, float* occlusion) {
  const Float one = broadcast(1.0f);
  for (std::uint32_t k = 0; k < padded_count; k += width) {
    Float left = open ? load(open + k) : one;
    if (depth) left = left * exponential(broadcast(0.0f) - load(depth + k));
    store(occlusion + k, one - left);
  }
}

// min and max return their second operand if one operand is NaN, so that a NaN becomes 1, open.
Float clamped_open(Float a) {
  return max(min(a, broadcast(1.0f)), broadcast(0.0f));
}

// The weighted sums of the vertices of a block over some of its columns.
template <bool Added>
struct BlockSums {
  static constexpr std::uint32_t parts = linear_block_vertices / width;

  Float shaded[parts], added[parts];

  BlockSums() {
    for (std::uint32_t p = 0; p < parts; ++p) shaded[p] = added[p] = broadcast(0.0f);
  }
  void add(const LinearView& layer, std::uint32_t column, const float* shadow, const float* occlusion) {
    const std::uint16_t k = layer.key_point[column];
    const Float gamma = broadcast(shadow[k]), dark = broadcast(Added ? occlusion[k] : 0.0f);
    for (std::uint32_t p = 0; p < parts; ++p) {
      const std::size_t at = std::size_t{column} * linear_block_vertices + p * width;
      shaded[p] = fma(load_short(layer.alpha + at), gamma, shaded[p]);
      if constexpr (Added) added[p] = fma(load_short(layer.blend + at), dark, added[p]);
    }
  }
};

// Even and odd columns have sums of their own, because each addition to a sum waits for the one before.
template <bool Added>
void linear_blocks(const LinearView& layer, const float* shadow, const float* occlusion, float* ao) {
  const Float alpha_step = broadcast(layer.alpha_step), blend_step = broadcast(layer.blend_step);
  for (std::uint32_t b = 0; b < layer.block_count; ++b) {
    const LinearBlock block = layer.blocks[b];
    BlockSums<Added> even, odd;
    const std::uint32_t end = block.first_column + block.columns;
    std::uint32_t c = block.first_column;
    for (; c + 1 < end; c += 2) {
      even.add(layer, c, shadow, occlusion);
      odd.add(layer, c + 1, shadow, occlusion);
    }
    if (c < end) even.add(layer, c, shadow, occlusion);
    for (std::uint32_t p = 0; p < BlockSums<Added>::parts; ++p) {
      const std::uint32_t slot = b * linear_block_vertices + p * width;
      Float open = clamped_open(load(layer.open_bias + slot) - (even.shaded[p] + odd.shaded[p]) * alpha_step);
      if constexpr (Added)
        open = open * clamped_open(broadcast(1.0f) - (even.added[p] + odd.added[p]) * blend_step);
      store(ao + slot, open);
    }
  }
}

void linear_layer(const LinearView& layer, const float* shadow, const float* occlusion, float* ao) {
  if (occlusion)
    linear_blocks<true>(layer, shadow, occlusion, ao);
  else
    linear_blocks<false>(layer, shadow, nullptr, ao);
}

}  // namespace
