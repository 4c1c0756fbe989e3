// The per-sample work of fits. Each instruction set has a table of plain functions. All arrays belong to the
// caller. Rows are padded to `padded` values, a multiple of simd_width. The values from index `count` on have
// no effect. The functions do not allocate, lock or throw.
#pragma once

#include <cstdint>

#include "sdk/src/core/isa.h"

namespace nook::probe {

// sample_chunk is the number of samples that kernels process at once. sample_group is the number of samples
// that are read at once. Both are multiples of the SIMD width.
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

// Samples in structure-of-arrays form. The arrays have room for a chunk and for a group that begins inside
// the chunk. Kernels work on whole pairs of vectors, so unused samples must have weight 0 and finite values.
struct SampleColumns {
  static constexpr std::uint32_t capacity = sample_chunk + sample_group;
  float x[capacity], y[capacity], z[capacity];  // unit directions
  float red[capacity], green[capacity], blue[capacity];
  float weight[capacity];
  float growth[capacity];  // factor that growing_samples applies to the weight
};

// One bit for each sample of a group. The first sample is the lowest bit.
struct SampleFaults {
  std::uint64_t direction = 0;  // the direction is not a unit vector, or is below the horizon
  std::uint64_t radiance = 0;   // the radiance is not finite, or is out of range
  std::uint64_t weight = 0;     // the weight is negative, not finite, or out of range
  std::uint64_t empty = 0;      // the weight is 0
};

// Lobes in structure-of-arrays form. Padding lobes have the axis 0 and a sharpness for which their value is
// 0.
struct LobeSoa {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* sharpness = nullptr;
  std::uint32_t padded = 0;
};

// The data of a running average for the plain and the original step. Sums in float precision would lose small
// changes. So `change` collects the changes of a chunk, and the fit then adds them to its coefficients in
// double precision.
struct RunningView {
  std::uint32_t count = 0;
  std::uint32_t padded = 0;
  float* value[3] = {nullptr, nullptr, nullptr};   // the coefficients, one row per channel
  float* change[3] = {nullptr, nullptr, nullptr};  // changes since the chunk began
  float* square = nullptr;                         // the mean of B_i^2 over the samples
  const float* true_square = nullptr;              // the mean of B_i^2 over the domain
  const float* inverse_mean = nullptr;             // 1 / mean of B_i over the domain
};

// Whitening computes the functions u = W B. They are orthogonal over the domain, and the integral of each
// squared function is the domain's area. W is lower triangular. It is stored in groups of four rows. Each
// group is stored column by column, up to the last column that one of its rows needs. Missing entries are 0.
constexpr std::uint32_t whitening_size(std::uint32_t functions) {
  const std::uint32_t blocks = (functions + 3) / 4;
  return 8 * blocks * (blocks + 1);
}

struct FitKernels {
  Isa isa = Isa::scalar;
  const char* name = nullptr;

  // Converts `count` samples, at most a group, to columns, beginning at column `first`. `directions` and
  // `radiance` have three floats per sample; `weights` may be NULL. Directions are normalised. The function
  // reads whole SIMD vectors, and one float beyond them. `up` is the axis of the hemisphere, or NULL for the
  // sphere. Faulty samples are also written to columns; the result marks them.
  SampleFaults (*read_group)(const float* directions, const float* radiance, const float* weights,
                             const float* up, std::uint32_t count, SampleColumns& samples,
                             std::uint32_t first);

  // For each sample with weight w and radiance v, does sums[0] += w, and sums[1 + c] += w v_c for each
  // channel c. The samples of one call are summed in float precision.
  void (*sum_light)(const SampleColumns& samples, std::uint32_t count, double* sums);

  // Writes the square root of each weight to `scale`, and the radiance times this square root to `light`, as
  // three rows.
  void (*light_rows)(const SampleColumns& samples, std::uint32_t count, float* scale, float* light);
  // The next two functions evaluate basis functions. They write one row per function, values[i * sample_chunk
  // + sample], and multiply each value by the sample's `scale`. They write `count` samples, rounded up to
  // pairs of vectors. gaussian_rows evaluates `functions` lobes. Its relative error is at most 2e-6, except
  // for lobes with a sharpness from 16 to 80. For these, it is 1e-7 times the sharpness. harmonic_rows
  // evaluates the nine harmonics of bands 0 to 2.
  void (*gaussian_rows)(const LobeSoa& lobes, std::uint32_t functions, const SampleColumns& samples,
                        const float* scale, std::uint32_t count, float* values);
  void (*harmonic_rows)(const SampleColumns& samples, const float* scale, std::uint32_t count, float* values);
  // Like gaussian_rows, but without a scale, and with one row per sample: values[sample * padded + i].
  // Padding is written too.
  void (*gaussian_values)(const LobeSoa& lobes, const SampleColumns& samples, std::uint32_t count,
                          float* values);
  // Converts rows of basis functions to rows of orthonormal functions, in place.
  void (*whiten_rows)(const float* whitening, std::uint32_t functions, std::uint32_t count, float* values);

  // For each row i of `left` and row k of `right`, adds the dot product of both rows to sums[k * stride + i].
  // If `triangle` is set, sums with i > k need not be computed. The sum over a chunk is a float, accurate to
  // 1e-7 of the sum of absolute values.
  void (*sum_products)(const float* left, std::uint32_t left_rows, const float* right,
                       std::uint32_t right_rows, std::uint32_t count, bool triangle, double* sums,
                       std::uint32_t stride);

  // The next two functions take one step of a running average for each sample in turn. B_i is the value of
  // function i, v the sample's radiance, R the value of the fit before the step, and w the sample's weight. W
  // is `total`: the sum of all weights up to and including w. For the first samples, W is at least the number
  // of samples. The plain step is b_i += w / W (B_i (v - R + b_i B_i) / D_i - b_i). D_i is true_square. With
  // Denominator::lockstep, D_i is the larger of true_square and `square`.
  void (*step_plain)(const RunningView& fit, const SampleColumns& samples, const float* total,
                     std::uint32_t count, const float* values, bool lockstep, bool non_negative);
  // The original step is b_i += w / W B_i (v - R) inverse_mean_i.
  void (*step_original)(const RunningView& fit, const SampleColumns& samples, const float* total,
                        std::uint32_t count, const float* values);
};

// Returns the table of one instruction set, or NULL if the processor or the build does not support it. Use
// choose_isa to get an available instruction set.
const FitKernels* fit_kernels(Isa isa);

}  // namespace nook::probe

// Declares, for each instruction set, the function that returns its table. Each instruction set has its own
// translation unit. Use a table only if the processor has the instruction set.
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  namespace nook::isa_##name {                   \
    const probe::FitKernels& fit_kernels();      \
  }
#include "sdk/src/core/isa_list.inl"
