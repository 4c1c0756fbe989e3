#include "frames.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

namespace material {

void draw_frame(const Stage& stage, const MaterialProgram& program, const View& view, bool silhouettes) {
  stage.target.begin();
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

double draw_frames(const Stage& stage, const MaterialProgram& program, const FrameRequest& request,
                   const std::function<void(std::uint32_t)>& progress) {
  using Clock = std::chrono::steady_clock;
  const GladGLContext& gl = stage.context.gl();
  // The first draw compiles; it also gives the picture without silhouettes.
  draw_frame(stage, program, view_at(0, stage.aspect), false);
  platform::write_image(request.out / (request.name + "_flat.png"), stage.target.read());
  draw_frame(stage, program, view_at(0, stage.aspect), true);
  double least_ms = std::numeric_limits<double>::infinity();
  for (std::uint32_t frame = 0; frame < request.frames; ++frame) {
    const View view = view_at(float(frame) / float(request.frames), stage.aspect);
    gl.Finish();
    const Clock::time_point begin = Clock::now();
    draw_frame(stage, program, view, true);
    gl.Finish();
    least_ms = std::min(least_ms, std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    char number[16];
    std::snprintf(number, sizeof number, "_%03u.png", frame);
    platform::write_image(request.out / (request.name + number), stage.target.read());
    progress(frame + 1);
  }
  return least_ms;
}

}  // namespace material
