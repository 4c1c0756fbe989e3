// The work that fits do for each sample as a table of plain functions, one table for each instruction set.
// All arrays belong to the caller and are padded: `padded` numbers a row, a multiple of simd_width, those
// beyond `count` without effect. None allocates, locks or throws.
#pragma once

#include <cstdint>

#include "sdk/src/core/isa.h"

namespace nook::probe {

// Samples that go through the kernels at once; and those that are read at once, as whole vectors.
inline constexpr std::uint32_t sample_chunk = 256;
inline constexpr std::uint32_t sample_group = 64;
inline constexpr std::uint32_t sample_vector = 16;
constexpr std::uint32_t whole_vectors(std::uint32_t samples) {
  return (samples + sample_vector - 1) / sample_vector * sample_vector;
}
// Kernels work on two vectors at a time.
constexpr std::uint32_t whole_pairs(std::uint32_t samples) {
  return (samples + 2 * sample_vector - 1) / (2 * sample_vector) * (2 * sample_vector);
}

// Samples in structure-of-arrays form, with room for a group that begins inside a chunk. Those beyond the
// ones in use have weight 0 and are finite: kernels work on whole pairs of vectors.
struct SampleColumns {
  static constexpr std::uint32_t capacity = sample_chunk + sample_group;
  float x[capacity], y[capacity], z[capacity];  // unit directions
  float red[capacity], green[capacity], blue[capacity];
  float weight[capacity];
  float growth[capacity];  // what a weight of 1 has become
};

// One bit for each sample of a group, the first lowest.
struct SampleFaults {
  std::uint64_t direction = 0;  // not unit, or below the horizon
  std::uint64_t radiance = 0;   // not finite, or beyond the bound
  std::uint64_t weight = 0;     // negative, not finite, or beyond the bound
  std::uint64_t empty = 0;      // the weight is 0
};

// Lobes in structure-of-arrays form. Padding has axis 0 and a sharpness that makes it vanish.
struct LobeSoa {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* sharpness = nullptr;
  std::uint32_t padded = 0;
};

// A running average as the plain and the original step see it. Floats lose small changes to large sums, so
// that `change` gathers those of a chunk, which the owner adds to double.
struct RunningView {
  std::uint32_t count = 0;
  std::uint32_t padded = 0;
  float* value[3] = {nullptr, nullptr, nullptr};   // the coefficients, a row a channel
  float* change[3] = {nullptr, nullptr, nullptr};  // since the chunk began
  float* square = nullptr;                         // the mean of B_i^2 over the samples
  const float* true_square = nullptr;              // and over the domain
  const float* inverse_mean = nullptr;             // 1 / mean of B_i over the domain
};

// Functions u = W B that are orthonormal over the domain, up to its area. W is lower triangular: four rows at
// a time, up to their last column; of those column by column, 0 where there is none.
constexpr std::uint32_t whitening_size(std::uint32_t functions) {
  const std::uint32_t blocks = (functions + 3) / 4;
  return 8 * blocks * (blocks + 1);
}

struct FitKernels {
  Isa isa = Isa::scalar;
  const char* name = nullptr;

  // `count` entries, at most a group, of `directions` and `radiance`, three floats for each, and of
  // `weights`, which may be NULL, become columns from `first` on; directions are made unit. Reads whole
  // vectors and one float more. up: of a hemisphere; NULL for the sphere. Faulty samples are columns too.
  SampleFaults (*read_group)(const float* directions, const float* radiance, const float* weights,
                             const float* up, std::uint32_t count, SampleColumns& samples,
                             std::uint32_t first);

  // sums[0] += w, sums[1 + c] += w v_c, each by a float.
  void (*sum_light)(const SampleColumns& samples, std::uint32_t count, double* sums);

  // The square root of each weight, and the radiance times it as three rows.
  void (*light_rows)(const SampleColumns& samples, std::uint32_t count, float* scale, float* light);
  // Values as rows of samples, values[i * sample_chunk + sample], of `count` samples and of the rest of their
  // pair of vectors, each times the sample's `scale`: of `functions` lobes, within 2e-6 of the exponential,
  // relative (1e-7 times the sharpness of those from 16 to 80 above); and of the nine harmonics of bands 0
  // to 2.
  void (*gaussian_rows)(const LobeSoa& lobes, std::uint32_t functions, const SampleColumns& samples,
                        const float* scale, std::uint32_t count, float* values);
  void (*harmonic_rows)(const SampleColumns& samples, const float* scale, std::uint32_t count, float* values);
  // The same of lobes, sample by sample and without a scale: values[sample * padded + i], padding included.
  void (*gaussian_values)(const LobeSoa& lobes, const SampleColumns& samples, std::uint32_t count,
                          float* values);
  // Rows of values become those of the orthonormal functions.
  void (*whiten_rows)(const float* whitening, std::uint32_t functions, std::uint32_t count, float* values);

  // sums[k * stride + i] += the product of row i of `left` and row k of `right`, over the samples; with
  // `triangle` for i <= k at least. Each sum of a chunk is a float, 1e-7 of the absolute sum.
  void (*sum_products)(const float* left, std::uint32_t left_rows, const float* right,
                       std::uint32_t right_rows, std::uint32_t count, bool triangle, double* sums,
                       std::uint32_t stride);

  // One step of a running average for each sample in turn; R is the fit before the step, w the sample's
  // weight, W `total`: the weights up to and with it, at first not below their number.
  // plain: b_i += w / W (B_i (v - R + b_i B_i) / D_i - b_i); D_i true_square, in lockstep at least `square`.
  void (*step_plain)(const RunningView& fit, const SampleColumns& samples, const float* total,
                     std::uint32_t count, const float* values, bool lockstep, bool non_negative);
  // original: b_i += w / W B_i (v - R) inverse_mean_i.
  void (*step_original)(const RunningView& fit, const SampleColumns& samples, const float* total,
                        std::uint32_t count, const float* values);
};

// The table of one instruction set; NULL where the processor or the build lacks it. choose_isa gives one that
// is there.
const FitKernels* fit_kernels(Isa isa);

}  // namespace nook::probe

// The table of each instruction set's translation unit. A table may only be used on a processor that has the
// instruction set.
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  namespace nook::isa_##name {                   \
    const probe::FitKernels& fit_kernels();      \
  }
#include "sdk/src/core/isa_list.inl"
