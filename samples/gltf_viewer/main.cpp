// Shows an animated glTF character with Nook's ambient occlusion, in a window or as pictures.
//
//   gltf_viewer CHARACTER.glb MODEL.nook [--clip NAME] [--without NODE] [--frames N --size WxH --out DIR]
//
// nook_ao.h is all that concerns Nook. The other files play the part of an engine.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "platform/file_bytes.h"
#include "platform/platform.h"
#include "platform/standard_streams.h"
#include "platform/stopwatch.h"
#include "samples/gltf_viewer/nook_ao.h"
#include "samples/gltf_viewer/renderer.h"

namespace viewer {
namespace {

struct Options {
  std::filesystem::path character, model, out;
  std::string clip;
  std::vector<std::string> without;
  int frames = 1, width_px = 960, height_px = 720;
};

bool parse_options(int argc, char** argv, Options& o, int& exit_code) {
  CLI::App app("Shows an animated glTF character with Nook's ambient occlusion.");
  std::string size = "960x720";
  app.add_option("character", o.character, "the rigged character, a .glb or .gltf file")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("model", o.model,
                 "the model of the character, a .nook file that `nook bake character` wrote")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--clip", o.clip, "name of the clip to play. Default: the first clip of the file");
  app.add_option("--without", o.without,
                 "name of a node that the bake left out with its option --without. You can repeat the option")
      ->allow_extra_args(false);
  app.add_option("--frames", o.frames,
                 "with --out: number of pictures to draw, spread over the clip. Default: 1")
      ->check(CLI::Range(1, 100000));
  app.add_option("--size", size, "size of a picture in pixels, WIDTHxHEIGHT. Default: 960x720");
  app.add_option("--out", o.out, "write pictures into this folder. Default: open a window instead");
  try {
    app.parse(argc, argv);
    char rest = 0;
    if (std::sscanf(size.c_str(), "%dx%d%c", &o.width_px, &o.height_px, &rest) != 2 || o.width_px < 16 ||
        o.height_px < 16 || o.width_px > 8192 || o.height_px > 8192)
      throw CLI::ValidationError("--size", "got '" + size + "', need WIDTHxHEIGHT from 16x16 to 8192x8192");
    return true;
  } catch (const CLI::ParseError& e) {
    exit_code = app.exit(e) == 0 ? code_after_output(0) : 2;
    return false;
  }
}

struct Box {
  glm::vec3 low{1e30f}, high{-1e30f};
};

Box box_of(const std::vector<glm::vec3>& points) {
  Box box;
  for (const glm::vec3& p : points) {
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  return box;
}

// The camera looks at the whole character from a little above, turned by an angle.
View view_of(const Box& box, float turn_rad, float aspect) {
  const glm::vec3 centre = 0.5f * (box.low + box.high);
  const float radius = 0.5f * glm::length(box.high - box.low), fov_rad = 0.5f;
  const float distance = 0.97f * radius / std::sin(0.5f * fov_rad) / std::min(aspect, 1.0f);
  const glm::vec3 from(0.97f * std::sin(turn_rad), 0.24f, 0.97f * std::cos(turn_rad));
  return {glm::lookAt(centre + distance * from, centre, glm::vec3(0, 1, 0)),
          glm::perspective(fov_rad, aspect, 0.3f * distance, 4 * distance)};
}

void run(const Options& o) {
  const CharacterFile file(o.character, o.without);
  const Clip* const clip = file.find_clip(o.clip);
  platform::ContextRequest request;
  request.kind = o.out.empty() ? "window" : "egl";
  request.width = o.width_px;
  request.height = o.height_px;
  request.title = "gltf_viewer";
  const std::unique_ptr<platform::Context> context = platform::create_context(request);
  const GladGLContext& gl = context->gl();
  Renderer renderer(gl, file, o.width_px, o.height_px);
  NookAo nook(file, platform::read_file(o.model), platform::Context::loader, context.get(), o.width_px,
              o.height_px);
  const float duration_s = clip ? clip->duration_s : 0;
  const Box box = box_of(file.skinned(file.pose(clip, 0.3f * duration_s)));
  const float size_m = glm::length(box.high - box.low), aspect = float(o.width_px) / float(o.height_px);

  if (!o.out.empty()) std::filesystem::create_directories(o.out);
  platform::Stopwatch watch;
  double time_s = 0;
  for (int frame = 0; o.out.empty() ? !context->should_close() : frame < o.frames; ++frame) {
    if (o.out.empty())
      time_s = std::fmod(time_s + watch.lap_ms() / 1000, std::max(double(duration_s), 1e-3));
    else
      time_s = (frame + 0.3) / o.frames * double(duration_s);
    const Pose pose = file.pose(clip, float(time_s));
    const View view = view_of(box, o.out.empty() ? 0.5f : 0.5f + 0.4f * float(frame), aspect);
    const nook_gl_view ao = nook.character(pose);
    renderer.draw_depth(pose, view, 2 * size_m);
    const GLuint screen_ao =
        nook.screen(renderer.depth(), renderer.layer(), view.clip_from_view, 0.2f * size_m);
    renderer.draw_colour({ao.buffer, ao.offset, ao.stride}, screen_ao);
    if (o.out.empty()) {
      int width = 0, height = 0;
      context->size(&width, &height);
      renderer.show(context->framebuffer(), width, height);
      context->present();
      continue;
    }
    renderer.bind_picture();
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04d.png", frame);
    platform::write_image(o.out / name, platform::read_pixels(*context, o.width_px, o.height_px));
  }
}

}  // namespace
}  // namespace viewer

int main(int argc, char** argv) {
  open_closed_streams();
  viewer::Options options;
  int exit_code = 0;
  if (!viewer::parse_options(argc, argv, options, exit_code)) return exit_code;
  try {
    viewer::run(options);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "gltf_viewer: %s\n", e.what());
    return 3;
  }
}
