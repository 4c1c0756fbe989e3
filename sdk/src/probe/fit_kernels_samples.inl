// Samples as callers have them become columns, and what they sum to. A part of fit_kernels_impl.inl.

// The smallest numbers above the bounds, which are part of their ranges. NaN is not below them.
constexpr float above_max_sample = 1.00000006e18f;    // of radiance and weight: sums of squares stay finite
constexpr float above_length_error = 2.00000033e-3f;  // of the squared length of a direction

// Records of three floats become three columns. Reads a float beyond the last record.
void split_records(const float* records, float* x, float* y, float* z) {
  for (std::uint32_t k = 0; k < sample_group; k += 4, records += 12) {
    Four a = load_four(records), b = load_four(records + 3), c = load_four(records + 6),
         d = load_four(records + 9);
    transpose(a, b, c, d);
    store(x + k, a);
    store(y + k, b);
    store(z + k, c);
  }
}

Float magnitude(Float a) {
  return max(a, broadcast(0.0f) - a);
}

// Bits of the lanes where a is not below b, or one is not a number.
std::uint32_t not_below(Float a, Float b) {
  constexpr std::uint32_t all = (std::uint32_t(1) << width) - 1;
  return ~std::uint32_t(bits(less(a, b))) & all;
}

// Makes directions unit by two Newton steps from 1, and returns the bits of those that are not nearly so.
std::uint32_t make_unit(const float* up, float* px, float* py, float* pz) {
  const Float x = load(px), y = load(py), z = load(pz);
  const Float length2 = fma(x, x, fma(y, y, z * z));
  std::uint32_t bad = not_below(magnitude(length2 - broadcast(1.0f)), broadcast(above_length_error));
  if (up) {
    const Float height = fma(x, broadcast(up[0]), fma(y, broadcast(up[1]), z * broadcast(up[2])));
    bad |= std::uint32_t(bits(less(height, broadcast(0.0f))));
  }
  const Float half = broadcast(0.5f) * length2;
  const Float first = broadcast(1.5f) - half;
  const Float unit = first * (broadcast(1.5f) - half * first * first);
  store(px, x * unit);
  store(py, y * unit);
  store(pz, z * unit);
  return bad;
}

SampleFaults read_group(const float* directions, const float* radiance, const float* weights, const float* up,
                        SampleColumns& samples, std::uint32_t first) {
  float *const x = samples.x + first, *const y = samples.y + first, *const z = samples.z + first;
  float *const red = samples.red + first, *const green = samples.green + first,
               *const blue = samples.blue + first, *const weight = samples.weight + first;
  split_records(directions, x, y, z);
  split_records(radiance, red, green, blue);
  const Float zero = broadcast(0.0f), bound = broadcast(above_max_sample);
  SampleFaults faults;
  for (std::uint32_t k = 0; k < sample_group; k += width) {
    const Float w = weights ? load(weights + k) : broadcast(1.0f);
    store(weight + k, w);
    faults.direction |= make_unit(up, x + k, y + k, z + k) << k;
    const Float r = magnitude(load(red + k)), g = magnitude(load(green + k)), b = magnitude(load(blue + k));
    faults.radiance |= (not_below(r, bound) | not_below(g, bound) | not_below(b, bound)) << k;
    const std::uint32_t negative = std::uint32_t(bits(less(w, zero)));
    faults.weight |= (negative | not_below(w, bound)) << k;
    faults.empty |= not_below(zero, w) << k;
  }
  return faults;
}

// Of the products of two columns.
double column_product(const float* a, const float* b, std::uint32_t count) {
  double part[8] = {};
  for (std::uint32_t k = 0; k < count; k += 8)
    for (std::uint32_t lane = 0; lane < 8; ++lane) part[lane] += double(a[k + lane]) * double(b[k + lane]);
  return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

void sum_light(const SampleColumns& samples, std::uint32_t count, double* sums) {
  double part[8] = {};
  for (std::uint32_t k = 0; k < count; k += 8)
    for (std::uint32_t lane = 0; lane < 8; ++lane) part[lane] += double(samples.weight[k + lane]);
  for (const double lane : part) sums[0] += lane;
  sums[1] += column_product(samples.weight, samples.red, count);
  sums[2] += column_product(samples.weight, samples.green, count);
  sums[3] += column_product(samples.weight, samples.blue, count);
}

void light_rows(const SampleColumns& samples, std::uint32_t count, float* scale, float* light) {
  const std::uint32_t end = whole_pairs(count);
  for (std::uint32_t k = 0; k < end; k += width) {
    const Float root = sqrt(load(samples.weight + k));
    store(scale + k, root);
    store(light + k, load(samples.red + k) * root);
    store(light + sample_chunk + k, load(samples.green + k) * root);
    store(light + 2 * sample_chunk + k, load(samples.blue + k) * root);
  }
}
