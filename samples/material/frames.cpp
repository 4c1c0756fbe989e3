#include "samples/material/frames.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>

#include "platform/stopwatch.h"

namespace material {
namespace {

// Binds the target for drawing and clears it to the background.
void begin_picture(const Stage& stage) {
  const GladGLContext& gl = stage.context.gl();
  stage.target.bind();
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.DepthMask(GL_TRUE);
  gl.ClearColor(0.16f, 0.22f, 0.27f, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  stage.is_one_sided ? gl.Enable(GL_CULL_FACE) : gl.Disable(GL_CULL_FACE);
}

}  // namespace

void draw_frame(const Stage& stage, const MaterialProgram& program, const View& view, bool silhouettes) {
  begin_picture(stage);
  const auto draw = [&](Pass pass) {
    program.begin(view, pass);
    for (const Mesh& mesh : stage.meshes) mesh.draw();
  };
  if (!silhouettes) {
    draw(Pass::whole);
    return;
  }
  draw(Pass::depth);
  draw(Pass::colour);
  draw(Pass::part_visible);
}

FrameTimes draw_frames(const Stage& stage, const MaterialProgram& program, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress) {
  const GladGLContext& gl = stage.context.gl();
  // The first draw compiles the shaders and also gives the picture without silhouettes.
  draw_frame(stage, program, view_at(0, stage.aspect), false);
  platform::write_image(request.out / (request.name + "_flat.png"), stage.target.read());
  draw_frame(stage, program, view_at(0, stage.aspect), true);
  constexpr double unknown = std::numeric_limits<double>::infinity();
  FrameTimes min{unknown, unknown};
  for (std::uint32_t frame = 0; frame < request.frames; ++frame) {
    const View view = view_at(float(frame) / float(request.frames), stage.aspect);
    gl.Finish();
    platform::Stopwatch watch;
    const std::clock_t cpu_begin = std::clock();
    draw_frame(stage, program, view, true);
    gl.Finish();
    min.ms = std::min(min.ms, watch.lap_ms());
    min.cpu_ms = std::min(min.cpu_ms, 1e3 * double(std::clock() - cpu_begin) / CLOCKS_PER_SEC);
    char number[16];
    std::snprintf(number, sizeof number, "_%03u.png", frame);
    platform::write_image(request.out / (request.name + number), stage.target.read());
    progress(frame + 1);
  }
  return min;
}

}  // namespace material
