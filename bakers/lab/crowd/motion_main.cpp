// nook-lab-motion: draws each frame of a few moving bodies three times: without occlusion, with Nook, and ray
// traced. docs/animations.py makes the animations of the documents from these pictures.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <numeric>

#include "bakers/lab/crowd/dressed_bodies.h"
#include "bakers/lab/crowd/given_values.h"
#include "bakers/lab/crowd/light_file.h"
#include "bakers/lab/crowd/motion_scenes.h"
#include "bakers/lab/crowd/shadow_ratio.h"
#include "platform/file_bytes.h"
#include "platform/progress_bar.h"
#include "platform/render_target.h"
#include "platform/standard_streams.h"
#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/screen_passes.h"

namespace crowd::lab {
namespace {

struct Options {
  std::filesystem::path model, character, out = "out/motion";
  std::string scene = "walk", context = "egl";
  int width_px = 480, tier = 0;
  std::uint32_t frames = 24, rays = 64;
  bool quiet = false;
};

int parse(int argc, char** argv, Options& o) {
  CLI::App app("Draws moving bodies three times: without occlusion, with Nook, and ray traced.");
  app.add_option("model", o.model, "the baked model of the built-in character, a .nook file")
      ->check(CLI::ExistingFile)
      ->required();
  app.add_option("--character", o.character,
                 "the built-in character, a .glb file that the program mannequin writes. Default: generate "
                 "it in memory")
      ->check(CLI::ExistingFile);
  app.add_option("--scene", o.scene, "name of the motion to draw. Default: walk")
      ->check(CLI::IsMember(motion_scene_names()));
  app.add_option("--frames", o.frames, "number of pictures of one loop of the motion. Default: 24")
      ->check(CLI::Range(1, 1000));
  app.add_option("--rays", o.rays,
                 "number of paths for each point of the ray-traced pictures. 0 means no ray-traced pictures. "
                 "Default: 64")
      ->check(CLI::Range(0, 65536));
  app.add_option("--width", o.width_px, "width of a picture in pixels. Default: 480")
      ->check(CLI::Range(16, 4096));
  app.add_option("--out", o.out,
                 "write the pictures into this folder, as off_body_0000.png, nook_body_0000.png, "
                 "traced_body_0000.png and so on. Default: out/motion");
  app.add_option("--context", o.context,
                 std::string("how to create the OpenGL context (default egl): ") + platform::context_kinds())
      ->check(CLI::IsMember({"egl", "osmesa"}));
  app.add_option("--tier", o.tier,
                 "highest OpenGL tier to use: 33 (OpenGL 3.3), 43 (4.3, compute shaders) or best. Default: "
                 "best, the highest tier of the context")
      ->transform(CLI::CheckedTransformer(std::map<std::string, int>{{"33", 33}, {"43", 43}, {"best", 0}}));
  app.add_flag("--quiet", o.quiet, "do not show progress");
  try {
    app.parse(argc, argv);
    return -1;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? code_after_output(0) : 2;
  }
}

std::vector<DrawnInstance> dressed(std::vector<DrawnInstance> drawn, const MotionScene& scene) {
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].albedo = scene.movers[i].shirt;
  return drawn;
}

// The objects that are needed to draw one shot.
struct ShotTarget {
  ShotTarget(platform::Context& context, const nook::Gl& gl, const Shot& from, int width_px)
      : shot(from),
        // Uses full resolution even without a GPU. The floor is a plane, and the taps of the screen pass do
        // not darken a plane.
        passes(context, gl, width_px, height_px(from, width_px), {9, false}),
        target(context, width_px, height_px(from, width_px)) {}

  static int height_px(const Shot& shot, int width_px) {
    return std::max(16, int(shot.height * float(width_px)));
  }

  const Shot& shot;
  ScreenPasses passes;
  platform::RenderTarget target;
};

// Draws the frames of one scene.
class MotionFrames {
 public:
  MotionFrames(platform::Context& context, const Hero& hero, const std::vector<unsigned char>& model,
               const Options& o)
      : gl_(context.gl()),
        hero_(hero),
        options_(o),
        scene_(motion_scene(o.scene)),
        light_(light_of_lobes("sky", sky())),
        crowd_(context, hero, model, {std::uint32_t(scene_.movers.size()), 4, o.tier}),
        renderer_(context.gl(), hero) {
    crowd_.set_light(light_.light.lobes);
    for (const Shot& shot : scene_.shots)
      targets_.push_back(std::make_unique<ShotTarget>(context, crowd_.gl(), shot, o.width_px));
  }

  void draw(std::uint32_t frame) {
    const float part = float(frame) / float(options_.frames);
    const std::vector<Bones> poses = poses_of(hero_, scene_, part);
    const DressedLook look{light_.light, part * scene_.floor_travel_m, 1};
    crowd_.set_poses(poses);
    crowd_.update();
    const std::vector<DrawnInstance> drawn = dressed(crowd_.drawn(poses), scene_);
    for (const auto& target : targets_) draw_nook(frame, drawn, look, *target);
    if (options_.rays > 0) draw_traced(frame, poses, drawn, look);
  }

 private:
  // Draws the picture with Nook's occlusion and the picture without occlusion.
  void draw_nook(std::uint32_t frame, const std::vector<DrawnInstance>& drawn, DressedLook look,
                 ShotTarget& target) {
    const nook_gl_view view = crowd_.light();
    if (!bodies_) bodies_.emplace(gl_, renderer_, view.glsl);
    const Camera& camera = target.shot.camera;
    const ScreenAo screen_ao =
        target.passes.draw(renderer_, drawn, camera, crowd_.scene().get(), &light_.light);
    for (const char* const kind : {"nook", "off"}) {
      target.target.bind();
      bodies_->draw(drawn, camera, look, view.texture, screen_ao);
      write(kind, target, frame);
      look.ao_strength = 0;
    }
  }

  void draw_traced(std::uint32_t frame, const std::vector<Bones>& poses, std::vector<DrawnInstance> drawn,
                   const DressedLook& look) {
    const measure::PosedCrowd posed(hero_.character().get(), poses);
    std::vector<std::uint32_t> all(poses.size());
    std::iota(all.begin(), all.end(), 0u);
    // All frames use the same rays, so that the noise does not flicker.
    const measure::TracedIrradiance traced =
        smooth_irradiance(posed, all, scene_.floor, light_.environment(), {options_.rays, 1, true});
    const VertexBuffer irradiance(gl_, traced.bodies, 3);
    for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].light = irradiance.source(i);
    const FloorImage floor(gl_, {scene_.floor, traced.floor}, 3);
    for (const auto& target : targets_) {
      target->target.bind();
      bodies_->draw_given(drawn, target->shot.camera, look, floor.floor());
      write("traced", *target, frame);
    }
  }

  void write(const char* kind, const ShotTarget& target, std::uint32_t frame) const {
    char number[16];
    std::snprintf(number, sizeof number, "_%04u.png", frame);
    platform::write_image(options_.out / (kind + ("_" + target.shot.name) + number), target.target.read());
  }

  const GladGLContext& gl_;
  const Hero& hero_;
  const Options& options_;
  const MotionScene scene_;
  const MapLight light_;
  CrowdScene crowd_;
  Renderer renderer_;
  std::vector<std::unique_ptr<ShotTarget>> targets_;
  std::optional<DressedBodies> bodies_;
};

void run(const Options& o) {
  const Hero hero(o.character.empty() ? built_in_glb(CROWD_CACHE) : o.character);
  platform::ContextRequest request;
  request.kind = o.context;
  request.width = o.width_px;
  request.height = o.width_px;
  if (o.tier == 33) request.major = request.minor = 3;
  const std::unique_ptr<platform::Context> context = platform::create_context(request);
  std::filesystem::create_directories(o.out);
  MotionFrames frames(*context, hero, platform::read_file(o.model), o);
  platform::ProgressBar bar(o.quiet);
  for (std::uint32_t frame = 0; frame < o.frames; ++frame) {
    frames.draw(frame);
    bar.show("drawing", "frames", frame + 1, o.frames);
  }
  std::printf("pictures: %s\n", std::filesystem::absolute(o.out).c_str());
}

}  // namespace
}  // namespace crowd::lab

int main(int argc, char** argv) {
  open_closed_streams();
  crowd::lab::Options options;
  if (const int code = crowd::lab::parse(argc, argv, options); code >= 0) return code;
  try {
    crowd::lab::run(options);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
