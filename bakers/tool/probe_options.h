// Options and arguments of commands on probes: basis, fit and packing, and the positions of a grid.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "sdk/src/core/vec.h"
#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/probe_file.h"

namespace nook::tool {

class Command;

struct ProbeOptions {
  std::uint32_t lobes = 12;
  float sharpness = 0;  // 0: derived from the number of lobes
  bool ambient = false, hemisphere = false;
  std::string basis = "gaussians", method = "least-squares", constraint = "bands", packing = "float";
  std::uint32_t order = 2;
};

void add_probe_options(Command command, ProbeOptions& options);

// The hemisphere's axis is +y.
probe::Basis basis_of(const ProbeOptions& options);
probe::FitSettings fit_of(const ProbeOptions& options);
probe::Packing packing_of(const ProbeOptions& options);

// Returns every option, for the identity of a bake.
nlohmann::json settings_of(const ProbeOptions& options);

nlohmann::ordered_json describe(const ProbeOptions& options, const probe::Basis& basis);

struct BoxArgument {
  bool given = false;
  Vec3 low_ws, high_ws;  // metres
};

// Parses "AxBxC". Throws ToolError(bad arguments).
std::array<std::uint32_t, 3> parse_grid_counts(const std::string& text);
// Parses "x0,y0,z0,x1,y1,z1". Throws ToolError(bad arguments).
BoxArgument parse_grid_box(const std::string& text);

}  // namespace nook::tool
