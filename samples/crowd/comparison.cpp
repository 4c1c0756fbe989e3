#include "samples/crowd/comparison.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/measure/crowd/light_comparison.h"
#include "samples/crowd/panels.h"

namespace crowd {
namespace {

namespace measure = nook::measure::crowd;

class Evaluated final : public measure::EvaluatedCrowd {
 public:
  explicit Evaluated(CrowdScene& scene) : scene_(scene) {}

  void update(std::uint32_t terms) override { scene_.update(terms); }
  std::vector<float> ao(std::uint32_t character) const override { return scene_.read_ao(character); }
  std::vector<float> static_ao() const override { return scene_.model().static_ao(); }
  float gamma() const override { return scene_.model().info().gamma; }
  measure::VertexValues directional_ao(std::span<const std::uint32_t> characters,
                                       std::span<const nook_probe_lobe> lobes) override {
    return scene_.directional_ao(characters, lobes);
  }

 private:
  CrowdScene& scene_;
};

// Everything that a measure::Subject refers to.
struct Measured {
  Measured(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
           const ComparisonRequest& request)
      : crowd(stage.hero.handle(), poses), evaluated(scene), panels(stage, poses), seed(request.seed) {
    for (const Placement& p : stage.places) places.push_back({p.x_m, p.z_m});
  }
  measure::Subject subject() { return {crowd, places, evaluated, panels, seed}; }

  measure::PosedCrowd crowd;
  std::vector<measure::Place> places;
  Evaluated evaluated;
  Panels panels;
  std::uint64_t seed;
};

std::optional<measure::ScreenSpaceSettings> settings_of(const ScreenSpaceAo* screen_space) {
  if (!screen_space) return {};
  const ScreenSpaceQuality& quality = screen_space->quality();
  return measure::ScreenSpaceSettings{quality.taps, quality.half_resolution, ScreenSpaceAo::kRadius_m};
}

CrowdScene one_norm_scene(platform::Context& context, const std::vector<Bones>& poses,
                          const ComparisonRequest& request, std::span<const unsigned char> model) {
  return CrowdScene(context, model,
                    {std::uint32_t(poses.size()), request.neighbours, request.tier, NOOK_COMBINE_PAPER});
}

}  // namespace

void measure_ao(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                const ComparisonRequest& request, nlohmann::ordered_json& report) {
  Measured measured(stage, scene, poses, request);
  const measure::AoErrors errors = measure::measure_ao(measured.subject());
  report["rays"] = errors.rays;
  report["noise_floor_mse"] = errors.noise_floor_mse;
  report["sampled_instances"] = errors.characters;
  report["sampled_have_neighbour_within_1_m"] = errors.have_neighbours;
  for (const auto& [form, e] : errors.forms)
    report["rows"].push_back({{"form", form}, {"mse", e.mse}, {"mse_area", e.mse_area}});
  report["links_cut_mse_area"] = errors.links_cut_mse_area;
}

void write_ao_sheet(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                    const ComparisonRequest& request) {
  Measured measured(stage, scene, poses, request);
  const std::optional<measure::ScreenSpaceSettings> screen_space = settings_of(stage.screen_space);
  platform::write_image(request.out / "sheet.png",
                        measure::ao_sheet(measured.subject(), screen_space ? &*screen_space : nullptr));
}

void write_double_shadowing_sheet(platform::Context& context, const Stage& stage, CrowdScene& scene,
                                  const std::vector<Bones>& poses, const ComparisonRequest& request) {
  Measured measured(stage, scene, poses, request);
  CrowdScene scenes[] = {one_norm_scene(context, poses, request, request.model),
                         one_norm_scene(context, poses, request, request.gamma_2_model)};
  for (CrowdScene& s : scenes) s.set_poses(poses);
  Evaluated own(scenes[0]), gamma_2(scenes[1]);
  platform::write_image(request.out / "double_shadowing.png",
                        measure::double_shadowing_sheet(measured.subject(), own, gamma_2));
}

void compare_light(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses, const Light& light,
                   const ComparisonRequest& request, nlohmann::ordered_json& report) {
  Measured measured(stage, scene, poses, request);
  const measure::Light given{light.lobes(), light.environment(), light.mean_radiance()};
  const measure::LightErrors errors = measure::measure_light(measured.subject(), given);
  for (const auto& [form, e] : errors.forms)
    report["rows"].push_back(
        {{"form", form}, {"light", light.name()}, {"mse", e.mse}, {"mse_area", e.mse_area}});
  report["light_noise_floor_mse"][light.name()] = errors.noise_floor_mse;
  platform::write_image(request.out / ("light_" + light.name() + ".png"),
                        measure::light_sheet(measured.subject(), given));
}

}  // namespace crowd
