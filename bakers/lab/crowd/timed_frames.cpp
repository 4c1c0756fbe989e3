#include "bakers/lab/crowd/timed_frames.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "bakers/lab/crowd/debug_overlay.h"
#include "platform/stopwatch.h"

namespace crowd::lab {
namespace {

constexpr float seconds_per_frame = 1.0f / 30;

// Records the frame that was drawn last.
void write_recorded_frame(ScreenPasses& passes, const std::filesystem::path& folder, unsigned number) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%04u.nook", number);
  const std::string note = "crowd, frame " + std::to_string(number);
  std::filesystem::create_directories(folder);
  passes.screen.record(passes.frame, passes.screen_frame, note.c_str()).write(folder / name);
}

// Draws the frames one after the other and times their stages.
class FrameDrawer {
 public:
  FrameDrawer(const Stage& stage, CrowdScene& scene, const FrameRequest& request)
      : gl_(stage.context.gl()),
        stage_(stage),
        scene_(scene),
        request_(request),
        radius_m_(crowd_radius_m(stage.places)),
        debug_(gl_) {}

  FrameTimes draw(std::uint32_t frame) {
    platform::Stopwatch watch;
    FrameTimes now;
    const std::vector<Bones> poses = pose_crowd(stage_.hero, stage_.places, float(frame) * seconds_per_frame);
    const Camera camera = orbit(radius_m_, float(frame) / float(std::max(request_.frames, 24u)));
    scene_.set_poses(poses);
    scene_.set_camera(camera.eye_ws);
    now.pose = watch.lap_ms();
    scene_.update();
    gl_.Finish();
    now.scene_update = watch.lap_ms();
    std::vector<DrawnInstance> drawn = scene_.drawn(poses);
    if (request_.debug.levels) colour_by_level(scene_, drawn);
    ScreenAo screen_ao;
    if (stage_.passes) {
      watch.lap_ms();
      screen_ao = stage_.passes->draw(stage_.renderer, drawn, camera, scene_.scene().get(), request_.light);
      gl_.Finish();
      now.screen_space = watch.lap_ms();
      if (!request_.record.empty()) write_recorded_frame(*stage_.passes, request_.record, frame);
      watch.lap_ms();
    }
    stage_.target.bind();
    draw_lit(drawn, camera, screen_ao);
    gl_.Finish();
    now.draw = watch.lap_ms();
    debug_.draw(stage_.renderer, {scene_, stage_.hero, poses, drawn, camera}, request_.debug);
    watch.lap_ms();
    const platform::Image picture = stage_.target.read();
    now.read = watch.lap_ms();
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04u.png", frame);
    platform::write_image(request_.out / name, picture);
    return now;
  }

 private:
  void draw_lit(const std::vector<DrawnInstance>& drawn, const Camera& camera, const ScreenAo& screen_ao) {
    const float fog_start_m = 1.2f * radius_m_ + 8;
    if (request_.light) {
      const nook_gl_view view = scene_.light();
      stage_.renderer.draw(drawn, camera,
                           {*request_.light, view.texture, view.glsl, 1, fog_start_m, screen_ao});
    } else {
      PlainLook look;
      look.fog_start_m = fog_start_m;
      look.screen_ao = screen_ao;
      stage_.plain.draw(drawn, camera, look, glm::vec3(0), radius_m_ + 1);
    }
  }

  const GladGLContext& gl_;
  const Stage& stage_;
  CrowdScene& scene_;
  const FrameRequest& request_;
  float radius_m_;
  DebugOverlay debug_;
};

// Reads one value per pixel of the last frame. Also reads whether the pixel shows a surface.
std::vector<float> read(const GladGLContext& gl, const ScreenPasses& passes, GLuint texture, GLenum format) {
  std::vector<float> values(std::size_t(passes.width_px) * std::size_t(passes.height_px));
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.GetTexImage(GL_TEXTURE_2D, 0, format, GL_FLOAT, values.data());
  return values;
}

// Returns the descriptor of the last frame of the world pass, changed to compute AO instead of light, because
// the light may no longer exist.
nook_world_frame_desc last_frame(const ScreenPasses& passes) {
  nook_world_frame_desc frame = passes.world_frame;
  frame.lobes = nullptr;
  frame.lobe_count = 0;
  frame.light_degrees = 0;
  return frame;
}

template <class Value>
double mean_over_surfaces(const GladGLContext& gl, const ScreenPasses& passes, Value value) {
  const std::vector<float> depth = read(gl, passes, passes.frame.depth_texture, GL_DEPTH_COMPONENT);
  double sum = 0, surfaces = 0;
  for (std::size_t i = 0; i < depth.size(); ++i)
    if (depth[i] < 1) {
      sum += value(i);
      surfaces += 1;
    }
  return sum / std::max(surfaces, 1.0);
}

}  // namespace

FrameTimes draw_frames(const Stage& stage, CrowdScene& scene, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress) {
  FrameDrawer drawer(stage, scene, request);
  FrameTimes sum;
  for (std::uint32_t frame = 0; frame < request.frames; ++frame) {
    const FrameTimes now = drawer.draw(frame);
    progress(frame + 1);
    // The first frame is not counted, because it also creates buffers and compiles shaders.
    if (frame == 0 && request.frames > 1) continue;
    sum.pose += now.pose;
    sum.scene_update += now.scene_update;
    sum.screen_space += now.screen_space;
    sum.draw += now.draw;
    sum.read += now.read;
  }
  const double measured = request.frames > 1 ? request.frames - 1 : std::max(request.frames, 1u);
  return {sum.pose / measured, sum.scene_update / measured, sum.screen_space / measured, sum.draw / measured,
          sum.read / measured};
}

double mean_count(const GladGLContext& gl, ScreenPasses& passes, nook_world_view view) {
  nook_world_frame_desc frame = last_frame(passes);
  nook_world_frame_debug_desc debug;
  nook::check(nook_world_frame_debug_desc_init(&debug));
  debug.show = view;
  frame.next = &debug;
  passes.world.render(passes.frame, frame);
  const std::vector<float> counts = read(gl, passes, passes.world.info().texture, GL_RED);
  return mean_over_surfaces(gl, passes, [&](std::size_t i) { return 255 * double(counts[i]); });
}

double rms_to_every_caster(const GladGLContext& gl, ScreenPasses& passes, const nook::Gl& nook_gl) {
  nook_world_frame_desc frame = last_frame(passes);
  frame.ao_texture = 0;
  passes.world.render(passes.frame, frame);
  const std::vector<float> found = read(gl, passes, passes.world.info().texture, GL_RED);
  frame.cutoff_error = frame.level_error = 0;
  nook::WorldPass exact(nook_gl, world_settings(passes.width_px, passes.height_px, {}));
  exact.render(passes.frame, frame);
  const std::vector<float> wanted = read(gl, passes, exact.info().texture, GL_RED);
  return std::sqrt(mean_over_surfaces(gl, passes, [&](std::size_t i) {
    return double(found[i] - wanted[i]) * double(found[i] - wanted[i]);
  }));
}

}  // namespace crowd::lab
