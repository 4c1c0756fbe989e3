// The crowd under a light against path tracing: AO alone, AO times the probe, occlusion of each lobe.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "samples/crowd/frames.h"
#include "samples/crowd/light.h"

namespace crowd {

struct LightComparisonRequest {
  std::uint64_t seed = 1;
  std::filesystem::path out;
};

// Adds a row for each form to the report: errors of irradiance, all channels, in units of the light's mean
// over all directions. scene holds the poses.
void measure_light(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses, const Light& light,
                   const LightComparisonRequest& request, nlohmann::ordered_json& report);

// light_NAME.png: the three forms and the path-traced truth, on a floor that is traced in all of them.
void write_light_sheet(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                       const Light& light, const LightComparisonRequest& request);

}  // namespace crowd
