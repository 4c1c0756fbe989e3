// The work that fits do for each sample as a table of plain functions, one table for each instruction set.
// All arrays belong to the caller and are padded: `padded` numbers a row, a multiple of simd_width, those
// beyond `count` without effect. None allocates, locks or throws.
#pragma once

#include <cstdint>

#include "sdk/src/core/isa.h"

namespace nook::probe {

struct Sample {
  float direction[3];  // unit
  float weight;        // >= 0
  float radiance[3];
  float total;  // sum of the weights up to and with this one, > 0; at first not below their number
};

// Lobes in structure-of-arrays form. Padding has axis 0 and a sharpness that makes it vanish.
struct LobeSoa {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* sharpness = nullptr;
  std::uint32_t padded = 0;
};

// A running average. Floats lose small changes to large sums, so that `change` gathers them for a few hundred
// samples, until the owner moves them to double.
struct RunningView {
  std::uint32_t count = 0;
  std::uint32_t padded = 0;
  float* value[3] = {nullptr, nullptr, nullptr};   // the coefficients, a row a channel
  float* change[3] = {nullptr, nullptr, nullptr};  // since they were last moved
  float* square = nullptr;                         // the mean of B_i^2 over the samples
  const float* true_square = nullptr;              // and over the domain
  const float* inverse_mean = nullptr;             // 1 / mean of B_i over the domain
  const float* dual = nullptr;                     // `count` rows: area times the inverse Gram matrix
};

struct FitKernels {
  Isa isa = Isa::scalar;
  const char* name = nullptr;

  // values[sample * padded + i] = B_i, for lobes; within 1e-6 of the exponential, relative.
  void (*gaussian_values)(const LobeSoa& lobes, const Sample* samples, std::uint32_t count, float* values);

  // One step of a running average for each sample in turn; R is the fit before the step, w the sample's
  // weight, W `total`.
  // fast: b += w / (W + w p) K (v - R), K = dual B, p = dot(K, B).
  void (*step_fast)(const RunningView& fit, const Sample* samples, const float* values, std::uint32_t count);
  // plain: b_i += w / W (B_i (v - R + b_i B_i) / D_i - b_i); D_i true_square, in lockstep at least `square`.
  void (*step_plain)(const RunningView& fit, const Sample* samples, const float* values, std::uint32_t count,
                     bool lockstep, bool non_negative);
  // original: b_i += w / W B_i (v - R) inverse_mean_i.
  void (*step_original)(const RunningView& fit, const Sample* samples, const float* values,
                        std::uint32_t count);

  // moments[c * padded + i] += w v_c B_i.
  void (*sum_moments)(const Sample* samples, const float* values, std::uint32_t count, std::uint32_t padded,
                      double* moments);
  // gram[i * padded + k] += w B_i B_k, for k <= i at least, of `functions` rows.
  void (*sum_gram)(const Sample* samples, const float* values, std::uint32_t count, std::uint32_t functions,
                   std::uint32_t padded, double* gram);
};

// The table of one instruction set; NULL where the processor or the build lacks it. choose_isa gives one that
// is there.
const FitKernels* fit_kernels(Isa isa);

}  // namespace nook::probe
