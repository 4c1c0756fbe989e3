#include "samples/crowd/frames.h"

#include <glad/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "platform/stopwatch.h"
#include "samples/crowd/debug_overlay.h"
#include "samples/crowd/recorded_frames.h"

namespace crowd {
namespace {

constexpr float kSecondsPerFrame = 1.0f / 30;

// A muted colour that stays with a character.
glm::vec3 albedo_of(std::size_t character) {
  // Linear reflectances of plaster, sand, terracotta, sage, slate and rose.
  static const glm::vec3 colours[] = {{0.62f, 0.60f, 0.56f}, {0.58f, 0.48f, 0.34f}, {0.52f, 0.28f, 0.19f},
                                      {0.34f, 0.43f, 0.30f}, {0.27f, 0.36f, 0.46f}, {0.54f, 0.38f, 0.37f}};
  return colours[character * 7 % 6];
}

}  // namespace

std::vector<DrawnInstance> drawn_crowd(const CrowdScene& scene, const std::vector<Bones>& poses, bool lit) {
  std::vector<DrawnInstance> drawn(poses.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    drawn[i] = {&poses[i], scene.ao(i), albedo_of(i), {}, 0};
    if (!lit) continue;
    const nook_gl_view view = scene.light(i);
    drawn[i].light = {view.buffer, view.offset, view.stride};
    drawn[i].light_texel = view.light;
  }
  return drawn;
}

ProbeLight probe_light(const CrowdScene& scene, const Light& light, const Camera& camera) {
  const nook_gl_view view = scene.light(0);
  glm::vec3 ahead = camera.target_ws - camera.eye_ws;
  ahead = glm::normalize(glm::vec3(ahead.x, 0.4f * glm::length(glm::vec2(ahead.x, ahead.z)), ahead.z));
  const std::vector<float> up = light.irradiance({0, 1, 0}), horizon = light.radiance(&ahead.x);
  ProbeLight look;
  look.texture = view.texture;
  look.glsl = view.glsl;
  const SplitLight parts = light.split();
  look.ground_irradiance = {parts.soft_up[0], parts.soft_up[1], parts.soft_up[2]};
  look.ground_sun_irradiance = {parts.sun_up[0], parts.sun_up[1], parts.sun_up[2]};
  const float luminance = 0.2126f * up[0] + 0.7152f * up[1] + 0.0722f * up[2];
  look.exposure = 1.2f * 3.14159265f / std::max(luminance, 1e-6f);
  look.horizon = {horizon[0], horizon[1], horizon[2]};
  return look;
}

FrameTimes draw_frames(const Stage& stage, CrowdScene& scene, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress) {
  const GladGLContext& gl = stage.context.gl();
  const float radius_m = crowd_radius_m(stage.places);
  Look look;
  look.fog_start_m = 1.2f * radius_m + 8;
  const SplitLight parts = request.light ? request.light->split() : SplitLight{};
  DebugOverlay debug(gl, stage.hero);
  FrameTimes sum;
  for (std::uint32_t frame = 0; frame < request.frames; ++frame) {
    platform::Stopwatch watch;
    const std::vector<Bones> poses = pose_crowd(stage.hero, stage.places, float(frame) * kSecondsPerFrame);
    scene.set_poses(poses);
    const Camera camera = orbit(radius_m, float(frame) / float(std::max(request.frames, 24u)));
    scene.set_camera(camera.eye_ws);
    FrameTimes now;
    now.pose = watch.lap_ms();
    scene.update();
    gl.Finish();
    now.scene_update = watch.lap_ms();
    std::vector<DrawnInstance> drawn = drawn_crowd(scene, poses, request.light != nullptr);
    if (request.debug.levels) colour_by_level(scene, drawn);
    if (stage.screen_space) {
      watch.lap_ms();
      look.screen_ao = stage.screen_space->draw(stage.renderer, drawn, camera, scene.handle(),
                                                request.light ? &parts : nullptr);
      gl.Finish();
      now.screen_space = watch.lap_ms();
      if (!request.record.empty()) {
        write_recorded_frame(*stage.screen_space, request.record, frame);
        watch.lap_ms();
      }
    }
    stage.target.bind();
    if (request.light) {
      ProbeLight lit = probe_light(scene, *request.light, camera);
      lit.fog_start_m = look.fog_start_m;
      lit.screen_ao = look.screen_ao;
      stage.renderer.draw_probe_light(drawn, camera, lit);
    } else {
      stage.renderer.draw(drawn, camera, look, glm::vec3(0), radius_m + 1);
    }
    gl.Finish();
    now.draw = watch.lap_ms();
    debug.draw(stage.renderer, {scene, poses, drawn, camera}, request.debug, true);
    watch.lap_ms();
    const platform::Image picture = stage.target.read();
    now.read = watch.lap_ms();
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04u.png", frame);
    platform::write_image(request.out / name, picture);
    progress(frame + 1);
    // The first frame also makes buffers and compiles shaders, so it does not count.
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

}  // namespace crowd
