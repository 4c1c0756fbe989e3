// Bakes a grid of probes in a path-traced scene. Each pass refines all probes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bakers/raytrace/path_tracer.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

struct GridBakeSettings {
  nook::probe::Basis basis;
  nook::probe::FitSettings fit;
  nook::probe::Grid grid;
  bool move_probes = false;             // moves probes out of solids and away from walls, see inside_probes.h
  std::uint32_t samples_per_pass = 64;  // per probe
  std::uint64_t seed = 1;
  PathSettings path;
};

class GridBake {
 public:
  // The scene must outlive this object. Throws the same failures as Fit and check_probes.
  GridBake(const LitScene& scene, const GridBakeSettings& settings);

  // Adds samples_per_pass paths to every probe, in parallel. The result has the same bits on any number of
  // threads.
  void pass();
  std::uint32_t passes() const { return passes_; }
  std::uint64_t samples() const { return std::uint64_t(passes_) * settings_.samples_per_pass; }  // per probe

  // Returns the remaining statistical error relative to the radiance R: the square root of the integral of (R
  // - R_limit)^2 divided by the integral of R^2, where both are summed over all probes. The error is
  // estimated from the difference between a fit to the odd passes and a fit to the even passes. Returns 1
  // before there are two passes.
  double error();

  // Returns the present state. You can call it between any two passes. Probes inside solids get no paths.
  // Their coefficients are the mean of their neighbours' coefficients.
  nook::probe::Probes probes();
  const std::vector<Vec3>& positions_ws() const { return positions_ws_; }
  std::size_t inside_count() const { return std::size_t(std::count(inside_.begin(), inside_.end(), true)); }

 private:
  struct ProbeFits {
    explicit ProbeFits(const GridBakeSettings& s)
        : all(s.basis, s.fit), odd(s.basis, s.fit), even(s.basis, s.fit) {}
    nook::probe::Fit all, odd, even;
  };

  const LitScene& scene_;
  GridBakeSettings settings_;
  LightSampler light_;
  Vector<double> gram_;
  std::vector<ProbeFits> fits_;
  std::vector<Vec3> positions_ws_;
  std::vector<bool> inside_;
  std::uint32_t passes_ = 0;
};

// Divides a box into equal cells, and places a probe at the centre of each. `counts` is the number of cells
// along each axis.
nook::probe::Grid grid_in_box(const std::array<std::uint32_t, 3>& counts, Vec3 low_ws, Vec3 high_ws);

}  // namespace nook::bake::probe
