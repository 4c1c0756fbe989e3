// Compares ways to look up a grid of probes with path tracing, side by side.
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
  const Rooms* rooms = nullptr;  // errors are relative to each room's mean, and the sealed room shows leaks
};

struct LookupSettings {
  std::uint32_t points = 1024;         // on surfaces, and as many in the open
  std::uint32_t paths = 2048;          // per point
  std::uint32_t samples = 16384;       // per probe
  std::uint32_t training_paths = 128;  // per place that walls and coefficients are fitted to
  std::uint64_t seed = 1;
  bake::PathSettings path;
};

// The irradiance on the floor of the rooms, where pixels go with x to the right and z downwards.
struct FloorPlan {
  int width = 0, height = 0;
  std::vector<Vec3> traced, trilinear, walls;
};

// Bakes the grid as harmonics of order 2 and returns one row for each way. plan: only for rooms.
nlohmann::ordered_json lookup_rows(const LookupScene& scene, const probe::Grid& grid,
                                   const LookupSettings& settings, const measure::PlacesProgress& progress,
                                   FloorPlan* plan = nullptr);

}  // namespace nook::lab
