// Incremental least-squares fits of a basis to samples of radiance. nook_probe.h describes the methods. With
// every method, you can add samples, read coefficients at any time, and merge fits.
//
// Running averages can use a fast step or a plain step. The fast step is recursive least squares, applied to
// blocks of samples. Before each block, the fit knows only the coefficients b and the total weight W of the
// earlier samples. It assumes that the normalised Gram matrix of the earlier samples is G / a, where G is the
// Gram matrix over the domain and a is the domain's area. For the block itself, the fit sums S (products of
// functions) and m (functions times radiance), and solves
//   (W G / a + S) (b' - b) = m - S b.
// One linear system is solved for each block. No sample can make the result overshoot. The errors converge to
// the errors of batch least squares; docs/probes.md has measurements. The plain step, as published, divides
// only by the mean square of each function. If functions overlap, the initial value has a long influence on
// the result of the plain step. For some combinations of coefficients, the weight of the initial value
// decreases only as n^-p after n samples, with p below 1/2.
//
// The sums over a chunk of samples are floats, and a nearly singular Gram matrix would magnify their rounding
// errors. If functions are so similar that this would happen, the sums use the orthonormal functions u =
// sqrt(a) L^-1 B instead, where G = L L^T.
#pragma once

#include <nook/nook_probe.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/probe/basis.h"
#include "sdk/src/probe/fit_bands.h"
#include "sdk/src/probe/fit_kernels.h"

namespace nook::probe {

enum class FitMethod : std::uint8_t {
  naive = 0,
  running_average = 1,
  running_average_original = 2,
  running_average_non_negative = 3,
  moments = 4,
  least_squares = 5,
  non_negative_least_squares = 6
};
enum class Denominator : std::uint8_t { lockstep = 0, precomputed = 1 };
enum class Step : std::uint8_t { fast = 0, plain = 1 };
enum class Constraint : std::uint8_t { bands = 0, none = 1 };

struct FitSettings {
  FitMethod method = FitMethod::least_squares;
  Step step = Step::fast;  // for all running averages except the original form
  Constraint constraint = Constraint::bands;
  Denominator denominator = Denominator::lockstep;  // only for the plain step
  // If not 0, the weight of sample k is multiplied by 1 - exp(-k / growing_samples).
  float growing_samples = 0;
  nook_isa isa = NOOK_ISA_AUTO;
};

constexpr bool is_running(FitMethod method) {
  return method == FitMethod::running_average || method == FitMethod::running_average_original ||
         method == FitMethod::running_average_non_negative;
}

// Weights should be 1 on average. If the total weight is lower than the number of samples, a running average
// uses the number of samples instead, but at most this limit. The reason is that importance sampling by
// luminance can yield a sample with a tiny weight and a huge radiance. If such a sample came first, it would
// dominate the running average for thousands of samples.
inline constexpr double first_weight = 256;

// Returns true if bands 0 to 2 of the fit are constrained to match the light's (fit_bands.h). This applies to
// Gaussians, except for the two methods that exist only for comparison.
constexpr bool meets_bands(const Basis& basis, const FitSettings& settings) {
  return settings.constraint == Constraint::bands && basis.kind == BasisKind::gaussians &&
         settings.method != FitMethod::naive && settings.method != FitMethod::running_average_original;
}

// Returns true if bands 0 to 2 of the basis functions are also estimated from the samples.
constexpr bool has_sampled_bands(const Basis& basis, const FitSettings& settings) {
  return meets_bands(basis, settings) && basis.domain == Domain::sphere &&
         (settings.method == FitMethod::least_squares ||
          settings.method == FitMethod::non_negative_least_squares);
}

struct SampleCounts {
  std::uint64_t used = 0;
  double expected_weight = 0;  // sum of the growth factors (growing_samples) of the first samples
  std::uint64_t bad_direction = 0;
  std::uint64_t bad_radiance = 0;
  std::uint64_t bad_weight = 0;
  double weight = 0;            // total weight of the used samples
  double radiance[3]{0, 0, 0};  // weighted sum of their radiance

  std::uint64_t skipped() const { return bad_direction + bad_radiance + bad_weight; }
};

class Fit {
 public:
  // Throws Failure if check_basis rejects the basis, or if several functions are linearly dependent. Throws
  // UNSUPPORTED if the processor does not have the chosen instruction set.
  Fit(const Basis& basis, const FitSettings& settings, Memory* memory = default_memory());

  // `directions` and `radiance` have three floats per sample. If `weights` is null, all weights are 1.
  // Allocates nothing. The result is bit-identical regardless of how the samples are split into calls. A call
  // with few samples only copies them. The samples are checked and counted later, when a group is full or
  // when a result is needed.
  void add_samples(const float* directions, const float* radiance, const float* weights, std::size_t count);
  // `seed` initialises a running average with the result of the fit `short_run`. The initial value has the
  // total weight of short_run. The running average must not have samples yet. `seed` and `merge` throw
  // INVALID_ARGUMENT if the other fit has a different basis. `merge` also throws if the settings differ.
  void seed(Fit& short_run);
  void merge(Fit& other);
  void reset();

  // Reads one coefficient per function. Before the first sample, the coefficients are 0. Allocates nothing.
  void read(std::span<Vec3> coefficients);
  // Reads the amplitudes for glossy reflection (gloss.h), which are fitted to the same samples. Before the
  // first sample, the amplitudes are 0. Only for Gaussians. Allocates nothing.
  void read_gloss(std::span<Vec3> amplitudes);

  const Basis& basis() const { return basis_; }
  const FitSettings& settings() const { return settings_; }
  SampleCounts counts();

 private:
  // The state that the samples accumulate. If whitens_ is set, sums over functions refer to the orthonormal
  // functions.
  struct State {
    double* sums;          // 3 x padded moments; then count x padded, the Gram matrix of the samples
    double* coefficients;  // 3 x padded, only for a running average
    double* square;        // padded, only for the plain step with Denominator::lockstep
    // 3 x band_stride moments of the harmonics, then 9 x padded sums of products of harmonic and function.
    // NULL if bands are not needed.
    double* bands;
  };
  struct Gathered {
    State state;
    SampleCounts counts;
  };

  // The memory that `present` writes to. It may belong to another fit with the same basis and settings.
  struct Room {
    double* state;
    double* solver;
    float* values;
  };

  // The latest samples, fewer than a group, as the caller passed them. The arrays are one float longer,
  // because read_group reads one float beyond its input.
  struct RecentSamples {
    std::uint32_t count = 0;
    float directions[3 * sample_group + 1], radiance[3 * sample_group + 1], weights[sample_group];
  };

  void prepare_gram(Memory* memory);
  void prepare_whitening(float* whitening) const;
  std::size_t state_size() const;
  State state_at(double* numbers) const;
  bool is_block() const;  // true for a running average with the fast step
  void append_recent(const float* directions, const float* radiance, const float* weights,
                     std::uint32_t count);
  void take_recent();  // moves the latest samples to samples_
  void take_group(const float* directions, const float* radiance, const float* weights, std::uint32_t count);
  void keep(const SampleFaults& faults, std::uint32_t count);
  void flush();  // adds the waiting samples to the state
  Gathered present(
      const Room& room) const;  // the state after adding the waiting samples and closing the block
  SampleCounts counts_with_waiting() const;
  void advance(SampleCounts& counts, std::uint32_t count) const;
  void absorb(std::uint32_t count, float* values, State into) const;
  Room room() { return {spare_.data(), scratch_.data(), values_.data()}; }
  void values_of(std::uint32_t count, std::uint32_t sample_stride, std::uint32_t function_stride,
                 float* values) const;
  void sum_samples(std::uint32_t count, const float* scale, const float* light, const float* harmonics,
                   float* values, State into) const;
  void step_plainly(std::uint32_t count, float* values, State into) const;
  void total_weights(std::uint32_t count, float* total) const;
  void unwhiten(State state) const;  // converts sums from orthonormal to basis functions
  void close_block(State state, const SampleCounts& counts, double* scratch) const;
  void join(State mine, State theirs, double share) const;
  void seed_bands(const Vec3* start);
  LightBands light_bands(const Gathered& gathered) const;
  double band_weight() const;
  void solve_moments(const Gathered& gathered, double* coefficients);
  void factor_samples(const Gathered& gathered, double scale, double* gram, double* factor) const;
  void solve_samples(const Gathered& gathered, double* coefficients);
  void make_non_negative(const Gathered& gathered, double* coefficients);
  const double* gloss_moments(const Gathered& gathered, double* moments);

  Basis basis_;
  FitSettings settings_;
  SampleCounts counts_;  // its weights do not include waiting samples
  const FitKernels* kernels_;
  std::uint32_t padded_;
  bool whitens_ = false;
  double prior_weight_ = 0;    // weight of a seed
  std::uint32_t waiting_ = 0;  // number of samples that wait until a chunk is full
  std::uint32_t open_ = 0;     // number of samples in the current block so far
  double closed_weight_ = 0;   // weight of the samples before the block
  LobeSoa lobes_;
  RunningView running_;  // only the constants, without the coefficients
  const float* whitening_ = nullptr;
  AlignedArray<RecentSamples> recent_;   // one element
  AlignedArray<SampleColumns> samples_;  // one element: the waiting samples
  AlignedArray<float> floats_;           // lobes_, running_ and whitening_ point into this array
  AlignedArray<float> values_;           // the values of the functions for a chunk of samples
  AlignedArray<double> gram_;            // Gram matrix over the domain, count x count
  AlignedArray<double> factor_;          // Cholesky factor of gram_
  AlignedArray<double> row_sum_;         // row sums of gram_: the denominators of the naive form
  AlignedArray<double> state_;
  AlignedArray<double> spare_;    // a copy of the state, used while coefficients are read
  AlignedArray<double> scratch_;  // memory for the solvers
};

// The solution of a fit as a matrix. If the exact Gram matrix is used, the coefficients depend linearly on
// the sums of the fit. A product with this matrix then computes them.

// Returns a matrix of basis.count rows and basis.count + band_functions columns. Row i computes coefficient
// i, as the method `moments` does. Multiply the matrix by a vector of integrals over the sphere. The vector
// holds first the integrals of the light times each function, then the integrals of the light times each
// harmonic of bands 0 to 2. Without the constraint, the columns of the harmonics are 0. Only for Gaussians
// over the sphere.
Vector<double> solution_map(const Basis& basis, Constraint constraint, Memory* memory = default_memory());

}  // namespace nook::probe
