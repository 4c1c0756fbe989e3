// A grid of probes in a path-traced scene, all refined together, pass by pass.
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
  // The scene must outlive this object. Throws what Fit and check_probes throw.
  GridBake(const LitScene& scene, const GridBakeSettings& settings);

  // Adds samples_per_pass paths to every probe, over all threads. Any number of threads gives the same bits.
  void pass();
  std::uint32_t passes() const { return passes_; }
  std::uint64_t samples() const {
    return std::uint64_t(passes_) * settings_.samples_per_pass;
  }  // of each probe

  // Returns the remaining statistical error relative to the light: the root of the integrals of (R -
  // R_limit)^2 over the integrals of R^2. Both are sums over all probes. The difference between fits of the
  // odd and of the even passes gives the error. It is 1 before there are two passes.
  double error();

  // Returns the present state; call it at any time between passes. Probes inside solids get no paths; they
  // have the mean of their neighbours.
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

// Places counts probes at the centres of equal cells that fill a box.
nook::probe::Grid grid_in_box(const std::array<std::uint32_t, 3>& counts, Vec3 low_ws, Vec3 high_ws);

}  // namespace nook::bake::probe
