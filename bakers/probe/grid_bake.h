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
  bool move_probes = false;             // out of solids and away from walls, see inside_probes.h
  std::uint32_t samples_per_pass = 64;  // of each probe
  std::uint64_t seed = 1;
  PathSettings path;
};

class GridBake {
 public:
  // The scene must outlive it. Throws what Fit and check_probes throw.
  GridBake(const LitScene& scene, const GridBakeSettings& settings);

  // Every probe gets samples_per_pass paths more, over all threads; the same bits on any number of them.
  void pass();
  std::uint32_t passes() const { return passes_; }
  std::uint64_t samples() const {
    return std::uint64_t(passes_) * settings_.samples_per_pass;
  }  // of each probe

  // The statistical error that is left, relative to the light there is: the root of the integrals of (R -
  // R_limit)^2 over those of R^2, both added over all probes, from the difference between fits of the odd and
  // of the even passes. 1 before there are two.
  double error();

  // As far as it has come; at any time between passes. Probes inside solids, which get no paths, have the
  // mean of those round them.
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

// counts probes at the centres of equal cells that fill a box.
nook::probe::Grid grid_in_box(const std::array<std::uint32_t, 3>& counts, Vec3 low_ws, Vec3 high_ws);

}  // namespace nook::bake::probe
