// The kernels for one vector type. Each instruction set includes this file inside its own namespace. Before
// that, it must define isa, Float, width, broadcast, load and store there; see
// character/shadow_kernels_impl.inl. Everything here except fit_kernels() has internal linkage.

namespace {

using probe::LobeSoa;
using probe::RunningView;
using probe::sample_chunk;
using probe::SampleColumns;
using probe::SampleFaults;
using probe::whole_pairs;

constexpr std::uint32_t pair = 2 * width;
static_assert(probe::sample_vector % width == 0);

#include "sdk/src/probe/fit_kernels_samples.inl"

#include "sdk/src/probe/fit_kernels_values.inl"

#include "sdk/src/probe/fit_kernels_sums.inl"

struct Colour {
  Float r, g, b;
};

// The sample's radiance minus the value of the fit.
struct Residual {
  float r, g, b;
};

Residual residual_of(const RunningView& fit, const SampleColumns& samples, std::uint32_t k,
                     const float* values) {
  Colour sums{broadcast(0.0f), broadcast(0.0f), broadcast(0.0f)};
  for (std::uint32_t i = 0; i < fit.padded; i += width) {
    const Float value = load(values + i);
    sums.r = fma(value, load(fit.value[0] + i), sums.r);
    sums.g = fma(value, load(fit.value[1] + i), sums.g);
    sums.b = fma(value, load(fit.value[2] + i), sums.b);
  }
  return {samples.red[k] - sum(sums.r), samples.green[k] - sum(sums.g), samples.blue[k] - sum(sums.b)};
}

// Adds `gain` to channel c of function i, and to its collected change.
void gain_at(const RunningView& fit, std::uint32_t c, std::uint32_t i, Float gain) {
  store(fit.value[c] + i, load(fit.value[c] + i) + gain);
  store(fit.change[c] + i, load(fit.change[c] + i) + gain);
}

template <bool Lockstep, bool NonNegative>
void plain_steps(const RunningView& fit, const SampleColumns& samples, const float* total,
                 std::uint32_t count, const float* values) {
  const Float one = broadcast(1.0f);
  for (std::uint32_t k = 0; k < count; ++k, values += fit.padded) {
    const Residual left = residual_of(fit, samples, k, values);
    const Float residual[3] = {broadcast(left.r), broadcast(left.g), broadcast(left.b)};
    const Float share = broadcast(samples.weight[k] / total[k]);
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

void step_plain(const RunningView& fit, const SampleColumns& samples, const float* total, std::uint32_t count,
                const float* values, bool lockstep, bool non_negative) {
  if (non_negative)
    return lockstep ? plain_steps<true, true>(fit, samples, total, count, values)
                    : plain_steps<false, true>(fit, samples, total, count, values);
  return lockstep ? plain_steps<true, false>(fit, samples, total, count, values)
                  : plain_steps<false, false>(fit, samples, total, count, values);
}

void step_original(const RunningView& fit, const SampleColumns& samples, const float* total,
                   std::uint32_t count, const float* values) {
  for (std::uint32_t k = 0; k < count; ++k, values += fit.padded) {
    const Residual left = residual_of(fit, samples, k, values);
    const float share = samples.weight[k] / total[k];
    const Float r = broadcast(share * left.r), g = broadcast(share * left.g), b = broadcast(share * left.b);
    for (std::uint32_t i = 0; i < fit.padded; i += width) {
      const Float row = load(values + i) * load(fit.inverse_mean + i);
      gain_at(fit, 0, i, row * r);
      gain_at(fit, 1, i, row * g);
      gain_at(fit, 2, i, row * b);
    }
  }
}

constexpr probe::FitKernels fit_table{isa,         isa_name(isa), read_group,    sum_light,
                                      light_rows,  gaussian_rows, harmonic_rows, gaussian_values,
                                      whiten_rows, sum_products,  step_plain,    step_original};

}  // namespace

const probe::FitKernels& fit_kernels() {
  return fit_table;
}
