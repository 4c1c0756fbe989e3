// Compares several ways to look up a grid of probes with path tracing.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/lab/probe/rooms.h"
#include "bakers/measure/probe/probe_report.h"
#include "sdk/src/probe/probe.h"

namespace nook::lab {

struct LookupScene {
  std::string name;
  const bake::LitScene& lit;
  const bake::TriangleSoup& soup;
  const Rooms* rooms = nullptr;  // if set, errors are relative to the mean irradiance of each room, and light
                                 // leaks are measured
};

struct LookupSettings {
  std::uint32_t points = 1024;         // points on surfaces, and as many points in the air
  std::uint32_t paths = 2048;          // per point
  std::uint32_t samples = 16384;       // per probe
  std::uint32_t training_paths = 128;  // paths per place that walls and coefficients are fitted to
  std::uint64_t seed = 1;
  bake::PathSettings path;
};

// Images of the irradiance on the floor of the rooms. x goes to the right, and z downwards.
struct FloorPlan {
  int width = 0, height = 0;
  std::vector<Vec3> traced, trilinear, walls;
};

// Bakes the grid as spherical harmonics of order 2, and returns one row for each way of lookup. `plan` is
// only for rooms.
nlohmann::ordered_json lookup_rows(const LookupScene& scene, const probe::Grid& grid,
                                   const LookupSettings& settings, const measure::PlacesProgress& progress,
                                   FloorPlan* plan = nullptr);

}  // namespace nook::lab
