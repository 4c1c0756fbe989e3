// Converts callers' samples to columns and sums them. A part of fit_kernels_impl.inl.

// Each constant is the smallest float above a limit, because the limit itself is allowed. A value is accepted
// if it is less than the constant. This comparison is false for NaN, so NaN is rejected too.
constexpr float above_max_sample = 1.00000006e18f;    // radiance and weight: sums of squares stay finite
constexpr float above_length_error = 2.00000033e-3f;  // error of a direction's squared length

// Converts records of three floats to three columns. Reads one float beyond the last record.
void split_records(const float* records, std::uint32_t count, float* x, float* y, float* z) {
  for (std::uint32_t k = 0; k < count; k += 4, records += 12) {
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

// Returns a bit mask of the lanes in which a >= b, or a or b is NaN.
std::uint32_t not_below(Float a, Float b) {
  constexpr std::uint32_t all = (std::uint32_t(1) << width) - 1;
  return ~std::uint32_t(bits(less(a, b))) & all;
}

// Normalises directions. Computes the inverse length by two Newton steps that start at 1. Returns a bit mask
// of the directions whose length was not close to 1.
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

// Converts all records first, and checks them afterwards. A processor stalls if it loads a vector just after
// several smaller stores have written it.
SampleFaults read_group(const float* directions, const float* radiance, const float* weights, const float* up,
                        std::uint32_t count, SampleColumns& samples, std::uint32_t first) {
  float *const x = samples.x + first, *const y = samples.y + first, *const z = samples.z + first;
  float *const red = samples.red + first, *const green = samples.green + first,
               *const blue = samples.blue + first, *const weight = samples.weight + first;
  const std::uint32_t end = probe::whole_vectors(count);
  split_records(directions, end, x, y, z);
  split_records(radiance, end, red, green, blue);
  const Float zero = broadcast(0.0f), bound = broadcast(above_max_sample);
  SampleFaults faults;
  for (std::uint32_t k = 0; k < end; k += width) {
    const Float w = weights ? load(weights + k) : broadcast(1.0f);
    store(weight + k, w);
    faults.direction |= std::uint64_t(make_unit(up, x + k, y + k, z + k)) << k;
    const std::uint32_t bad = not_below(magnitude(load(red + k)), bound) |
                              not_below(magnitude(load(green + k)), bound) |
                              not_below(magnitude(load(blue + k)), bound);
    faults.radiance |= std::uint64_t(bad) << k;
    const std::uint32_t negative = std::uint32_t(bits(less(w, zero)));
    faults.weight |= std::uint64_t(negative | not_below(w, bound)) << k;
    faults.empty |= std::uint64_t(not_below(zero, w)) << k;
  }
  return faults;
}

void sum_light(const SampleColumns& samples, std::uint32_t count, double* sums) {
  const std::uint32_t end = whole_pairs(count);
  Float weight = broadcast(0.0f), red = weight, green = weight, blue = weight;
  for (std::uint32_t k = 0; k < end; k += width) {
    const Float w = load(samples.weight + k);
    weight = weight + w;
    red = fma(w, load(samples.red + k), red);
    green = fma(w, load(samples.green + k), green);
    blue = fma(w, load(samples.blue + k), blue);
  }
  sums[0] += double(sum(weight));
  sums[1] += double(sum(red));
  sums[2] += double(sum(green));
  sums[3] += double(sum(blue));
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
