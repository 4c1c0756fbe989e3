// The error of a probe against its map in closed form: integrals over the map and the Gram matrix of the
// basis, without samples.
#pragma once

#include <span>
#include <vector>

#include "bakers/probe/map_light.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::bake::probe {

using nook::probe::IrradianceForm;

// An exact least-squares fit of a basis to a map, and errors of other coefficients against it.
class ExactFit {
 public:
  ExactFit(const Environment& map, const Basis& basis);

  const Basis& basis() const { return basis_; }
  std::vector<Vec3> coefficients() const;
  // Returns the integral of (R - f)^2 over the region for any coefficients, summed over RGB.
  double square_error(std::span<const Vec3> coefficients) const;
  // Returns the excess of this error over the minimum, as a share of the minimum.
  double excess(std::span<const Vec3> coefficients) const;
  // Returns the squared norm of R - R_LS, over the squared norm of R_LS.
  double distance(std::span<const Vec3> coefficients) const;
  // Returns the root mean square error over the region and the channels.
  double rms(std::span<const Vec3> coefficients) const;
  // Returns the integral of R over the integral of f, by luminance.
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

// Compares the irradiance of coefficients with the map's own, over evenly spread normals of the region.
class IrradianceTruth {
 public:
  IrradianceTruth(const Environment& map, const Region& region, std::uint32_t normals = 1024);

  struct Error {
    double rms = 0;      // over normals and channels
    double minimum = 0;  // lowest irradiance of any normal and channel, over the map's mean irradiance
  };
  // Returns the luminance of the map's irradiance, as a mean over the normals.
  double mean() const { return mean_; }
  Error error(const Basis& basis, std::span<const Vec3> coefficients,
              IrradianceForm form = IrradianceForm::bands) const;

 private:
  std::vector<Vec3> normal_, irradiance_;
  double mean_ = 0;
};

}  // namespace nook::bake::probe
