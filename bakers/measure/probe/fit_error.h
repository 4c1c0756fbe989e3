// The error of a probe against its map, in closed form: integrals over the map and the Gram matrix
// of the basis, no samples.
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
  // Integral of (R - f)^2 over the region, the RGB channels added, of any coefficients.
  double square_error(std::span<const Vec3> coefficients) const;
  // Share by which that is above the minimum.
  double excess(std::span<const Vec3> coefficients) const;
  // |R - R_LS|^2 / |R_LS|^2.
  double distance(std::span<const Vec3> coefficients) const;
  // Root of the mean square error over the region and the channels.
  double rms(std::span<const Vec3> coefficients) const;
  // Luminance of R's integral over that of f's.
  double mean_ratio(std::span<const Vec3> coefficients) const;

 private:
  double square_apart(std::span<const Vec3> coefficients) const;  // |R - R_LS|^2

  Basis basis_;
  MapIntegrals map_;
  Vector<double> gram_, integral_;
  std::vector<Channels> best_;
  double least_ = 0;  // square error of best_
  double size_ = 0;   // |R_LS|^2
};

// Irradiance of coefficients against the map's own, over evenly spread normals of the region.
class IrradianceTruth {
 public:
  IrradianceTruth(const Environment& map, const Region& region, std::uint32_t normals = 1024);

  struct Error {
    double rms = 0;  // over normals and channels
    double minimum =
        0;  // the lowest irradiance of any normal and channel, as a share of the map's mean irradiance
  };
  // Luminance of the map's irradiance, the mean over the normals.
  double mean() const { return mean_; }
  Error error(const Basis& basis, std::span<const Vec3> coefficients,
              IrradianceForm form = IrradianceForm::bands) const;

 private:
  std::vector<Vec3> normal_, irradiance_;
  double mean_ = 0;
};

}  // namespace nook::bake::probe
