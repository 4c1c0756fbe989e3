// Compares the crowd with ray tracing, in rows of the report and in sheets of pictures.
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
  std::uint64_t seed = 1;  // for the rays
  std::filesystem::path out;
  // The character's model, and one fitted with the paper's gamma 2.
  std::span<const unsigned char> model, gamma_2_model;
};

// Adds the errors of AO to the report. scene holds the poses.
void measure_ao(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                const ComparisonRequest& request, nlohmann::ordered_json& report);

// Writes sheet.png.
void write_ao_sheet(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                    const ComparisonRequest& request);

// Writes double_shadowing.png. Makes two scenes that add up all spheres in one norm.
void write_double_shadowing_sheet(platform::Context& context, const Stage& stage, CrowdScene& scene,
                                  const std::vector<Bones>& poses, const ComparisonRequest& request);

// Adds the errors under a light to the report and writes light_NAME.png.
void compare_light(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                   const MapLight& light, const ComparisonRequest& request, nlohmann::ordered_json& report);

}  // namespace crowd::lab
