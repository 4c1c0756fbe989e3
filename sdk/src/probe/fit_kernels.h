// The work that fits do for each sample, as a table of plain functions for each instruction set. All arrays
// belong to the caller. Rows are padded to `padded` numbers, a multiple of simd_width; numbers after `count`
// have no effect. None allocates, locks or throws.
#pragma once

#include <cstdint>

#include "sdk/src/core/isa.h"

namespace nook::probe {

// How many samples go through the kernels at once, and how many are read at once, as whole vectors.
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

// Samples in structure-of-arrays form, with room for a group that begins inside a chunk. Kernels work on
// whole pairs of vectors, so unused samples must have weight 0 and be finite.
struct SampleColumns {
  static constexpr std::uint32_t capacity = sample_chunk + sample_group;
  float x[capacity], y[capacity], z[capacity];  // unit directions
  float red[capacity], green[capacity], blue[capacity];
  float weight[capacity];
  float growth[capacity];  // what a weight of 1 has grown to
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

// A running average in the form that the plain and the original step read. Adding small changes to large
// float sums would lose them, so `change` collects the changes of a chunk, and the owner adds them in double.
struct RunningView {
  std::uint32_t count = 0;
  std::uint32_t padded = 0;
  float* value[3] = {nullptr, nullptr, nullptr};   // the coefficients, one row per channel
  float* change[3] = {nullptr, nullptr, nullptr};  // since the chunk began
  float* square = nullptr;                         // the mean of B_i^2 over the samples
  const float* true_square = nullptr;              // and over the domain
  const float* inverse_mean = nullptr;             // 1 / mean of B_i over the domain
};

// Functions u = W B that are orthonormal over the domain, except for the factor of its area. W is lower
// triangular. It is stored four rows at a time up to their last column, column by column, with 0 where a row
// has no entry.
constexpr std::uint32_t whitening_size(std::uint32_t functions) {
  const std::uint32_t blocks = (functions + 3) / 4;
  return 8 * blocks * (blocks + 1);
}

struct FitKernels {
  Isa isa = Isa::scalar;
  const char* name = nullptr;

  // Converts `count` entries, at most a group, to columns from `first` on. directions and radiance have three
  // floats for each; weights may be NULL. Directions become unit. Reads whole vectors and one float more. up:
  // the hemisphere's axis; NULL for the sphere. Faulty samples become columns too.
  SampleFaults (*read_group)(const float* directions, const float* radiance, const float* weights,
                             const float* up, std::uint32_t count, SampleColumns& samples,
                             std::uint32_t first);

  // sums[0] += w, sums[1 + c] += w v_c, each by a float.
  void (*sum_light)(const SampleColumns& samples, std::uint32_t count, double* sums);

  // Writes the square root of each weight, and the radiance times it as three rows.
  void (*light_rows)(const SampleColumns& samples, std::uint32_t count, float* scale, float* light);
  // Write values as rows of samples, values[i * sample_chunk + sample], each times the sample's `scale`, for
  // `count` samples and the rest of their pair of vectors. The first is for `functions` lobes, within 2e-6 of
  // the exponential, relative (1e-7 times the sharpness of lobes from 16 to 80 above). The second is for the
  // nine harmonics of bands 0 to 2.
  void (*gaussian_rows)(const LobeSoa& lobes, std::uint32_t functions, const SampleColumns& samples,
                        const float* scale, std::uint32_t count, float* values);
  void (*harmonic_rows)(const SampleColumns& samples, const float* scale, std::uint32_t count, float* values);
  // Writes the lobes sample by sample and without a scale: values[sample * padded + i], padding included.
  void (*gaussian_values)(const LobeSoa& lobes, const SampleColumns& samples, std::uint32_t count,
                          float* values);
  // Turns rows of values into rows of the orthonormal functions.
  void (*whiten_rows)(const float* whitening, std::uint32_t functions, std::uint32_t count, float* values);

  // sums[k * stride + i] += the product of row i of `left` and row k of `right`, over the samples. With
  // `triangle`, at least the sums for i <= k are computed. Each sum of a chunk is a float, accurate to 1e-7
  // of the absolute sum.
  void (*sum_products)(const float* left, std::uint32_t left_rows, const float* right,
                       std::uint32_t right_rows, std::uint32_t count, bool triangle, double* sums,
                       std::uint32_t stride);

  // These take one step of a running average for each sample in turn. R is the fit before the step, w the
  // sample's weight, and W `total`: the sum of weights including w, at first at least their number. plain:
  // b_i += w / W (B_i (v - R + b_i B_i) / D_i - b_i). D_i is true_square, in lockstep at least `square`.
  void (*step_plain)(const RunningView& fit, const SampleColumns& samples, const float* total,
                     std::uint32_t count, const float* values, bool lockstep, bool non_negative);
  // original: b_i += w / W B_i (v - R) inverse_mean_i.
  void (*step_original)(const RunningView& fit, const SampleColumns& samples, const float* total,
                        std::uint32_t count, const float* values);
};

// Returns the table of one instruction set, or NULL if the processor or the build lacks it. choose_isa
// returns an available one.
const FitKernels* fit_kernels(Isa isa);

}  // namespace nook::probe

// The table of each instruction set's translation unit. Use a table only on a processor that has the
// instruction set.
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  namespace nook::isa_##name {                   \
    const probe::FitKernels& fit_kernels();      \
  }
#include "sdk/src/core/isa_list.inl"
