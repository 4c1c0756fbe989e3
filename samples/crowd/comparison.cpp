#include "samples/crowd/comparison.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "samples/crowd/sheets.h"
#include "samples/crowd/truth.h"

namespace crowd {
namespace {

constexpr std::uint32_t kRays = 128;         // of the report
constexpr std::uint32_t kPictureRays = 256;  // of the sheets, where noise would be seen
constexpr std::uint32_t kFloorSide = 320;    // points of the floor, about 2 cm apart
constexpr std::size_t kSampled = 12;
constexpr float kNear_m = 1.0f;

using Values = std::vector<std::vector<float>>;

Values read_all(const CrowdScene& scene, std::span<const std::uint32_t> members) {
  Values ao;
  for (const std::uint32_t member : members) ao.push_back(scene.read_ao(member));
  return ao;
}

Values differences(const Values& a, const Values& b) {
  Values grey = a;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t v = 0; v < a[i].size(); ++v)
      grey[i][v] = std::max(0.0f, 1 - 4 * std::abs(a[i][v] - b[i][v]));
  return grey;
}

std::string gamma_label(float gamma, const char* rest) {
  char text[96];
  std::snprintf(text, sizeof text, "gamma %.2f, %s", double(gamma), rest);
  return text;
}

std::string screen_space_label(const ScreenSpaceQuality& quality) {
  return "screen-space AO (NNAO) alone, " + std::to_string(quality.taps) + " taps" +
         (quality.half_resolution ? ", half resolution" : "");
}

}  // namespace

std::vector<std::uint32_t> sample_of(const std::vector<Placement>& places, bool& have_neighbours) {
  std::vector<std::uint32_t> candidates = with_neighbour_within(places, kNear_m);
  have_neighbours = !candidates.empty();
  if (candidates.empty()) candidates = nearest_to(places, 0, 0, kSampled);
  std::vector<std::uint32_t> sample;
  const std::size_t count = std::min(kSampled, candidates.size());
  for (std::size_t i = 0; i < count; ++i) sample.push_back(candidates[i * candidates.size() / count]);
  return sample;
}

void measure_errors(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                    const ComparisonRequest& request, nlohmann::ordered_json& report) {
  bool have_neighbours = false;
  const std::vector<std::uint32_t> sample = sample_of(stage.places, have_neighbours);
  const Values truth = traced_ao(stage.hero, poses, sample, {kRays, request.seed});
  const Values again = traced_ao(stage.hero, poses, sample, {kRays, request.seed + 1});
  // Two independent estimates differ by twice the variance of one.
  report["rays"] = kRays;
  report["noise_floor_mse"] = compare(stage.hero, poses, sample, again, truth).mse / 2;
  report["sampled_instances"] = sample.size();
  report["sampled_have_neighbour_within_1_m"] = have_neighbours;
  struct Form {
    const char* name;
    std::uint32_t terms;
  };
  double mse_area[4] = {};
  const Form forms[4] = {{"self", NOOK_TERM_SELF},
                         {"self_ground", NOOK_TERM_SELF | NOOK_TERM_GROUND},
                         {"self_links", NOOK_TERM_SELF | NOOK_TERM_LINKS},
                         {"all", NOOK_TERM_ALL}};
  for (int f = 0; f < 4; ++f) {
    scene.update(forms[f].terms);
    const Errors e = compare(stage.hero, poses, sample, read_all(scene, sample), truth);
    mse_area[f] = e.mse_area;
    report["rows"].push_back({{"form", forms[f].name}, {"mse", e.mse}, {"mse_area", e.mse_area}});
  }
  const Values fixed(sample.size(), scene.model().static_ao());
  const Errors e = compare(stage.hero, poses, sample, fixed, truth);
  report["rows"].push_back({{"form", "static"}, {"mse", e.mse}, {"mse_area", e.mse_area}});
  // With ground in both.
  report["links_cut_mse_area"] = 1 - mse_area[3] / mse_area[1];
}

void write_comparison_sheet(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                            const ComparisonRequest& request) {
  SheetPainter painter(stage, poses, choose_group(stage.places, kSheetMembers));
  const std::vector<std::uint32_t>& members = painter.group().members;
  const Values truth = traced_ao(stage.hero, poses, members, {kPictureRays, request.seed});
  painter.add("no AO", Values{});
  painter.add("static AO, baked in the rest pose", Values(members.size(), scene.model().static_ao()));
  if (stage.screen_space) painter.add_screen_space_alone(screen_space_label(stage.screen_space->quality()));
  scene.update(NOOK_TERM_SELF);
  painter.add("Nook, self only", scene);
  scene.update(NOOK_TERM_ALL);
  painter.add("Nook, self + neighbours + ground", scene);
  if (stage.screen_space) painter.add_with_screen_space("the same, screen-space AO on the floor", scene);
  if (stage.screen_space) {
    constexpr float radius_m = ScreenSpaceAo::kRadius_m;
    const FloorPatch patch = floor_under(painter.group(), stage.places, radius_m, kFloorSide);
    painter.add("ray traced, the floor to 0.5 m like screen-space AO", truth, patch,
                traced_floor_ao(stage.hero, poses, members, patch, radius_m, {kPictureRays, request.seed}));
  } else {
    painter.add("ray traced", truth);
  }
  painter.add("error of Nook x 4, dark is wrong", differences(read_all(scene, members), truth));
  painter.write(request.out / "sheet.png", stage.screen_space ? 4 : 3);
}

void write_double_shadowing_sheet(platform::Context& context, const Stage& stage, CrowdScene& scene,
                                  const std::vector<Bones>& poses, const ComparisonRequest& request) {
  SheetPainter painter(stage, poses, choose_group(stage.places, kSheetMembers));
  // Without the ground, whose darkening would drown what overlapping spheres do.
  const Values truth =
      traced_ao(stage.hero, poses, painter.group().members, {kPictureRays, request.seed, false});
  for (const auto model : {request.model, request.gamma_2_model}) {
    CrowdScene one_norm(context, model,
                        {std::uint32_t(poses.size()), request.neighbours, request.tier, NOOK_COMBINE_PAPER});
    one_norm.set_poses(poses);
    const float gamma = one_norm.model().info().gamma;
    one_norm.update(NOOK_TERM_SELF);
    painter.add(gamma_label(gamma, "self"), one_norm);
    one_norm.update(NOOK_TERM_SELF | NOOK_TERM_LINKS);
    painter.add(gamma_label(gamma, "self + neighbours in one norm"), one_norm);
    if (model.data() == request.model.data()) {
      painter.add("ray traced, no ground", truth);
    } else {
      scene.update(NOOK_TERM_SELF | NOOK_TERM_LINKS);
      painter.add(gamma_label(scene.model().info().gamma, "composed (default)"), scene);
    }
  }
  painter.write(request.out / "double_shadowing.png", 3);
}

}  // namespace crowd
