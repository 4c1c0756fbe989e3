#include "bakers/lab/crowd/panels.h"

#include <glad/gl.h>

#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/lab/crowd/comparison.h"
#include "bakers/lab/crowd/given_values.h"

namespace crowd::lab {
namespace {

namespace measure = nook::lab::crowd;

// Shows given irradiance, which is read from the vertices or from a texture on the ground. Bright values are
// compressed.
const char* const given_light_fragment = R"(#version 330 core
in vec3 surface_position_ws;
in vec3 surface_albedo;
in vec3 surface_light;
uniform bool use_floor_light;
uniform sampler2D floor_light;
uniform vec2 floor_first_m;
uniform vec2 floor_extent_m;
uniform float exposure;
uniform vec3 background;
out vec4 colour;
void main() {
  vec3 irradiance = surface_light;
  float edge = 0.0;
  if (use_floor_light) {
    vec2 uv = (surface_position_ws.xz - floor_first_m) / floor_extent_m;
    irradiance = texture(floor_light, uv).rgb;
    // The picture fades out where the floor's light is unknown.
    edge = smoothstep(0.85, 1.0, 2.0 * length(uv - 0.5));
  }
  vec3 seen = 1.0 - exp(-exposure * surface_albedo * irradiance * 0.31830989);
  colour = vec4(mix(seen, background, edge), 1.0);
}
)";

const glm::vec3 albedo(0.72f), background(0.62f);

Camera camera_of(const measure::Group& group) {
  return {group.view.eye_ws, group.view.target_ws, group.view.fov_rad};
}

PlainLook panel_look() {
  PlainLook look;
  look.key_strength = 0.16f;  // mostly ambient light, so that the picture shows AO
  look.ground_albedo = glm::vec3(0.5f);
  look.background = background;
  look.fog_start_m = 14;
  return look;
}

// Draws the panels of the sheets. A panel shows a group of the crowd with given values at the vertices.
class Panels final : public measure::PanelRenderer {
 public:
  Panels(const Stage& stage, const std::vector<Bones>& poses)
      : stage_(stage),
        poses_(poses),
        character_(stage.context.gl(), {character_vertex}, {given_light_fragment}),
        ground_(stage.context.gl(), {ground_vertex}, {given_light_fragment}) {}

  platform::Image draw(const measure::Group& group, const measure::AoPanel& panel) override;
  platform::Image draw(const measure::Group& group, const measure::IrradiancePanel& panel) override;

 private:
  std::vector<DrawnInstance> instances_of(const measure::Group& group) const;

  const Stage& stage_;
  const std::vector<Bones>& poses_;
  platform::Program character_, ground_;  // programs that show given irradiance
};

std::vector<DrawnInstance> Panels::instances_of(const measure::Group& group) const {
  std::vector<DrawnInstance> drawn;
  for (const std::uint32_t member : group.members) drawn.push_back({&poses_[member], {}, albedo, {}, 0});
  return drawn;
}

platform::Image Panels::draw(const measure::Group& group, const measure::AoPanel& panel) {
  const GladGLContext& gl = stage_.context.gl();
  const VertexBuffer ao(gl, panel.ao, 1);
  std::vector<DrawnInstance> drawn = instances_of(group);
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].ao = ao.source(i);
  std::optional<FloorImage> floor;
  if (panel.floor_ao) floor.emplace(gl, *panel.floor_ao, 1);
  const Camera camera = camera_of(group);
  PlainLook look = panel_look();
  if (floor) look.floor_ao = floor->floor();
  if (panel.screen_space != measure::ScreenSpace::nowhere)
    look.screen_ao = stage_.passes->draw_screen(stage_.renderer, drawn, camera,
                                                panel.screen_space == measure::ScreenSpace::everywhere
                                                    ? NOOK_GBUFFER_AO_NONE
                                                    : NOOK_GBUFFER_AO_REPLACE);
  stage_.target.bind();
  stage_.plain.draw(drawn, camera, look, camera.target_ws, 6.0f);
  return stage_.target.read();
}

platform::Image Panels::draw(const measure::Group& group, const measure::IrradiancePanel& panel) {
  const GladGLContext& gl = stage_.context.gl();
  const VertexBuffer irradiance(gl, panel.irradiance, 3);
  std::vector<DrawnInstance> drawn = instances_of(group);
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].light = irradiance.source(i);
  const FloorImage image(gl, panel.floor, 3);
  stage_.target.bind();
  gl.Enable(GL_DEPTH_TEST);
  gl.ClearColor(background.r, background.g, background.b, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  for (const platform::Program* program : {&ground_, &character_}) {
    program->use();
    gl.Uniform1i(program->uniform("floor_light"), 4);
    gl.Uniform1i(program->uniform("use_floor_light"), program == &ground_);
    set_floor(gl, *program, image.floor());
    gl.Uniform1f(program->uniform("exposure"), panel.exposure);
    gl.Uniform3fv(program->uniform("background"), 1, glm::value_ptr(background));
  }
  const float aspect = float(stage_.target.width_px()) / float(stage_.target.height_px());
  const glm::mat4 view = clip_from_world(camera_of(group), aspect);
  stage_.renderer.draw_ground(ground_, glm::vec3(0.5f), view);
  stage_.renderer.draw_characters(character_, drawn, view);
  return stage_.target.read();
}

// Evaluates the crowd in the poses that the scene holds.
class Evaluated final : public measure::EvaluatedCrowd {
 public:
  explicit Evaluated(CrowdScene& scene) : scene_(scene) {}

  void update(std::uint32_t terms) override { scene_.update(terms); }
  std::vector<float> ao(std::uint32_t character) const override { return read_ao(scene_, character); }
  std::vector<float> static_ao() const override { return scene_.model().static_ao(); }
  float gamma() const override { return scene_.model().info().gamma; }
  measure::VertexValues directional_ao(std::span<const std::uint32_t> characters,
                                       std::span<const nook_lobe> lobes) override {
    nook::Scene& scene = scene_.scene();
    for (const std::uint32_t c : characters)
      scene.set_light(scene_.instances()[c], lobes.data(), std::uint32_t(lobes.size()));
    nook::set_terms(scene, NOOK_TERM_ALL);
    scene.update();
    measure::VertexValues occlusion;
    const std::uint32_t count = scene_.model().info().file_vertex_count;
    for (const std::uint32_t c : characters) {
      const nook_instance_id id = scene_.instances()[c];
      scene.read_directional_ao(id, occlusion.emplace_back(3 * std::size_t(count)).data(), count);
      scene.set_light(id, nullptr, 0);
    }
    return occlusion;
  }

 private:
  CrowdScene& scene_;
};

// Owns everything that a measure::Subject refers to.
struct Measured {
  Measured(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
           const ComparisonRequest& request)
      : crowd(stage.hero.character().get(), poses),
        evaluated(scene),
        panels(stage, poses),
        seed(request.seed) {
    for (const Placement& p : stage.places) places.push_back({p.x_m, p.z_m});
  }
  measure::Subject subject() { return {crowd, places, evaluated, panels, seed}; }

  measure::PosedCrowd crowd;
  std::vector<measure::Place> places;
  Evaluated evaluated;
  Panels panels;
  std::uint64_t seed;
};

std::optional<measure::ScreenSpaceSettings> settings_of(const ScreenPasses* passes) {
  if (!passes) return {};
  const ScreenQuality& quality = passes->quality;
  return measure::ScreenSpaceSettings{quality.taps, quality.half_resolution, ScreenPasses::radius_m};
}

CrowdScene one_norm_scene(platform::Context& context, const Stage& stage, const ComparisonRequest& request,
                          std::span<const unsigned char> model) {
  nook_scene_desc desc = nook::scene_desc();
  desc.form = NOOK_FORM_PAPER;
  return CrowdScene(context, stage.hero, model, request.crowd, desc);
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
    report["rows"].push_back(
        {{"form", form}, {"mse_visible", e.mse_visible}, {"mse", e.mse}, {"mse_area", e.mse_area}});
  report["links_cut_mse_area"] = errors.links_cut_mse_area;
}

void write_ao_sheet(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                    const ComparisonRequest& request) {
  Measured measured(stage, scene, poses, request);
  const std::optional<measure::ScreenSpaceSettings> screen_space = settings_of(stage.passes);
  platform::write_image(request.out / "sheet.png",
                        measure::ao_sheet(measured.subject(), screen_space ? &*screen_space : nullptr));
}

void write_double_shadowing_sheet(platform::Context& context, const Stage& stage, CrowdScene& scene,
                                  const std::vector<Bones>& poses, const ComparisonRequest& request) {
  Measured measured(stage, scene, poses, request);
  CrowdScene scenes[] = {one_norm_scene(context, stage, request, request.model),
                         one_norm_scene(context, stage, request, request.gamma_2_model)};
  for (CrowdScene& s : scenes) s.set_poses(poses);
  Evaluated own(scenes[0]), gamma_2(scenes[1]);
  platform::write_image(request.out / "double_shadowing.png",
                        measure::double_shadowing_sheet(measured.subject(), own, gamma_2));
}

void compare_light(const Stage& stage, CrowdScene& scene, const std::vector<Bones>& poses,
                   const MapLight& light, const ComparisonRequest& request, nlohmann::ordered_json& report) {
  Measured measured(stage, scene, poses, request);
  const measure::Light given{light.light.lobes, light.environment(), light.mean_radiance};
  const measure::LightErrors errors = measure::measure_light(measured.subject(), given);
  for (const auto& [form, e] : errors.forms)
    report["rows"].push_back(
        {{"form", form}, {"light", light.name}, {"mse", e.mse}, {"mse_area", e.mse_area}});
  report["light_noise_floor_mse"][light.name] = errors.noise_floor_mse;
  platform::write_image(request.out / ("light_" + light.name + ".png"),
                        measure::light_sheet(measured.subject(), given));
}

}  // namespace crowd::lab
