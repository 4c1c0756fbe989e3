// Bakes a character, fills a plane with a crowd of it, and draws the crowd with Nook's ambient occlusion.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>

#include "platform/file_bytes.h"
#include "platform/progress_bar.h"
#include "platform/render_target.h"
#include "platform/standard_streams.h"
#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/places.h"
#include "samples/crowd/screen_passes.h"
#include "samples/crowd/window.h"

namespace crowd {
namespace {

struct Options {
  std::filesystem::path hero_glb, hero_nook, out = "out/crowd";
  std::string context = "egl", size = "1280x720";
  int width_px = 0, height_px = 0;
  std::uint32_t frames = 4, seed = 1;
  CrowdSize crowd;
  bool quiet = false;
  WindowRequest window;
};

// Rejects a window if the program was built without ImGui, and options that need a window if there is none.
void require_window(const CLI::App& app, const Options& o) {
#ifndef CROWD_HAS_WINDOW
  if (o.context == "window")
    throw CLI::ValidationError(
        "--context",
        "this program was built without a window: install ImGui and configure again, or use egl");
#endif
  if (o.context == "window") return;
  for (const char* option : {"--debug", "--debug-bodies", "--window-picture"})
    if (app.count(option) > 0) throw CLI::ValidationError(option, "needs --context window");
}

// Returns the program's exit code, or -1 to continue.
int parse(int argc, char** argv, Options& o) {
  CLI::App app("Draws a crowd of animated characters with Nook's ambient occlusion.");
  // The last of several values wins, so that the caller of a script can override its values.
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.add_option("hero", o.hero_glb,
                 "the rigged character, a .glb or .gltf file. Default: a built-in character")
      ->check(CLI::ExistingFile);
  app.add_option("model", o.hero_nook,
                 "the model that was baked from the character, a .nook file. Default: the program bakes one "
                 "with the draft preset, and keeps it for the next run")
      ->check(CLI::ExistingFile);
  app.add_option("--context", o.context,
                 std::string("how to create the OpenGL context (default egl): ") + platform::context_kinds())
      ->check(CLI::IsMember({"window", "egl", "osmesa"}));
  app.add_option("--characters", o.crowd.characters, "number of characters in the crowd. Default: 100")
      ->check(CLI::Range(1, 10000));
  app.add_option("--neighbours", o.crowd.neighbours,
                 "number of neighbours that darken each character, the nearest ones. Default: 4")
      ->check(CLI::Range(0, 16));
  app.add_option("--frames", o.frames, "number of pictures to draw if there is no window. Default: 4")
      ->check(CLI::Range(1, 100000));
  app.add_option("--size", o.size, "size of a picture in pixels, WIDTHxHEIGHT. Default: 1280x720");
  app.add_option("--out", o.out, "write the pictures into this folder. Default: out/crowd");
  app.add_option("--tier", o.crowd.tier,
                 "highest OpenGL tier to use: 33 (OpenGL 3.3), 43 (4.3, compute shaders) or best. Default: "
                 "best, the highest tier of the context")
      ->transform(CLI::CheckedTransformer(std::map<std::string, int>{{"33", 33}, {"43", 43}, {"best", 0}}));
  app.add_option("--seed", o.seed, "seed of the random positions of the characters. Default: 1");
  app.add_option("--debug", o.window.debug,
                 "with --context window: show the proxy spheres (spheres) or the links between bodies "
                 "(links) at the start; separate them by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"spheres", "links"}))
      ->allow_extra_args(false)  // what follows are files
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--debug-bodies", o.window.bodies,
                 "with --debug spheres: number of bodies whose spheres are shown. Default: 1")
      ->check(CLI::Range(1, 16));
  app.add_option("--window-picture", o.window.picture,
                 "with --context window: write a picture of the window to this file, then close the window");
  app.add_flag("--quiet", o.quiet, "do not show progress");
  try {
    app.parse(argc, argv);
    char rest = 0;
    if (std::sscanf(o.size.c_str(), "%dx%d%c", &o.width_px, &o.height_px, &rest) != 2 ||
        std::min(o.width_px, o.height_px) < 16 || std::max(o.width_px, o.height_px) > 8192)
      throw CLI::ValidationError("--size", "got '" + o.size + "', need WIDTHxHEIGHT from 16x16 to 8192x8192");
    require_window(app, o);
    return -1;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? code_after_output(0) : 2;
  }
}

// Writes frame_0000.png and so on, and without_ao.png, which is the first frame without ambient occlusion.
void draw_frames(platform::Context& context, const Hero& hero, const std::vector<Placement>& places,
                 CrowdScene& scene, const Light& light, const Options& o) {
  constexpr float seconds_per_frame = 1.0f / 30;
  Renderer renderer(context.gl(), hero);
  ScreenPasses passes(context, scene.gl(), o.width_px, o.height_px);
  const platform::RenderTarget target(context, o.width_px, o.height_px);
  const float radius_m = crowd_radius_m(places);
  platform::ProgressBar bar(o.quiet);
  for (std::uint32_t frame = 0; frame < o.frames; ++frame) {
    const std::vector<Bones> poses = pose_crowd(hero, places, float(frame) * seconds_per_frame);
    const Camera camera = orbit(radius_m, float(frame) / float(std::max(o.frames, 24u)));
    scene.set_poses(poses);
    scene.set_camera(camera.eye_ws);
    scene.update();
    const std::vector<DrawnInstance> drawn = scene.drawn(poses);
    const nook_gl_view view = scene.light();
    // The fog begins behind the crowd.
    Look look{light, view.texture, view.glsl, 1, 1.2f * radius_m + 8, {}};
    look.screen_ao = passes.draw(renderer, drawn, camera, scene.scene().get(), &light);
    const auto write = [&](const char* name) {
      target.bind();
      renderer.draw(drawn, camera, look);
      platform::write_image(o.out / name, target.read());
    };
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04u.png", frame);
    write(name);
    look.ao_strength = 0;
    if (frame == 0) write("without_ao.png");
    bar.show("drawing", "frames", frame + 1, o.frames);
  }
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
  const Hero hero(o.hero_glb.empty() ? built_in_glb(CROWD_CACHE) : o.hero_glb);
  const std::vector<unsigned char> model =
      o.hero_nook.empty() ? cached_model(hero, CROWD_CACHE, o.quiet) : platform::read_file(o.hero_nook);
  const std::unique_ptr<platform::Context> context = create_context(o);
  const std::vector<Placement> places = make_layout(clip_outlines(hero), o.crowd.characters, o.seed);
  CrowdScene scene(*context, hero, model, o.crowd);
  const Light light = sky();
  scene.set_light(light.lobes);
#ifdef CROWD_HAS_WINDOW
  if (o.context == "window") {
    WindowRequest request = o.window;
    request.model = o.hero_nook.empty() ? o.out / "model.nook" : o.hero_nook;
    request.link_count = int(o.crowd.neighbours);
    return run_window(*context, hero, places, scene, light, request);
  }
#endif
  std::filesystem::create_directories(o.out);
  draw_frames(*context, hero, places, scene, light, o);
  std::printf("pictures: %s\n", std::filesystem::absolute(o.out).c_str());
}

}  // namespace
}  // namespace crowd

int main(int argc, char** argv) {
  open_closed_streams();
  crowd::Options options;
  if (const int code = crowd::parse(argc, argv, options); code >= 0) return code;
  try {
    crowd::run(options);
    return 0;
  } catch (const nook::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return e.result() == NOOK_ERROR_BAD_FILE || e.result() == NOOK_ERROR_FILE_VERSION ? 3 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
