// The kernels for one vector type. Each instruction set includes this file inside its own namespace. Before
// that, it must define
//   isa, its Isa,
//   Float, a vector of `width` numbers with the operations of core/simd_scalar.h,
//   broadcast, load and store,
//   Whole, a vector of `width` integers, and CodePair, a pair of 16-bit integers that is the same in all lanes,
//   code_pair(low, high), which makes a CodePair from the two halves of a word,
//   add_products(p, codes, sum), which reads two integers for each lane from p on, multiplies them by the
//   CodePair and adds the products to `sum`,
//   load_pairs(p, first, second), which loads the same integers, and
//   store_codes(low, high, a), which stores codes in the form of PointCodes.
// Everything here has internal linkage, or a mangled name that contains a type of the instruction set.
// Otherwise the linker could merge equal functions, and keep the copy that uses instructions which an older
// processor does not have.

namespace {

// Loads and stores the type F, which is a vector or a pair of vectors.
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

Float shadow_of_mass(const PosedSphereTree& tree, std::uint32_t i, const Points<Float>& p) {
  const Float dx = broadcast(tree.x[i]) - p.x, dy = broadcast(tree.y[i]) - p.y,
              dz = broadcast(tree.z[i]) - p.z;
  return shadow_nook_of_mass(fma(dx, p.nx, fma(dy, p.ny, dz * p.nz)),
                             fma(dx, dx, fma(dy, dy, fma(dz, dz, broadcast(tree.core[i])))),
                             broadcast(tree.softness[i]), broadcast(tree.mass[i]));
}

// Number of groups of key points for which the nodes are chosen at once. Each group has one bit in a word.
constexpr std::uint32_t batch_groups = 32;

// The extents of the boxes of all groups along one axis.
struct Extents {
  alignas(64) float low[batch_groups];
  alignas(64) float high[batch_groups];

  void put(std::uint32_t group, const float* place) {
    Float least = load(place), most = least;
    for (std::uint32_t i = width; i < key_point_group; i += width) {
      least = min(least, load(place + i));
      most = max(most, load(place + i));
    }
    float lows[width], highs[width];
    store(lows, least);
    store(highs, most);
    for (std::uint32_t half = width / 2; half > 0; half /= 2)
      for (std::uint32_t i = 0; i < half; ++i) {
        lows[i] = lows[i + half] < lows[i] ? lows[i + half] : lows[i];
        highs[i] = highs[i + half] > highs[i] ? highs[i + half] : highs[i];
      }
    low[group] = lows[0];
    high[group] = highs[0];
  }
  // Returns the distances along the axis between `place` and the boxes of the next groups, starting at
  // `group`.
  Float outside(Float place, std::uint32_t group) const {
    return place - min(max(place, load(low + group)), load(high + group));
  }
};

struct GroupBoxes {
  Extents x, y, z;

  // Lanes after the last group repeat the last group.
  GroupBoxes(const KeyPointSoa& points, std::uint32_t first) {
    for (std::uint32_t g = 0; g < batch_groups; ++g) {
      const std::uint32_t last = points.padded_count - key_point_group;
      const std::uint32_t k = first + g * key_point_group < last ? first + g * key_point_group : last;
      x.put(g, points.x + k);
      y.put(g, points.y + k);
      z.put(g, points.z + k);
    }
  }
  // Returns a mask in which the bit of a group is set if the group is within the reach of node n.
  std::uint32_t near(const PosedSphereTree& tree, std::uint32_t n) const {
    const Float at_x = broadcast(tree.x[n]), at_y = broadcast(tree.y[n]), at_z = broadcast(tree.z[n]),
                reach = broadcast(tree.reach[n]);
    std::uint32_t groups = 0;
    for (std::uint32_t g = 0; g < batch_groups; g += width) {
      const Float dx = x.outside(at_x, g), dy = y.outside(at_y, g), dz = z.outside(at_z, g);
      groups |= bits(less(fma(dx, dx, fma(dy, dy, dz * dz)), reach)) << g;
    }
    return groups;
  }
};

// Swaps rows and columns of 32 x 32 bits: Hacker's Delight, 7-3.
void transpose_bits(std::uint32_t (&row)[32]) {
  std::uint32_t mask = 0xffff;
  for (std::uint32_t half = 16; half > 0; half /= 2, mask ^= mask << half)
    for (std::uint32_t pair = 0; pair < 32; pair += 2 * half)
      for (std::uint32_t r = pair; r < pair + half; ++r) {
        const std::uint32_t swapped = ((row[r] >> half) ^ row[r + half]) & mask;
        row[r] ^= swapped << half;
        row[r + half] ^= swapped;
      }
}

// The masses (nodes and spheres) that each group of a batch uses. A group uses a node if it is outside the
// node's reach but within the reach of all of the node's ancestors. It uses a sphere if it is within the
// reach of all of the sphere's ancestors.
struct ChosenMasses {
  static constexpr std::uint32_t words = PosedSphereTree::max_masses / 32;

  std::uint32_t count = 0;       // number of words in use
  std::uint32_t bit[words][32];  // bit[w][group] holds the bits of masses 32 w to 32 w + 31

  ChosenMasses(const SphereTreeView& tree, const GroupBoxes& boxes) : count((2 * tree.nodes + 32) / 32) {
    const auto groups = [&](std::uint32_t mass) -> std::uint32_t& { return bit[mass / 32][mass % 32]; };
    for (std::uint32_t m = 2 * tree.nodes + 1; m < 32 * count; ++m) groups(m) = 0;
    groups(0) = ~0u;
    for (std::uint32_t n = 0; n < tree.nodes; ++n) {
      const std::uint32_t reached = groups(n), near = boxes.near(*tree.pose, n);
      groups(n) = reached & ~near;
      groups(tree.node[n].half[0]) = groups(tree.node[n].half[1]) = reached & near;
    }
    for (std::uint32_t w = 0; w < count; ++w) transpose_bits(bit[w]);
  }
};

// `word` must not be 0. This function does not use std::countr_zero, because the linker may merge functions
// of the C++ library (see above).
std::uint32_t lowest_bit(std::uint32_t word) {
#ifdef NOOK_TRAILING_ZEROS
  return static_cast<std::uint32_t>(NOOK_TRAILING_ZEROS(word));
#else
  std::uint32_t bit = 0;
  while (!(word >> bit & 1)) ++bit;
  return bit;
#endif
}

constexpr std::uint32_t group_parts = key_point_group / width;

// Returns the number of masses that were summed.
std::uint32_t sum_chosen(const PosedSphereTree& tree, const ChosenMasses& chosen, std::uint32_t group,
                         const KeyPointSoa& points, std::uint32_t k, float* sum) {
  Points<Float> p[group_parts];
  Float total[group_parts];
  for (std::uint32_t i = 0; i < group_parts; ++i) {
    p[i] = load_points<Float>(points, k + i * width);
    total[i] = load(sum + k + i * width);
  }
  std::uint32_t count = 0;
  for (std::uint32_t w = 0; w < chosen.count; ++w)
    for (std::uint32_t left = chosen.bit[w][group]; left != 0; left &= left - 1, ++count) {
      const std::uint32_t mass = 32 * w + lowest_bit(left);
      for (std::uint32_t i = 0; i < group_parts; ++i) total[i] = total[i] + shadow_of_mass(tree, mass, p[i]);
    }
  for (std::uint32_t i = 0; i < group_parts; ++i) store(sum + k + i * width, total[i]);
  return count;
}

std::uint64_t tree_sum(const SphereTreeView& tree, const KeyPointSoa& points, float* sum) {
  std::uint64_t evaluated = 0;
  for (std::uint32_t first = 0; first < points.padded_count; first += batch_groups * key_point_group) {
    const ChosenMasses chosen(tree, GroupBoxes(points, first));
    for (std::uint32_t g = 0, k = first; g < batch_groups && k < points.padded_count;
         ++g, k += key_point_group)
      evaluated += sum_chosen(*tree.pose, chosen, g, points, k, sum);
  }
  return key_point_group * evaluated;
}

void norm_root(const float* sum, const float* saturation, std::uint32_t padded_count, float gamma,
               float* shadow) {
  const NormPower p = norm_power(gamma);
  const Float exponent = broadcast(1 / gamma);
  for (std::uint32_t k = 0; k < padded_count; k += width) {
    const Float s = load(sum + k);
    const Float norm = p == NormPower::one ? s : p == NormPower::two ? sqrt(s) : power(s, exponent);
    store(shadow + k, saturated(norm, load(saturation + k)));
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

// If one operand is NaN, min and max return their second operand. So a NaN becomes 1, which means fully open.
Float clamped_open(Float a) {
  return max(min(a, broadcast(1.0f)), broadcast(0.0f));
}

// If the first operand is NaN, max returns the second one. So NaNs are ignored.
float largest_size(const float* value, std::uint32_t padded_count) {
  Float largest = broadcast(0.0f);
  for (std::uint32_t k = 0; k < padded_count; k += width) {
    const Float v = load(value + k);
    largest = max(max(v, broadcast(0.0f) - v), largest);
  }
  float lanes[width], out = 0;
  store(lanes, largest);
  for (const float lane : lanes) out = lane > out ? lane : out;
  return out;
}

void encode_points(const float* value, std::uint32_t padded_count, float limit, PointCodes& codes) {
  const float largest = largest_size(value, padded_count);
  codes.step = largest / limit;
  const Float inverse = broadcast(limit / (largest > 1e-30f ? largest : 1e-30f));
  const Float low = broadcast(-limit), high = broadcast(limit);
  for (std::uint32_t k = 0; k < padded_count; k += width)
    store_codes(codes.low + k, codes.high + k, max(min(load(value + k) * inverse, high), low));
}

// The weighted sums over the columns of a block, for each of its vertices.
struct BlockSums {
  static constexpr std::uint32_t parts = linear_block_vertices / width;

  Whole part[parts];

  BlockSums(const LinearView& layer, const LinearBlock& block, const std::int16_t* weights,
            const PointCodes& codes) {
    for (Whole& sum : part) sum = whole_zero();
    const std::uint32_t* k = layer.key_points + block.first_pair;
    const std::uint32_t* const end = k + block.pairs;
    const std::int16_t* w = weights + linear_pair_weights * std::size_t{block.first_pair};
    if (block.pairs % 2) {
      add(*k++, w, codes);
      w += linear_pair_weights;
    }
    // Processes two pairs per iteration, because the loop overhead costs as much as a pair.
    for (; k != end; k += 2, w += 2 * linear_pair_weights) {
      add(k[0], w, codes);
      add(k[1], w + linear_pair_weights, codes);
    }
  }
  void add(std::uint32_t key_points, const std::int16_t* w, const PointCodes& codes) {
    const CodePair pair = code_pair(codes.low[key_points & 0xffff], codes.high[key_points >> 16]);
    for (std::uint32_t p = 0; p < parts; ++p) part[p] = add_products(w + p * 2 * width, pair, part[p]);
  }
};

template <bool Added>
void linear_blocks(const LinearView& layer, const PointCodes& shadow, const PointCodes* occlusion,
                   float* ao) {
  const Float one = broadcast(1.0f), alpha_step = broadcast(layer.alpha_step * shadow.step),
              blend_step = broadcast(Added ? layer.blend_step * occlusion->step : 0.0f);
  for (std::uint32_t b = 0; b < layer.block_count; ++b) {
    const float* const bias = layer.open_bias + b * linear_block_vertices;
    Float open[BlockSums::parts];
    const BlockSums shaded(layer, layer.blocks[b], layer.alpha, shadow);
    for (std::uint32_t p = 0; p < BlockSums::parts; ++p)
      open[p] = clamped_open(load(bias + p * width) - number(shaded.part[p]) * alpha_step);
    if constexpr (Added) {
      const BlockSums added(layer, layer.blocks[b], layer.blend, *occlusion);
      for (std::uint32_t p = 0; p < BlockSums::parts; ++p)
        open[p] = open[p] * clamped_open(one - number(added.part[p]) * blend_step);
    }
    for (std::uint32_t p = 0; p < BlockSums::parts; ++p)
      store(ao + b * linear_block_vertices + p * width, open[p]);
  }
}

void linear_layer(const LinearView& layer, const PointCodes& shadow, const PointCodes* occlusion, float* ao) {
  if (occlusion)
    linear_blocks<true>(layer, shadow, occlusion, ao);
  else
    linear_blocks<false>(layer, shadow, nullptr, ao);
}

}  // namespace
