// The basis and the fit of a probe, as options of a command.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/probe_file.h"

namespace nook::tool {

class Command;

struct ProbeOptions {
  std::uint32_t lobes = 12;
  float sharpness = 0;  // 0: by the number of lobes
  bool ambient = false, hemisphere = false;
  std::string basis = "gaussians", method = "least-squares", constraint = "bands", packing = "float";
  std::uint32_t order = 2;
};

void add_probe_options(Command command, ProbeOptions& options);

// The hemisphere's axis is +y.
probe::Basis basis_of(const ProbeOptions& options);
probe::FitSettings fit_of(const ProbeOptions& options);
probe::Packing packing_of(const ProbeOptions& options);

// Returns the options as JSON for recipes and reports.
nlohmann::ordered_json describe(const ProbeOptions& options, const probe::Basis& basis);

}  // namespace nook::tool
