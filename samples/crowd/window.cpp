#include "samples/crowd/window.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "platform/file_bytes.h"
#include "platform/stopwatch.h"
#include "samples/crowd/debug_lines.h"
#include "samples/crowd/screen_passes.h"

namespace crowd {
namespace {

// ImGui finds the sizes of its panels in the first few frames.
constexpr int frames_before_picture = 4;

struct Controls {
  bool ao = true, self = true, neighbours = true, ground = true, floor = true, playing = true;
  float intensity = 1, turn = 0, height = 0.35f, distance_m = 8;
  int link_count = 4;
  DebugView debug;
  std::string model_text;  // what happened to the model's file last

  std::uint32_t terms() const {
    std::uint32_t terms = 0;
    if (self) terms |= NOOK_TERM_SELF;
    if (neighbours) terms |= NOOK_TERM_LINKS;
    if (ground) terms |= NOOK_TERM_GROUND;
    return terms;
  }
  Camera camera() const {
    Camera camera;
    const glm::vec3 away(std::sin(turn) * std::cos(height), std::sin(height),
                         std::cos(turn) * std::cos(height));
    camera.eye_ws = camera.target_ws + distance_m * away;
    return camera;
  }
};

void show(Controls& c, const nook_scene_info& info) {
  ImGui::SetNextWindowPos(ImVec2(12, 12), ImGuiCond_FirstUseEver);
  ImGui::Begin("Nook", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::Checkbox("ambient occlusion", &c.ao);
  ImGui::SliderFloat("intensity", &c.intensity, 0, 1);
  ImGui::Checkbox("self", &c.self);
  ImGui::SameLine();
  ImGui::Checkbox("neighbours", &c.neighbours);
  ImGui::SameLine();
  ImGui::Checkbox("ground", &c.ground);
  ImGui::Checkbox("AO on the floor", &c.floor);
  ImGui::SliderInt("nearest neighbours", &c.link_count, 0, 16);
  ImGui::Checkbox("play", &c.playing);
  ImGui::Separator();
  ImGui::Checkbox("spheres", &c.debug.spheres);
  ImGui::SameLine();
  ImGui::Checkbox("links", &c.debug.links);
  ImGui::SliderInt("bodies", &c.debug.bodies, 1, 16);
  ImGui::Text("%u links, %u culled, frame %.1f ms", info.links, info.links_culled,
              1000 / double(ImGui::GetIO().Framerate));
  if (!c.model_text.empty()) ImGui::TextUnformatted(c.model_text.c_str());
  ImGui::End();
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantCaptureMouse) return;
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
    c.turn -= 0.005f * io.MouseDelta.x;
    c.height = std::clamp(c.height + 0.005f * io.MouseDelta.y, 0.02f, 1.5f);
  }
  c.distance_m = std::clamp(c.distance_m * std::pow(0.9f, io.MouseWheel), 1.5f, 200.0f);
}

// Loads the model again. A file that does not fit leaves the model from before.
std::string load_again(CrowdScene& scene, const std::filesystem::path& model) {
  try {
    scene.set_model(platform::read_file(model));
    return "loaded " + model.filename().string() + " again";
  } catch (const std::exception& failure) {
    return std::string("kept the model from before: ") + failure.what();
  }
}

class Window {
 public:
  Window(platform::Context& context, const Hero& hero, CrowdScene& scene, const Light& light)
      : context_(context), scene_(scene), light_(light), renderer_(context.gl(), hero), lines_(context.gl()) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(context.window(), true);
    ImGui_ImplOpenGL3_Init("#version 330");
  }
  ~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }

  void draw(const std::vector<Bones>& poses, Controls& c, float fog_start_m) {
    const GladGLContext& gl = context_.gl();
    const Camera camera = c.camera();
    scene_.set_poses(poses);
    scene_.set_camera(camera.eye_ws);
    scene_.update(c.terms());
    const std::vector<DrawnInstance> drawn = scene_.drawn(poses);
    int width = 1, height = 1;
    context_.size(&width, &height);
    width = std::max(width, 1);
    height = std::max(height, 1);
    const nook_gl_view view = scene_.light();
    Look look{light_, view.texture, view.glsl, c.ao ? c.intensity : 0, fog_start_m, {}};
    if (c.floor) look.screen_ao = draw_passes(drawn, camera, width, height);
    context_.framebuffer();
    gl.Viewport(0, 0, width, height);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    renderer_.draw(drawn, camera, look);
    lines_.draw(scene_, camera, float(width) / float(height), c.debug);
    gl.Disable(GL_FRAMEBUFFER_SRGB);  // ImGui's colours are encoded already
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    show(c, scene_.scene().info());
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }

  void write_picture(const std::filesystem::path& path) const {
    int width = 0, height = 0;
    context_.size(&width, &height);
    context_.framebuffer();
    platform::write_image(path, platform::read_pixels(context_, width, height));
  }

 private:
  ScreenAo draw_passes(const std::vector<DrawnInstance>& drawn, const Camera& camera, int width, int height) {
    if (!passes_ || passes_->width_px != width || passes_->height_px != height)
      passes_.emplace(context_, scene_.gl(), width, height);
    return passes_->draw(renderer_, drawn, camera, scene_.scene().get(), &light_);
  }

  platform::Context& context_;
  CrowdScene& scene_;
  const Light& light_;
  Renderer renderer_;
  DebugLines lines_;
  std::optional<ScreenPasses> passes_;  // of the window's size
};

}  // namespace

void run_window(platform::Context& context, const Hero& hero, const std::vector<Placement>& places,
                CrowdScene& scene, const Light& light, const WindowRequest& request) {
  Window window(context, hero, scene, light);
  std::error_code absent;
  auto written = std::filesystem::last_write_time(request.model, absent);
  const float radius_m = crowd_radius_m(places);
  Controls c;
  c.link_count = request.link_count;
  c.debug = {request.spheres, request.links, request.bodies};
  c.distance_m = radius_m + 4;
  int links = c.link_count;
  float time_s = 0;
  platform::Stopwatch watch;
  for (int frame = 1; !context.should_close(); ++frame) {
    const auto now_written = std::filesystem::last_write_time(request.model, absent);
    if (now_written != written) c.model_text = load_again(scene, request.model);
    written = now_written;
    if (c.link_count != links) scene.link_nearest(std::uint32_t(links = c.link_count));
    const float passed_s = float(watch.lap_seconds());
    if (c.playing) time_s += passed_s;
    window.draw(pose_crowd(hero, places, time_s), c, 1.2f * radius_m + 8);
    if (frame == frames_before_picture && !request.picture.empty())
      return window.write_picture(request.picture);
    context.present();
  }
}

}  // namespace crowd
