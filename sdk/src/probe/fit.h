// Least-squares fits of a basis to samples of radiance, while they arrive; nook_probe.h says what each method
// is. One contract for all: add samples, read coefficients at any time, merge.
#pragma once

#include <nook/nook_probe.h>

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "core/aligned_array.h"
#include "core/vec.h"
#include "probe/basis.h"

namespace nook::probe {

struct FitKernels;

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

struct FitSettings {
  FitMethod method = FitMethod::running_average;
  Denominator denominator = Denominator::lockstep;  // running averages
  Step step = Step::fast;                           // running averages
  float growing_samples = 0;                        // sample k weighs 1 - exp(-k / this); 0: 1
  nook_isa isa = NOOK_ISA_AUTO;

  bool operator==(const FitSettings&) const = default;
};

constexpr bool is_running(FitMethod method) {
  return method == FitMethod::running_average || method == FitMethod::running_average_original ||
         method == FitMethod::running_average_non_negative;
}

// What happened to the samples.
struct SampleCounts {
  std::uint64_t used = 0;
  std::uint64_t bad_direction = 0;
  std::uint64_t bad_radiance = 0;
  std::uint64_t bad_weight = 0;
  double weight = 0;               // of those used
  double radiance[3] = {0, 0, 0};  // their weighted sum

  std::uint64_t skipped() const { return bad_direction + bad_radiance + bad_weight; }
};

class Fit {
 public:
  // Throws what check_basis throws, and UNSUPPORTED for an instruction set that is not there.
  Fit(const Basis& basis, const FitSettings& settings, std::pmr::memory_resource* memory);

  // directions and radiance: three floats an entry; weights null: all 1. Allocates nothing.
  void add_samples(const float* directions, const float* radiance, const float* weights, std::size_t count);
  // Throw INVALID_ARGUMENT for a fit of another basis, or (merge) of other settings.
  void seed(const Fit& short_run);
  void merge(const Fit& other);
  void reset();

  // One coefficient for each function; 0 before the first sample. Allocates nothing.
  void read(std::span<Vec3> coefficients) const;

  const Basis& basis() const { return basis_; }
  const FitSettings& settings() const { return settings_; }
  const SampleCounts& counts() const { return counts_; }

 private:
  Basis basis_;
  FitSettings settings_;
  SampleCounts counts_;
};

}  // namespace nook::probe
