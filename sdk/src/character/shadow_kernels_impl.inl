// The kernels over one vector type. Each instruction set includes this file inside its own namespace, after
// defining there
//   Float, a vector of `width` numbers with the operations of core/simd_scalar.h,
//   broadcast, load, store, and gather from 16-bit and 32-bit indices.
// Everything here has internal linkage or a name that contains the instruction set's type: code compiled for
// a better processor can never be merged into a function that an older one runs.

namespace {

enum class NormPower { one, three_halves, two, general };

constexpr NormPower norm_power(float gamma) {
  if (gamma == 1.0f) return NormPower::one;
  if (gamma == 1.5f) return NormPower::three_halves;
  if (gamma == 2.0f) return NormPower::two;
  return NormPower::general;
}

template <NormPower P>
Float raised(Float y, [[maybe_unused]] Float gamma) {
  if constexpr (P == NormPower::one) return y;
  if constexpr (P == NormPower::three_halves) return y * sqrt_fast(y);
  if constexpr (P == NormPower::two) return y * y;
  if constexpr (P == NormPower::general) return power(y, gamma);
}

struct Points {
  Float x, y, z, nx, ny, nz;
};

Points load_points(const KeyPointSoa& points, std::uint32_t k) {
  return {load(points.x + k),  load(points.y + k),  load(points.z + k),
          load(points.nx + k), load(points.ny + k), load(points.nz + k)};
}

struct Seen {
  Float xi, delta2;
};

Seen see(const SphereSoa& spheres, std::uint32_t i, const Points& p) {
  const Float dx = broadcast(spheres.x[i]) - p.x;
  const Float dy = broadcast(spheres.y[i]) - p.y;
  const Float dz = broadcast(spheres.z[i]) - p.z;
  const Float inverse_radius = broadcast(spheres.inverse_radius[i]);
  const Float height = fma(dx, p.nx, fma(dy, p.ny, dz * p.nz));
  const Float distance2 = fma(dx, dx, fma(dy, dy, dz * dz));
  return {height * inverse_radius, distance2 * (inverse_radius * inverse_radius)};
}

template <KernelForm Form, NormPower P>
void norm_sum(const SphereSoa& spheres, const KeyPointSoa& points, float gamma, float* sum) {
  const Float exponent = broadcast(gamma);
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points p = load_points(points, k);
    Float total = load(sum + k);
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const Seen seen = see(spheres, i, p);
      total = total + raised<P>(shadow_term(Form, seen.xi, seen.delta2), exponent);
    }
    store(sum + k, total);
  }
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

void norm_root(const float* sum, std::uint32_t padded_count, float gamma, float* shadow) {
  const NormPower p = norm_power(gamma);
  const Float exponent = broadcast(1 / gamma);
  for (std::uint32_t k = 0; k < padded_count; k += width) {
    const Float s = load(sum + k);
    store(shadow + k, p == NormPower::one ? s : p == NormPower::two ? sqrt(s) : power(s, exponent));
  }
}

void composed_depth(const SphereSoa& spheres, const KeyPointSoa& points, float* depth) {
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points p = load_points(points, k);
    Float total = load(depth + k);
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const Seen seen = see(spheres, i, p);
      total = fma(broadcast(spheres.caster_weight[i]), form_factor_fast(seen.xi, seen.delta2), total);
    }
    store(depth + k, total);
  }
}

void exact_open(const SphereSoa& spheres, const KeyPointSoa& points, float* open) {
  const Float one = broadcast(1.0f);
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points p = load_points(points, k);
    Float product = load(open + k);
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const Seen seen = see(spheres, i, p);
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

// min and max answer with their second operand when one is NaN, so that a NaN comes out as 1, open.
Float clamped_open(Float a) {
  return max(min(a, broadcast(1.0f)), broadcast(0.0f));
}

template <bool Added>
void linear_blocks(const LinearView& layer, const float* shadow, const float* occlusion, float* ao) {
  constexpr std::uint32_t parts = linear_block_vertices / width;
  for (std::uint32_t b = 0; b < layer.block_count; ++b) {
    const LinearBlock block = layer.blocks[b];
    Float shaded[parts], added[parts];
    for (std::uint32_t p = 0; p < parts; ++p) shaded[p] = added[p] = broadcast(0.0f);
    for (std::uint32_t e = 0; e < block.entries; ++e) {
      const std::uint32_t first = block.first_entry + e * linear_block_vertices;
      for (std::uint32_t p = 0; p < parts; ++p) {
        const Float alpha = load(layer.alpha + first + p * width);
        shaded[p] = fma(alpha, gather(shadow, layer.key_point + first + p * width), shaded[p]);
        if constexpr (Added)
          added[p] = fma(alpha, gather(occlusion, layer.key_point + first + p * width), added[p]);
      }
    }
    for (std::uint32_t p = 0; p < parts; ++p) {
      const std::uint32_t slot = b * linear_block_vertices + p * width;
      Float open = clamped_open(load(layer.open_bias + slot) - shaded[p]);
      if constexpr (Added)
        open = open * clamped_open(broadcast(1.0f) - added[p] * load(layer.inverse_alpha_sum + slot));
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

void scatter(const float* values, const std::uint32_t* index, std::uint32_t count, float* out,
             std::size_t stride_bytes) {
  std::uint32_t i = 0;
  if (stride_bytes == sizeof(float))
    for (; i + width <= count; i += width) store(out + i, gather(values, index + i));
  char* target = reinterpret_cast<char*>(out) + i * stride_bytes;
  for (; i < count; ++i, target += stride_bytes) *reinterpret_cast<float*>(target) = values[index[i]];
}

}  // namespace
