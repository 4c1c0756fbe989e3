// Values of the functions at the samples' directions. A part of fit_kernels_impl.inl.

// Up to this sharpness, the exponent is computed as sharpness (dot(d, axis) - 1). The absolute error of this
// exponent is the float rounding error at 1, multiplied by the sharpness. For sharper lobes, the exponent
// uses half of the squared distance between d and axis instead, which has only a relative error.
constexpr float widest_of_distance = 16;

constexpr float log2_of_e = 1.44269504f;

template <class F>
F two_to_the(F a) {  // a near 0 or below
  if constexpr (std::floating_point<F>)
    return std::exp2(a);
  else
    return simd::exp2_of_bounded(a);
}

template <bool Distance>
void rows_of_lobes(const LobeSoa& lobes, std::uint32_t functions, const SampleColumns& samples,
                   const float* scale, std::uint32_t count, float* values) {
  for (std::uint32_t i = 0; i < functions; ++i, values += sample_chunk) {
    const float sharpness = log2_of_e * lobes.sharpness[i];
    const Float x = broadcast(lobes.x[i]), y = broadcast(lobes.y[i]), z = broadcast(lobes.z[i]);
    const Float half = broadcast(-0.5f * sharpness), whole = broadcast(-sharpness);
    const Float sx = broadcast(sharpness * lobes.x[i]), sy = broadcast(sharpness * lobes.y[i]),
                sz = broadcast(sharpness * lobes.z[i]);
    for (std::uint32_t k = 0; k < count; k += width) {
      const Float dx = load(samples.x + k), dy = load(samples.y + k), dz = load(samples.z + k);
      Float exponent;
      if constexpr (Distance) {
        const Float ax = dx - x, ay = dy - y, az = dz - z;
        exponent = half * fma(ax, ax, fma(ay, ay, az * az));
      } else {
        exponent = fma(dx, sx, fma(dy, sy, fma(dz, sz, whole)));
      }
      store(values + k, two_to_the(exponent) * load(scale + k));
    }
  }
}

void gaussian_rows(const LobeSoa& lobes, std::uint32_t functions, const SampleColumns& samples,
                   const float* scale, std::uint32_t count, float* values) {
  const float sharpest = *std::max_element(lobes.sharpness, lobes.sharpness + functions);
  if (sharpest > widest_of_distance)
    rows_of_lobes<true>(lobes, functions, samples, scale, whole_pairs(count), values);
  else
    rows_of_lobes<false>(lobes, functions, samples, scale, whole_pairs(count), values);
}

void harmonic_rows(const SampleColumns& samples, const float* scale, std::uint32_t count, float* values) {
  const Float first = broadcast(float(NOOK_HARMONICS_1)), mixed = broadcast(float(NOOK_HARMONICS_2_MIXED)),
              squares = broadcast(float(NOOK_HARMONICS_2_SQUARES)),
              zonal = broadcast(float(3 * NOOK_HARMONICS_2_ZONAL)),
              zonal_mean = broadcast(float(-NOOK_HARMONICS_2_ZONAL));
  const std::uint32_t end = whole_pairs(count);
  const auto row = [&](std::uint32_t i, std::uint32_t k, Float value) {
    store(values + i * sample_chunk + k, value * load(scale + k));
  };
  for (std::uint32_t k = 0; k < end; k += width) {
    const Float x = load(samples.x + k), y = load(samples.y + k), z = load(samples.z + k);
    row(0, k, broadcast(float(NOOK_HARMONICS_0)));
    row(1, k, first * y);
    row(2, k, first * z);
    row(3, k, first * x);
    row(4, k, mixed * x * y);
    row(5, k, mixed * y * z);
    row(6, k, fma(zonal, z * z, zonal_mean));
    row(7, k, mixed * x * z);
    row(8, k, squares * (x * x - y * y));
  }
}

void gaussian_values(const LobeSoa& lobes, const SampleColumns& samples, std::uint32_t count, float* values) {
  for (std::uint32_t i = 0; i < lobes.padded; i += width) {
    const Float x = load(lobes.x + i), y = load(lobes.y + i), z = load(lobes.z + i);
    const Float scale = broadcast(-0.5f) * load(lobes.sharpness + i);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Float dx = broadcast(samples.x[k]) - x;
      const Float dy = broadcast(samples.y[k]) - y;
      const Float dz = broadcast(samples.z[k]) - z;
      const Float apart2 = fma(dx, dx, fma(dy, dy, dz * dz));
      store(values + k * lobes.padded + i, exponential(scale * apart2));
    }
  }
}

// Converts the functions of two vectors of samples to orthonormal functions in place. It goes from the last
// function to the first, because each result needs only its own and earlier functions.
void whiten(const float* whitening, std::uint32_t functions, float* values) {
  for (std::uint32_t block = (functions + 3) / 4; block-- > 0;) {
    const float* factor = whitening + 8 * block * (block + 1);
    Float first[4], second[4];
    for (std::uint32_t i = 0; i < 4; ++i) first[i] = second[i] = broadcast(0.0f);
    const std::uint32_t end = std::min(4 * block + 4, functions);
    for (std::uint32_t j = 0; j < end; ++j, factor += 4) {
      const Float a = load(values + j * sample_chunk), b = load(values + j * sample_chunk + width);
      for (std::uint32_t i = 0; i < 4; ++i) {
        const Float f = broadcast(factor[i]);
        first[i] = fma(f, a, first[i]);
        second[i] = fma(f, b, second[i]);
      }
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
      store(values + (4 * block + i) * sample_chunk, first[i]);
      store(values + (4 * block + i) * sample_chunk + width, second[i]);
    }
  }
}

void whiten_rows(const float* whitening, std::uint32_t functions, std::uint32_t count, float* values) {
  const std::uint32_t end = whole_pairs(count);
  for (std::uint32_t k = 0; k < end; k += pair) whiten(whitening, functions, values + k);
}
