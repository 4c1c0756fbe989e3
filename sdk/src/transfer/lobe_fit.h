// Distant light as lobes: the least-squares fit over the sphere. The Gram matrix of the lobes is factored
// once; a fit in a new rotation sums moments and solves two triangular systems.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/transfer/light_cube.h"
#include "sdk/src/transfer/lobes.h"

namespace nook::transfer {

class LobeFit {
 public:
  explicit LobeFit(std::uint32_t lobes, Memory* memory = default_memory());

  std::uint32_t lobes() const { return std::uint32_t(axes_.size()); }
  std::span<const Vec3> axes() const { return axes_; }
  float sharpness() const { return sharpness_; }
  std::uint64_t bytes() const { return factor_.size() * sizeof(double); }

  // amplitudes has lobes x RGB. light_from_shape turns directions of the shape's space to those of the
  // light's.
  void fit(const CubeCells& cells, std::span<const Vec3> radiance, const Mat3x4& light_from_shape,
           std::span<float> amplitudes) const;
  // A light from one direction in the shape's space, with this irradiance on a plane that faces it.
  void fit_direction(Vec3 direction, Vec3 irradiance, std::span<float> amplitudes) const;

 private:
  void solve(std::span<double> moments, std::span<float> amplitudes) const;

  float sharpness_;
  Vector<Vec3> axes_;
  Vector<double> factor_;  // rows of L with G = L L^T, row i has i + 1 numbers
};

// The quality of a fit.
struct FitQuality {
  double relative_error = 0;  // root of the integral of (R - L)^2 over that of L^2
  double negative_share = 0;  // integral of max(-R, 0) over that of |R|, mean over channels by luminance
};
FitQuality fit_quality(const LobeFit& fit, std::span<const float> amplitudes, const CubeCells& cells,
                       std::span<const Vec3> radiance, const Mat3x4& light_from_shape);

}  // namespace nook::transfer
