// The kernels over one vector type. Each instruction set includes this file inside its own namespace, after
// defining there isa, Float, width, broadcast, load and store; see character/shadow_kernels_impl.inl.
// Everything here but fit_kernels() has internal linkage.

namespace {

using probe::LobeSoa;
using probe::RunningView;
using probe::Sample;

void gaussian_values(const LobeSoa& lobes, const Sample* samples, std::uint32_t count, float* values) {
  for (std::uint32_t i = 0; i < lobes.padded; i += width) {
    const Float x = load(lobes.x + i), y = load(lobes.y + i), z = load(lobes.z + i);
    const Float scale = broadcast(-0.5f) * load(lobes.sharpness + i);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Float dx = broadcast(samples[k].direction[0]) - x;
      const Float dy = broadcast(samples[k].direction[1]) - y;
      const Float dz = broadcast(samples[k].direction[2]) - z;
      const Float apart2 = fma(dx, dx, fma(dy, dy, dz * dz));
      store(values + k * lobes.padded + i, exponential(scale * apart2));
    }
  }
}

struct Colour {
  Float r, g, b;
};

// The difference between the sample's radiance and the fit.
struct Residual {
  float r, g, b;
};

Residual residual_of(const RunningView& fit, const Sample& sample, const float* values) {
  Colour sums{broadcast(0.0f), broadcast(0.0f), broadcast(0.0f)};
  for (std::uint32_t i = 0; i < fit.padded; i += width) {
    const Float value = load(values + i);
    sums.r = fma(value, load(fit.value[0] + i), sums.r);
    sums.g = fma(value, load(fit.value[1] + i), sums.g);
    sums.b = fma(value, load(fit.value[2] + i), sums.b);
  }
  return {sample.radiance[0] - sum(sums.r), sample.radiance[1] - sum(sums.g),
          sample.radiance[2] - sum(sums.b)};
}

// Adds `gain` to channel c of function i and remembers it.
void gain_at(const RunningView& fit, std::uint32_t c, std::uint32_t i, Float gain) {
  store(fit.value[c] + i, load(fit.value[c] + i) + gain);
  store(fit.change[c] + i, load(fit.change[c] + i) + gain);
}

void step_fast(const RunningView& fit, const Sample* samples, const float* values, std::uint32_t count) {
  alignas(64) float dual[NOOK_PROBE_MAX_FUNCTIONS];
  for (std::uint32_t k = 0; k < count; ++k, values += fit.padded) {
    Float leverage = broadcast(0.0f);
    for (std::uint32_t i = 0; i < fit.padded; i += width) {
      // Two sums: one would wait for itself.
      Float even = broadcast(0.0f), odd = broadcast(0.0f);
      for (std::uint32_t f = 0; f < fit.count; f += 2) {
        even = fma(broadcast(values[f]), load(fit.dual + f * fit.padded + i), even);
        odd = fma(broadcast(values[f + 1]), load(fit.dual + (f + 1) * fit.padded + i), odd);
      }
      const Float row = even + odd;
      store(dual + i, row);
      leverage = fma(row, load(values + i), leverage);
    }
    const Sample& sample = samples[k];
    const float step = sample.weight / (sample.total + sample.weight * sum(leverage));
    const Residual left = residual_of(fit, sample, values);
    const Float r = broadcast(step * left.r), g = broadcast(step * left.g), b = broadcast(step * left.b);
    for (std::uint32_t i = 0; i < fit.padded; i += width) {
      const Float row = load(dual + i);
      gain_at(fit, 0, i, row * r);
      gain_at(fit, 1, i, row * g);
      gain_at(fit, 2, i, row * b);
    }
  }
}

template <bool Lockstep, bool NonNegative>
void plain_steps(const RunningView& fit, const Sample* samples, const float* values, std::uint32_t count) {
  const Float one = broadcast(1.0f);
  for (std::uint32_t k = 0; k < count; ++k, values += fit.padded) {
    const Sample& sample = samples[k];
    const Residual left = residual_of(fit, sample, values);
    const Float residual[3] = {broadcast(left.r), broadcast(left.g), broadcast(left.b)};
    const Float share = broadcast(sample.weight / sample.total);
    for (std::uint32_t i = 0; i < fit.padded; i += width) {
      const Float value = load(values + i), squared = value * value;
      Float denominator = load(fit.true_square + i);
      if constexpr (Lockstep) {
        const Float mean = load(fit.square + i);
        const Float moved = fma(share, squared - mean, mean);
        store(fit.square + i, moved);
        denominator = max(moved, denominator);
      }
      const Float inverse = one / denominator, along = value * inverse, kept = squared * inverse - one;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const Float before = load(fit.value[c] + i);
        Float gain = share * fma(along, residual[c], kept * before);
        if constexpr (NonNegative) gain = max(gain, broadcast(0.0f) - before);
        gain_at(fit, c, i, gain);
      }
    }
  }
}

void step_plain(const RunningView& fit, const Sample* samples, const float* values, std::uint32_t count,
                bool lockstep, bool non_negative) {
  if (non_negative)
    return lockstep ? plain_steps<true, true>(fit, samples, values, count)
                    : plain_steps<false, true>(fit, samples, values, count);
  return lockstep ? plain_steps<true, false>(fit, samples, values, count)
                  : plain_steps<false, false>(fit, samples, values, count);
}

void step_original(const RunningView& fit, const Sample* samples, const float* values, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k, values += fit.padded) {
    const Sample& sample = samples[k];
    const Residual left = residual_of(fit, sample, values);
    const float share = sample.weight / sample.total;
    const Float r = broadcast(share * left.r), g = broadcast(share * left.g), b = broadcast(share * left.b);
    for (std::uint32_t i = 0; i < fit.padded; i += width) {
      const Float row = load(values + i) * load(fit.inverse_mean + i);
      gain_at(fit, 0, i, row * r);
      gain_at(fit, 1, i, row * g);
      gain_at(fit, 2, i, row * b);
    }
  }
}

void sum_moments(const Sample* samples, const float* values, std::uint32_t count, std::uint32_t padded,
                 double* __restrict moments) {
  for (std::uint32_t k = 0; k < count; ++k, values += padded)
    for (std::uint32_t c = 0; c < 3; ++c) {
      const double scale = double(samples[k].weight) * double(samples[k].radiance[c]);
      for (std::uint32_t i = 0; i < padded; ++i) moments[c * padded + i] += scale * double(values[i]);
    }
}

void sum_gram(const Sample* samples, const float* values, std::uint32_t count, std::uint32_t functions,
              std::uint32_t padded, double* __restrict gram) {
  double row[NOOK_PROBE_MAX_FUNCTIONS];
  for (std::uint32_t k = 0; k < count; ++k, values += padded) {
    for (std::uint32_t i = 0; i < padded; ++i) row[i] = double(values[i]);
    const double weight = double(samples[k].weight);
    for (std::uint32_t f = 0; f < functions; ++f) {
      const double scale = weight * row[f];
      const std::uint32_t end = (f + 8) & ~7u;  // the triangle, in whole vectors
      for (std::uint32_t i = 0; i < end; ++i) gram[f * padded + i] += scale * row[i];
    }
  }
}

constexpr probe::FitKernels fit_table{isa,        isa_name(isa), gaussian_values, step_fast,
                                      step_plain, step_original, sum_moments,     sum_gram};

}  // namespace

const probe::FitKernels& fit_kernels() {
  return fit_table;
}
