#include "samples/crowd/window_loop.h"

#include <glad/gl.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "platform/file_bytes.h"
#include "platform/stopwatch.h"
#include "samples/crowd/debug_overlay.h"
#include "samples/crowd/frames.h"
#include "samples/crowd/model_bake.h"
#include "samples/crowd/model_file.h"
#include "samples/crowd/recorded_frames.h"
#include "samples/crowd/window_controls.h"

namespace crowd {
namespace {

// A picture of the window waits for a few frames, in which ImGui finds the sizes of its panels.
constexpr std::uint32_t kSettlingFrames = 4;

nook_bake_preset preset_of(const std::string& name) {
  if (name == "production") return NOOK_BAKE_PRESET_PRODUCTION;
  return name == "standard" ? NOOK_BAKE_PRESET_STANDARD : NOOK_BAKE_PRESET_DRAFT;
}

// Returns a line for the user.
std::string record_frame(ScreenSpaceAo& screen_space, const std::filesystem::path& folder) {
  try {
    const unsigned number = next_frame_number(folder);
    write_recorded_frame(screen_space, folder, number);
    return "recorded frame " + std::to_string(number) + " into " + folder.string();
  } catch (const std::exception& failure) {
    return failure.what();
  }
}

class Window {
 public:
  Window(const WindowStage& stage, std::vector<unsigned char> model, const Options& options);
  void run();

 private:
  void make_scene();
  void follow_settings();
  void follow_model();
  void follow_bake();
  void draw_frame();
  void draw_crowd(const std::vector<DrawnInstance>& drawn, const Camera& camera, const ScreenAo& screen_ao);
  ScreenAo draw_screen_space(const std::vector<DrawnInstance>& drawn, const Camera& camera, int width,
                             int height);
  void draw_controls();
  bool wrote_picture();

  const WindowStage& stage_;
  const Options& options_;
  std::vector<unsigned char> model_;
  ModelFile file_;
  Gui gui_;
  Controls controls_, applied_;  // applied: the settings that the scene was made with
  Readings readings_;
  SplitLight light_parts_;
  float radius_m_;
  std::unique_ptr<CrowdScene> scene_;
  std::unique_ptr<ScreenSpaceAo> screen_space_;
  DebugOverlay debug_;
  std::optional<ModelBake> bake_;
  bool lit_ = false;
  double time_s_ = 0;
  std::uint32_t frames_ = 0;
  platform::Stopwatch frame_watch_, file_watch_;
  double since_file_ms_ = 0;
};

Window::Window(const WindowStage& stage, std::vector<unsigned char> model, const Options& options)
    : stage_(stage),
      options_(options),
      model_(std::move(model)),
      file_(stage.model_path),
      gui_(stage.context.window()),
      light_parts_(stage.light ? stage.light->split() : SplitLight{}),
      radius_m_(crowd_radius_m(stage.places)),
      debug_(stage.context.gl(), stage.hero) {
  controls_.link_count = int(options.neighbours);
  controls_.tier = options.tier;
  controls_.lod_error = options.lod_error;
  controls_.screen_space = options.screen_space;
  controls_.distance_m = radius_m_ + 4;
  controls_.debug = options.debug;
  controls_.playing = !options.debug.error;
  controls_.preset = preset_of(options.bake);
  controls_.bake = !options.bake.empty();
  readings_.have_light = stage.light != nullptr;
  readings_.characters = std::uint32_t(stage.places.size());
  readings_.model_name = stage.model_path.filename().string();
  make_scene();
}

void Window::make_scene() {
  screen_space_.reset();
  scene_.reset();
  scene_ = std::make_unique<CrowdScene>(
      stage_.context, model_,
      CrowdSceneRequest{std::uint32_t(stage_.places.size()), std::uint32_t(controls_.link_count),
                        controls_.tier, NOOK_FORM_DEFAULT, controls_.lod_error});
  applied_ = controls_;
  lit_ = false;
}

void Window::follow_settings() {
  if (controls_.tier != applied_.tier || controls_.lod_error != applied_.lod_error) make_scene();
  if (controls_.link_count != applied_.link_count) {
    scene_->link_nearest(std::uint32_t(controls_.link_count));
    applied_.link_count = controls_.link_count;
  }
  const bool want_light = stage_.light && controls_.probe_light;
  if (want_light == lit_) return;
  scene_->set_light(want_light ? std::span(stage_.light->lobes()) : std::span<const nook_lobe>());
  lit_ = want_light;
}

// Looks at the file a few times in a second, whoever has written it.
void Window::follow_model() {
  since_file_ms_ += file_watch_.lap_ms();
  if (since_file_ms_ < 250) return;
  since_file_ms_ = 0;
  std::optional<std::vector<unsigned char>> changed = file_.take_change();
  if (!changed) return;
  try {
    scene_->set_model(*changed);
    model_ = std::move(*changed);
    readings_.model_text = "loaded again, " + std::to_string(model_.size() / 1024) + " KiB";
  } catch (const std::exception& failure) {
    readings_.model_text = std::string("kept the model from before: ") + failure.what();
  }
}

void Window::follow_bake() {
  if (controls_.bake && !bake_) bake_.emplace(stage_.hero, nook_bake_preset(controls_.preset), 0.0f);
  readings_.bake.reset();
  if (!bake_) return;
  if (controls_.cancel) bake_->cancel();
  if (!bake_->is_done()) {
    readings_.bake = bake_->progress();
    return;
  }
  try {
    const std::vector<unsigned char> model = bake_->model();
    platform::write_file(file_.path(), model.data(), model.size());  // follow_model loads it
    readings_.model_text = "baked";
    since_file_ms_ = 1e9;
  } catch (const std::exception& failure) {
    readings_.model_text = failure.what();
  }
  bake_.reset();
}

ScreenAo Window::draw_screen_space(const std::vector<DrawnInstance>& drawn, const Camera& camera, int width,
                                   int height) {
  if (!screen_space_ || screen_space_->width_px() != width || screen_space_->height_px() != height) {
    screen_space_.reset();  // frees its memory before the next one takes its own
    screen_space_ = std::make_unique<ScreenSpaceAo>(stage_.context, scene_->gl(), width, height);
  }
  const ScreenAo ao =
      screen_space_->draw(stage_.renderer, drawn, camera, scene_->handle(), lit_ ? &light_parts_ : nullptr);
  if (controls_.record)
    readings_.recorded =
        record_frame(*screen_space_, options_.record.empty() ? options_.out : options_.record);
  return ao;
}

void Window::draw_crowd(const std::vector<DrawnInstance>& drawn, const Camera& camera,
                        const ScreenAo& screen_ao) {
  const float ao_strength = controls_.ao ? controls_.intensity : 0, fog_start_m = 1.2f * radius_m_ + 8;
  if (lit_) {
    ProbeLight probe = probe_light(*scene_, *stage_.light, camera);
    probe.ao_strength = ao_strength;
    probe.fog_start_m = fog_start_m;
    probe.screen_ao = screen_ao;
    stage_.renderer.draw_probe_light(drawn, camera, probe);
    return;
  }
  Look look;
  look.ao_strength = ao_strength;
  look.key_strength = controls_.key;
  look.fog_start_m = fog_start_m;
  look.screen_ao = screen_ao;
  stage_.renderer.draw(drawn, camera, look, glm::vec3(0), radius_m_ + 1);
}

void Window::draw_frame() {
  const GladGLContext& gl = stage_.context.gl();
  const double frame_ms = frame_watch_.lap_ms();
  if (controls_.playing) time_s_ += frame_ms / 1000;
  const Camera camera = controls_.camera();
  const std::vector<Bones> poses = pose_crowd(stage_.hero, stage_.places, float(time_s_));
  scene_->set_poses(poses);
  scene_->set_camera(camera.eye_ws);
  platform::Stopwatch update_watch;
  scene_->update(controls_.terms());
  readings_.update_ms = update_watch.lap_ms();
  readings_.links = scene_->stats().links;
  readings_.culled_links = scene_->stats().links_culled;
  std::vector<DrawnInstance> drawn = drawn_crowd(*scene_, poses, lit_);
  if (controls_.debug.levels) colour_by_level(*scene_, drawn);
  int width = 0, height = 0;
  stage_.context.size(&width, &height);
  width = std::max(width, 1);
  height = std::max(height, 1);
  const ScreenAo screen_ao =
      controls_.screen_space ? draw_screen_space(drawn, camera, width, height) : ScreenAo{};
  stage_.context.framebuffer();
  gl.Viewport(0, 0, width, height);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  draw_crowd(drawn, camera, screen_ao);
  debug_.draw(stage_.renderer, {*scene_, poses, drawn, camera}, controls_.debug, false);
  gl.Disable(GL_FRAMEBUFFER_SRGB);  // ImGui's colours are encoded already
}

void Window::draw_controls() {
  readings_.tier = scene_->gl().info().tier;
  readings_.error_text = debug_.error_text();
  gui_.draw(controls_, readings_);
}

// Returns true once the picture that the options ask for is written.
bool Window::wrote_picture() {
  if (options_.window_picture.empty() || ++frames_ < kSettlingFrames) return false;
  if (bake_ || !debug_.is_complete()) return false;
  if (!options_.bake.empty() && file_.has_change()) return false;
  int width = 0, height = 0;
  stage_.context.size(&width, &height);
  stage_.context.framebuffer();
  platform::write_image(options_.window_picture, platform::read_pixels(stage_.context, width, height));
  return true;
}

void Window::run() {
  while (!stage_.context.should_close()) {
    follow_bake();
    follow_model();
    follow_settings();
    draw_frame();
    draw_controls();
    if (wrote_picture()) return;
    stage_.context.present();
  }
}

}  // namespace

void run_window(const WindowStage& stage, std::vector<unsigned char> model, const Options& options) {
  Window(stage, std::move(model), options).run();
}

}  // namespace crowd
