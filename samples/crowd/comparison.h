// The crowd against ray tracing: rows of the report and the two sheets.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include "samples/crowd/frames.h"

namespace crowd {

inline constexpr std::size_t kSheetMembers = 12;

// The characters of the report: those with a neighbour nearby, spread over the crowd; any where there is
// none.
std::vector<std::uint32_t> sample_of(const std::vector<Placement>& places, bool& have_neighbours);

struct ComparisonRequest {
  std::uint32_t neighbours = 4;
  int tier = 0;
  std::uint64_t seed = 1;
  std::filesystem::path out;
  std::span<const unsigned char> gamma_2_model;  // the same character fitted with gamma 2, the paper's
  std::span<const unsigned char> model;
};

// Adds rows, what was sampled and the noise of the rays to the report. scene holds the poses.
void measure_errors(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                    const ComparisonRequest& request, nlohmann::ordered_json& report);

// sheet.png: no AO, static, screen-space AO alone, self, all, all with screen-space AO on the floor, ray
// traced, difference. Only where its label says so has the floor AO.
void write_comparison_sheet(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                            const ComparisonRequest& request);

// double_shadowing.png: the model's gamma against 2, self and linked in one norm, beside the default and
// rays; no ground.
void write_double_shadowing_sheet(platform::Context& context, const Stage& stage, CrowdScene& scene,
                                  const std::vector<Bones>& poses, const ComparisonRequest& request);

}  // namespace crowd
