// Computes the error of a probe against its map. It uses integrals over the map and the Gram matrix of the
// basis instead of random samples.
#pragma once

#include <span>
#include <vector>

#include "bakers/probe/map_light.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::bake::probe {

using nook::probe::IrradianceForm;

// R_LS is the exact least-squares fit of a basis to a map f. This class computes R_LS, and compares a probe R
// with any other coefficients to it.
class ExactFit {
 public:
  ExactFit(const Environment& map, const Basis& basis);

  const Basis& basis() const { return basis_; }
  std::vector<Vec3> coefficients() const;
  // Returns the integral of (R - f)^2 over the region, summed over RGB.
  double square_error(std::span<const Vec3> coefficients) const;
  // Returns (square_error - minimum) / minimum, where the minimum is the square_error of R_LS.
  double excess(std::span<const Vec3> coefficients) const;
  // Returns the squared norm of R - R_LS, divided by the squared norm of R_LS.
  double distance(std::span<const Vec3> coefficients) const;
  // Returns the root mean square error over the region and the channels.
  double rms(std::span<const Vec3> coefficients) const;
  // Returns the ratio of the integral of R to the integral of f, in luminance.
  double mean_ratio(std::span<const Vec3> coefficients) const;

 private:
  double square_apart(std::span<const Vec3> coefficients) const;  // squared norm of R - R_LS

  Basis basis_;
  MapIntegrals map_;
  Vector<double> gram_, integral_;
  std::vector<Channels> best_;
  double least_ = 0;  // square error of best_
  double size_ = 0;   // |R_LS|^2
};

// Compares the irradiance that a probe gives with the irradiance of the map, for normals that are spread
// evenly over the region.
class IrradianceTruth {
 public:
  IrradianceTruth(const Environment& map, const Region& region, std::uint32_t normals = 1024);

  struct Error {
    double rms = 0;  // over normals and channels
    // Lowest irradiance over all normals and channels, divided by the map's mean irradiance.
    double minimum = 0;
  };
  // Returns the luminance of the map's irradiance, averaged over the normals.
  double mean() const { return mean_; }
  Error error(const Basis& basis, std::span<const Vec3> coefficients,
              IrradianceForm form = IrradianceForm::bands) const;

 private:
  std::vector<Vec3> normal_, irradiance_;
  double mean_ = 0;
};

}  // namespace nook::bake::probe
