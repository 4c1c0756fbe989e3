#include "samples/crowd/light_comparison.h"

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>

#include "samples/crowd/comparison.h"
#include "samples/crowd/sheets.h"
#include "samples/crowd/truth.h"

namespace crowd {
namespace {

constexpr std::uint32_t kRays = 64;  // paths of one of the report's two estimates
constexpr std::uint32_t kPictureRays = 256;
constexpr std::uint32_t kFloorSide = 100;

using Values = std::vector<std::vector<float>>;

struct LitForms {
  Values ao_only, ao_x_probe, per_lobe;  // irradiance, three floats a vertex
};

LitForms light_members(const Hero& hero, CrowdScene& scene, const std::vector<Bones>& poses,
                       std::span<const std::uint32_t> members, const Light& light) {
  scene.update();
  Values ao;
  for (const std::uint32_t member : members) ao.push_back(scene.read_ao(member));
  const Values directional = scene.directional_ao(members, light.lobes());
  const std::vector<float> constant = light.mean_irradiance();
  LitForms forms;
  std::vector<float> positions, normals;
  for (std::size_t m = 0; m < members.size(); ++m) {
    hero.skin(poses[members[m]], positions, normals);
    const std::vector<float> open = light.irradiance(normals);
    std::vector<float> plain(open.size()), times(open.size()), lobes(open.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      plain[i] = ao[m][i / 3] * constant[i % 3];
      times[i] = ao[m][i / 3] * open[i];
      lobes[i] = directional[m][i] * open[i];
    }
    forms.ao_only.push_back(std::move(plain));
    forms.ao_x_probe.push_back(std::move(times));
    forms.per_lobe.push_back(std::move(lobes));
  }
  return forms;
}

float mean_irradiance(const Light& light) {
  return std::numbers::pi_v<float> * light.mean_radiance();
}

}  // namespace

void measure_light(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses, const Light& light,
                   const LightComparisonRequest& request, nlohmann::ordered_json& report) {
  bool have_neighbours = false;
  const std::vector<std::uint32_t> sample = sample_of(stage.places, have_neighbours);
  const LitForms forms = light_members(stage.hero, scene, poses, sample, light);
  const auto trace = [&](std::uint64_t seed) {
    return traced_light(stage.hero, poses, sample, nullptr, light.environment(), {kRays, seed}).bodies;
  };
  Values truth = trace(request.seed);
  const Values again = trace(request.seed + 1);
  // Two independent estimates differ by twice the variance of one, and their mean has half of that variance.
  const double noise = compare(stage.hero, poses, sample, again, truth, 3, mean_irradiance(light)).mse / 4;
  for (std::size_t m = 0; m < truth.size(); ++m)
    for (std::size_t i = 0; i < truth[m].size(); ++i) truth[m][i] = (truth[m][i] + again[m][i]) / 2;
  const auto errors = [&](const Values& values) {
    return compare(stage.hero, poses, sample, values, truth, 3, mean_irradiance(light));
  };
  const struct {
    const char* name;
    const Values& values;
  } rows[] = {{"ao_only", forms.ao_only}, {"ao_x_probe", forms.ao_x_probe}, {"per_lobe", forms.per_lobe}};
  for (const auto& row : rows) {
    const Errors e = errors(row.values);
    report["rows"].push_back(
        {{"form", row.name}, {"light", light.name()}, {"mse", e.mse}, {"mse_area", e.mse_area}});
  }
  report["light_noise_floor_mse"][light.name()] = noise;
}

void write_light_sheet(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                       const Light& light, const LightComparisonRequest& request) {
  SheetPainter painter(stage, poses, choose_group(stage.places, kSheetMembers));
  const std::vector<std::uint32_t>& members = painter.group().members;
  const FloorPatch patch = floor_under(painter.group(), stage.places, 1.0f, kFloorSide);
  const TracedLight truth =
      traced_light(stage.hero, poses, members, &patch, light.environment(), {kPictureRays, request.seed});
  const LitForms forms = light_members(stage.hero, scene, poses, members, light);
  const float exposure = 1.0f / light.mean_radiance();
  const LitFloor floor{patch, truth.floor, exposure};
  painter.add_lit("AO times constant light", forms.ao_only, floor);
  painter.add_lit("AO times the probe", forms.ao_x_probe, floor);
  painter.add_lit("occlusion of each lobe", forms.per_lobe, floor);
  painter.add_lit("path traced", truth.bodies, floor);
  painter.write(request.out / ("light_" + light.name() + ".png"), 2);
}

}  // namespace crowd
