// Computes the error of a probe against its map without sampling, from integrals over the map and the Gram
// matrix of the basis.
#pragma once

#include <span>
#include <vector>

#include "bakers/probe/map_light.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::bake::probe {

using nook::probe::IrradianceForm;

// The exact least-squares fit R_LS of a basis to a map f, and the errors of other coefficients R relative to
// this fit.
class ExactFit {
 public:
  ExactFit(const Environment& map, const Basis& basis);

  const Basis& basis() const { return basis_; }
  std::vector<Vec3> coefficients() const;
  // Returns the integral of (R - f)^2 over the region for any coefficients, summed over RGB.
  double square_error(std::span<const Vec3> coefficients) const;
  // Returns by how much square_error exceeds its minimum, divided by the minimum.
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

// Compares the irradiance from coefficients with the irradiance from the map, for evenly spread normals of
// the region.
class IrradianceTruth {
 public:
  IrradianceTruth(const Environment& map, const Region& region, std::uint32_t normals = 1024);

  struct Error {
    double rms = 0;      // over normals and channels
    double minimum = 0;  // lowest irradiance of any normal and channel, divided by the map's mean irradiance
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
