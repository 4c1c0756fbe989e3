// Bakes a character, fills a plane with a crowd of it, draws the crowd and compares it with ray tracing.
#include <cstdio>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>

#include "platform/file_bytes.h"
#include "platform/progress_bar.h"
#include "samples/crowd/cached_model.h"
#include "samples/crowd/comparison.h"
#include "samples/crowd/frames.h"
#include "samples/crowd/layout.h"
#include "samples/crowd/options.h"
#ifdef CROWD_HAS_WINDOW_LOOP
#include "samples/crowd/window_loop.h"
#endif

namespace crowd {
namespace {

Hero load_hero(const Options& o) {
  return o.hero_glb.empty() ? Hero(built_in_glb(o.cache)) : Hero(o.hero_glb);
}

void require_same_character(const Hero& hero, const nook::CharacterModel& model) {
  const nook_model_info info = model.info();
  if (info.file_vertex_count == hero.vertex_count() && info.bone_count == hero.bone_count()) return;
  throw std::runtime_error("crowd: the model does not belong to the character (got " +
                           std::to_string(info.file_vertex_count) + " vertices and " +
                           std::to_string(info.bone_count) + " bones, need " +
                           std::to_string(hero.vertex_count()) + " and " + std::to_string(hero.bone_count()) +
                           "); bake the character again");
}

nlohmann::ordered_json describe(const platform::Context& context, const CrowdScene& scene, const Options& o) {
  const nook_gl_info gl = scene.gl().info();
  const nook_model_info model = scene.model().info();
  return {{"characters", o.characters},
          {"neighbours", o.neighbours},
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

nlohmann::ordered_json describe(const ScreenSpaceQuality& quality) {
  return {{"taps", quality.taps},
          {"half_resolution", quality.half_resolution},
          {"radius_m", ScreenSpaceAo::kRadius_m}};
}

void compare_with_rays(platform::Context& context, const Stage& stage, CrowdScene& scene, const Options& o,
                       std::span<const unsigned char> model, nlohmann::ordered_json& report,
                       platform::ProgressBar& bar) {
  const std::vector<Bones> poses = pose_crowd(stage.hero, stage.places, 0);
  scene.set_poses(poses);
  ComparisonRequest request{o.neighbours, o.tier, o.seed, o.out, model, {}};
  measure_ao(stage, scene, poses, request, report);
  bar.show("comparing", "parts", 1, 3);
  write_ao_sheet(stage, scene, poses, request);
  bar.show("comparing", "parts", 2, 3);
  const std::vector<unsigned char> gamma_2 = cached_model(stage.hero, {o.cache, 2.0f, o.quiet});
  request.gamma_2_model = gamma_2;
  write_double_shadowing_sheet(context, stage, scene, poses, request);
  bar.show("comparing", "parts", 3, 3);
}

void compare_lights(const Stage& stage, CrowdScene& scene, const Options& o, nlohmann::ordered_json& report,
                    platform::ProgressBar& bar) {
  const std::vector<Bones> poses = pose_crowd(stage.hero, stage.places, 0);
  scene.set_poses(poses);
  const ComparisonRequest request{o.neighbours, o.tier, o.seed, o.out, {}, {}};
  for (std::size_t i = 0; i < o.lights.size(); ++i) {
    bar.show("lights", "lights", i, o.lights.size());
    const Light light(scene.context(), o.lights[i]);
    compare_light(stage, scene, poses, light, request, report);
  }
  bar.show("lights", "lights", o.lights.size(), o.lights.size());
}

std::unique_ptr<Light> light_of_frames(const nook::Context& context, const Options& o) {
  if (!o.probe_light) return nullptr;
  return std::make_unique<Light>(o.lights.empty() ? Light::built_in_sky(context)
                                                  : Light(context, o.lights.front()));
}

// Tries the newest OpenGL first and then 3.3, which is all that the crowd needs.
std::unique_ptr<platform::Context> create_context(const Options& o) {
  platform::ContextRequest request;
  request.kind = o.context;
  request.width = o.width_px;
  request.height = o.height_px;
  request.title = "Nook crowd";
  try {
    return platform::create_context(request);
  } catch (const std::runtime_error&) {
    request.major = request.minor = 3;
    return platform::create_context(request);
  }
}

void run(const Options& o) {
  const Hero hero = load_hero(o);
  const std::vector<unsigned char> model =
      o.hero_nook.empty() ? cached_model(hero, {o.cache, 0, o.quiet}) : platform::read_file(o.hero_nook);
  const std::unique_ptr<platform::Context> context = create_context(o);
  const std::vector<Placement> places = make_layout(clip_outlines(hero), o.characters, o.seed);
  CrowdScene scene(*context, model, {o.characters, o.neighbours, o.tier, NOOK_FORM_DEFAULT, o.lod_error});
  require_same_character(hero, scene.model());
  Renderer renderer(context->gl(), hero);
#ifdef CROWD_HAS_WINDOW_LOOP
  if (o.context == "window" && o.frames == 0) {
    const std::unique_ptr<Light> light = light_of_frames(scene.context(), o);
    const std::filesystem::path model_path = o.hero_nook.empty() ? o.out / "model.nook" : o.hero_nook;
    run_window({*context, hero, places, renderer, light.get(), model_path}, model, o);
    return;
  }
#endif
  std::filesystem::create_directories(o.out);
  platform::RenderTarget target(*context, o.width_px, o.height_px);
  std::unique_ptr<ScreenSpaceAo> screen_space;
  if (o.screen_space)
    screen_space = std::make_unique<ScreenSpaceAo>(*context, scene.gl(), o.width_px, o.height_px);
  const Stage stage{*context, hero, places, renderer, target, screen_space.get()};
  platform::ProgressBar bar(o.quiet);
  const std::unique_ptr<Light> light = light_of_frames(scene.context(), o);
  if (light) scene.set_light(light->lobes());
  const FrameTimes ms =
      draw_frames(stage, scene, {o.frames, o.out, light.get(), o.record, o.debug},
                  [&](std::uint32_t done) { bar.show("drawing", "frames", done, o.frames); });
  // The comparisons below set their own lights.
  scene.set_light({});
  nlohmann::ordered_json report = describe(*context, scene, o);
  report["links"] = scene.stats().links;
  report["light"] = light ? nlohmann::ordered_json(light->name()) : nlohmann::ordered_json();
  report["ms"] = {{"pose", ms.pose},
                  {"scene_update", ms.scene_update},
                  {"screen_space", ms.screen_space},
                  {"draw", ms.draw},
                  {"read", ms.read}};
  if (screen_space && o.measure_world) report["world_rms"] = screen_space->rms_to_every_caster(scene.gl());
  if (screen_space) {
    report["world_casters_per_pixel"] = screen_space->mean_count(NOOK_WORLD_VIEW_CASTERS);
    report["world_counts"] = {{"exact_casters", screen_space->mean_count(NOOK_WORLD_VIEW_EXACT_CASTERS)},
                              {"tests", screen_space->mean_count(NOOK_WORLD_VIEW_TESTS)},
                              {"far_casters", screen_space->mean_count(NOOK_WORLD_VIEW_FAR_CASTERS)},
                              {"far_tests", screen_space->mean_count(NOOK_WORLD_VIEW_FAR_TESTS)}};
  }
  report["screen_space"] = screen_space ? describe(screen_space->quality()) : nlohmann::ordered_json();
  report["rows"] = nlohmann::ordered_json::array();
  if (o.sheets) compare_with_rays(*context, stage, scene, o, model, report, bar);
  if (!o.lights.empty()) compare_lights(stage, scene, o, report, bar);
  const std::string text = report.dump(2) + "\n";
  platform::write_file(o.report, text.data(), text.size());
  std::printf("pictures: %s\nreport:   %s\n", std::filesystem::absolute(o.out).c_str(),
              std::filesystem::absolute(o.report).c_str());
}

int exit_code_of(nook_result result) {
  return result == NOOK_ERROR_BAD_FILE || result == NOOK_ERROR_FILE_VERSION ? 3 : 1;
}

}  // namespace
}  // namespace crowd

int main(int argc, char** argv) {
  crowd::Options options;
  int exit_code = 0;
  if (!crowd::parse_options(argc, argv, options, exit_code)) return exit_code;
  try {
    crowd::run(options);
    return 0;
  } catch (const nook::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return crowd::exit_code_of(e.result());
  } catch (const crowd::BakeError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return crowd::exit_code_of(e.result());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
