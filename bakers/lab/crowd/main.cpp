// nook-lab-crowd: measures the crowd of samples/crowd. It draws the crowd, times the frames, and compares the
// result with ray tracing.
#include <cstdio>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/lab/crowd/crowd_options.h"
#include "bakers/lab/crowd/panels.h"
#include "bakers/lab/crowd/timed_frames.h"
#include "platform/file_bytes.h"
#include "platform/progress_bar.h"
#include "platform/standard_streams.h"

namespace crowd::lab {
namespace {

nlohmann::ordered_json describe(const platform::Context& context, const CrowdScene& scene, const Options& o) {
  const nook_gl_info gl = scene.gl().info();
  const nook_model_info model = scene.model().info();
  return {{"characters", o.crowd.characters},
          {"neighbours", o.crowd.neighbours},
          {"frames", o.frames},
          {"width", o.width_px},
          {"height", o.height_px},
          {"seed", o.seed},
          {"context", o.context},
          {"renderer", context.renderer()},
          {"version", context.version()},
          {"tier", gl.tier},
          {"gl_buffer_bytes", gl.buffer_bytes},
          {"vertices", model.vertex_count},
          {"bones", model.bone_count},
          {"spheres", model.sphere_count},
          {"key_points", model.key_point_count},
          {"gamma", model.gamma}};
}

nlohmann::ordered_json describe(const ScreenQuality& quality) {
  return {{"taps", quality.taps},
          {"half_resolution", quality.half_resolution},
          {"radius_m", ScreenPasses::radius_m}};
}

void describe_world(const Stage& stage, const CrowdScene& scene, const Options& o,
                    nlohmann::ordered_json& report) {
  const GladGLContext& gl = stage.context.gl();
  ScreenPasses& passes = *stage.passes;
  if (o.measure_world) report["world_rms"] = rms_to_every_caster(gl, passes, scene.gl());
  report["world_casters_per_pixel"] = mean_count(gl, passes, NOOK_WORLD_VIEW_CASTERS);
  report["world_counts"] = {{"exact_casters", mean_count(gl, passes, NOOK_WORLD_VIEW_EXACT_CASTERS)},
                            {"tests", mean_count(gl, passes, NOOK_WORLD_VIEW_TESTS)},
                            {"far_casters", mean_count(gl, passes, NOOK_WORLD_VIEW_FAR_CASTERS)},
                            {"far_tests", mean_count(gl, passes, NOOK_WORLD_VIEW_FAR_TESTS)}};
}

void compare_with_rays(platform::Context& context, const Stage& stage, CrowdScene& scene, const Options& o,
                       std::span<const unsigned char> model, nlohmann::ordered_json& report,
                       platform::ProgressBar& bar) {
  const std::vector<Bones> poses = pose_crowd(stage.hero, stage.places, 0);
  scene.set_poses(poses);
  ComparisonRequest request{o.crowd, o.seed, o.out, model, {}};
  measure_ao(stage, scene, poses, request, report);
  bar.show("comparing", "parts", 1, 3);
  write_ao_sheet(stage, scene, poses, request);
  bar.show("comparing", "parts", 2, 3);
  const std::vector<unsigned char> gamma_2 = cached_model(stage.hero, o.cache, o.quiet, 2.0f);
  request.gamma_2_model = gamma_2;
  write_double_shadowing_sheet(context, stage, scene, poses, request);
  bar.show("comparing", "parts", 3, 3);
}

void compare_lights(const Stage& stage, CrowdScene& scene, const Options& o, nlohmann::ordered_json& report,
                    platform::ProgressBar& bar) {
  const std::vector<Bones> poses = pose_crowd(stage.hero, stage.places, 0);
  scene.set_poses(poses);
  const ComparisonRequest request{o.crowd, o.seed, o.out, {}, {}};
  for (std::size_t i = 0; i < o.lights.size(); ++i) {
    bar.show("lights", "lights", i, o.lights.size());
    compare_light(stage, scene, poses, read_light(scene.context(), o.lights[i]), request, report);
  }
  bar.show("lights", "lights", o.lights.size(), o.lights.size());
}

struct NamedLight {
  std::string name;
  Light light;
};

std::optional<NamedLight> light_of_frames(const nook::Context& context, const Options& o) {
  if (!o.probe_light) return {};
  if (o.lights.empty()) return NamedLight{"sky", sky()};
  MapLight first = read_light(context, o.lights.front());
  return NamedLight{std::move(first.name), std::move(first.light)};
}

// Creates a context with OpenGL 4.x. If this fails, creates a context with OpenGL 3.3, which is sufficient
// for the crowd.
std::unique_ptr<platform::Context> create_context(const Options& o) {
  platform::ContextRequest request;
  request.kind = o.context;
  request.width = o.width_px;
  request.height = o.height_px;
  try {
    return platform::create_context(request);
  } catch (const std::runtime_error&) {
    request.major = request.minor = 3;
    return platform::create_context(request);
  }
}

nlohmann::ordered_json draw(const Stage& stage, CrowdScene& scene, const Options& o,
                            platform::ProgressBar& bar) {
  const std::optional<NamedLight> light = light_of_frames(scene.context(), o);
  if (light) scene.set_light(light->light.lobes);
  const FrameTimes ms =
      draw_frames(stage, scene, {o.frames, o.out, light ? &light->light : nullptr, o.record, o.debug},
                  [&](std::uint32_t done) { bar.show("drawing", "frames", done, o.frames); });
  // Removes the light, because the comparisons set their own lights.
  scene.set_light({});
  nlohmann::ordered_json report = describe(stage.context, scene, o);
  report["links"] = scene.scene().info().links;
  report["light"] = light ? nlohmann::ordered_json(light->name) : nlohmann::ordered_json();
  report["ms"] = {{"pose", ms.pose},
                  {"scene_update", ms.scene_update},
                  {"screen_space", ms.screen_space},
                  {"draw", ms.draw},
                  {"read", ms.read}};
  if (stage.passes) describe_world(stage, scene, o, report);
  report["screen_space"] = stage.passes ? describe(stage.passes->quality) : nlohmann::ordered_json();
  report["rows"] = nlohmann::ordered_json::array();
  return report;
}

void run(const Options& o) {
  const Hero hero(o.hero_glb.empty() ? built_in_glb(o.cache) : o.hero_glb);
  const std::vector<unsigned char> model =
      o.hero_nook.empty() ? cached_model(hero, o.cache, o.quiet) : platform::read_file(o.hero_nook);
  const std::unique_ptr<platform::Context> context = create_context(o);
  const std::vector<Placement> places = make_layout(clip_outlines(hero), o.crowd.characters, o.seed);
  nook_scene_desc desc = nook::scene_desc();
  desc.lod_error = o.lod_error;
  CrowdScene scene(*context, hero, model, o.crowd, desc);
  std::filesystem::create_directories(o.out);
  Renderer renderer(context->gl(), hero);
  PlainRenderer plain(context->gl(), renderer);
  platform::RenderTarget target(*context, o.width_px, o.height_px);
  std::optional<ScreenPasses> passes;
  if (o.screen_space) passes.emplace(*context, scene.gl(), o.width_px, o.height_px);
  const Stage stage{*context, hero, places, renderer, plain, target, passes ? &*passes : nullptr};
  platform::ProgressBar bar(o.quiet);
  nlohmann::ordered_json report = draw(stage, scene, o, bar);
  if (o.sheets) compare_with_rays(*context, stage, scene, o, model, report, bar);
  if (!o.lights.empty()) compare_lights(stage, scene, o, report, bar);
  const std::string text = report.dump(2) + "\n";
  platform::write_file(o.report, text.data(), text.size());
  std::printf("pictures: %s\nreport:   %s\n", std::filesystem::absolute(o.out).c_str(),
              std::filesystem::absolute(o.report).c_str());
}

}  // namespace
}  // namespace crowd::lab

int main(int argc, char** argv) {
  open_closed_streams();
  crowd::lab::Options options;
  int exit_code = 0;
  if (!crowd::lab::parse_options(argc, argv, options, exit_code)) return exit_code;
  try {
    crowd::lab::run(options);
    return 0;
  } catch (const nook::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return e.result() == NOOK_ERROR_BAD_FILE || e.result() == NOOK_ERROR_FILE_VERSION ? 3 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
