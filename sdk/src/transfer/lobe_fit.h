// Fits lobes to distant light by least squares over the sphere. The Gram matrix of the lobes is factored
// once. A fit in a new rotation only sums moments and solves two triangular systems.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/transfer/distant_light.h"

namespace nook::transfer {

class LobeFit {
 public:
  explicit LobeFit(std::uint32_t lobes, Memory* memory = default_memory());

  std::uint32_t lobes() const { return std::uint32_t(axes_.size()); }
  std::span<const Vec3> axes() const { return axes_; }
  float sharpness() const { return sharpness_; }
  std::uint64_t bytes() const { return factor_.size() * sizeof(double); }

  // Fits the light of the cells. `amplitudes` gets an RGB value for each lobe. light_from_shape rotates
  // directions from the shape's space to the light's space.
  void fit(const CubeCells& cells, std::span<const Vec3> radiance, const Mat3x4& light_from_shape,
           std::span<float> amplitudes) const;
  // Fits a directional light. `direction` is in the shape's space. `irradiance` is the irradiance of a plane
  // that faces the light.
  void fit_direction(Vec3 direction, Vec3 irradiance, std::span<float> amplitudes) const;

 private:
  void solve(std::span<double> moments, std::span<float> amplitudes) const;

  float sharpness_;
  Vector<Vec3> axes_;
  Vector<double> factor_;  // rows of L, where G = L L^T; row i has i + 1 values
};

struct FitQuality {
  double relative_error = 0;  // square root of the integral of (R - L)^2 divided by the integral of L^2
  double negative_share = 0;  // integral of max(-R, 0) divided by the integral of |R|, mean over channels by
                              // luminance
};
FitQuality fit_quality(const LobeFit& fit, std::span<const float> amplitudes, const CubeCells& cells,
                       std::span<const Vec3> radiance, const Mat3x4& light_from_shape);

// The factored Gram matrices of a context. There is one for each number of lobes to which the context has
// projected light so far.

class LobeFit;

// All threads may call the cache at any time. A matrix is made on the first call that needs it, and lives as
// long as the cache.
class FitCache {
 public:
  explicit FitCache(Memory* memory) noexcept : memory_(memory) {}
  ~FitCache();
  FitCache(const FitCache&) = delete;
  FitCache& operator=(const FitCache&) = delete;

  // Returns the fit for a number of lobes. The first call creates this fit. If two threads create it at the
  // same time, one of the two results is discarded. There is no lock, because some builds have no thread
  // library.
  const LobeFit& of(std::uint32_t lobes);

 private:
  struct Entry;
  const LobeFit* find(const Entry* from, const Entry* end, std::uint32_t lobes) const;
  void drop(Entry* entry) noexcept;

  Memory* memory_;
  std::atomic<Entry*> first_{nullptr};
};

}  // namespace nook::transfer
