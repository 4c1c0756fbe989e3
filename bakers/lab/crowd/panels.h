// Compares the crowd with ray tracing. The results are rows of the report and sheets of pictures.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include "bakers/lab/crowd/light_file.h"
#include "bakers/lab/crowd/timed_frames.h"

namespace crowd::lab {

struct ComparisonRequest {
  CrowdSize crowd;
  std::uint64_t seed = 1;  // random seed of the rays
  std::filesystem::path out;
  // The model of the character, and another model that was fitted with the paper's gamma 2.
  std::span<const unsigned char> model, gamma_2_model;
};

// Adds the AO errors to the report. `scene` must hold the poses.
void measure_ao(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                const ComparisonRequest& request, nlohmann::ordered_json& report);

// Writes sheet.png.
void write_ao_sheet(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                    const ComparisonRequest& request);

// Writes double_shadowing.png. To do so, makes two scenes that combine the spheres of all bodies in one norm.
void write_double_shadowing_sheet(platform::Context& context, const Stage& stage, CrowdScene& scene,
                                  const std::vector<Bones>& poses, const ComparisonRequest& request);

// Adds the errors under a light to the report, and writes light_NAME.png.
void compare_light(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                   const MapLight& light, const ComparisonRequest& request, nlohmann::ordered_json& report);

}  // namespace crowd::lab
