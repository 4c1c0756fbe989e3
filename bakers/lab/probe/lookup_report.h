// The ways to look up a grid of probes, measured side by side against path tracing.
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
  const Rooms* rooms = nullptr;  // each has errors relative to its own mean, and the sealed one shows leaks
};

struct LookupSettings {
  std::uint32_t points = 1024;         // on surfaces, and as many in the open
  std::uint32_t paths = 2048;          // a point
  std::uint32_t samples = 16384;       // a probe
  std::uint32_t training_paths = 128;  // a place that walls and coefficients are fitted to
  std::uint64_t seed = 1;
  bake::PathSettings path;
};

// Irradiance on the floor of the rooms, pixel by pixel: x to the right, z downwards.
struct FloorPlan {
  int width = 0, height = 0;
  std::vector<Vec3> traced, trilinear, walls;
};

// Bakes the grid as harmonics of order 2 and measures: one row for each way. plan: of rooms only.
nlohmann::ordered_json lookup_rows(const LookupScene& scene, const probe::Grid& grid,
                                   const LookupSettings& settings, const measure::PlacesProgress& progress,
                                   FloorPlan* plan = nullptr);

}  // namespace nook::lab
