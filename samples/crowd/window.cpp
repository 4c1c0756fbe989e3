#include "samples/crowd/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
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

// ImGui needs a few frames to find the sizes of its panels, and to react to input.
constexpr int frames_before_picture = 4;
// While nothing moves, a low frame rate is enough for a blinking cursor, and to notice a changed model file.
constexpr double still_frame_s = 0.25;

struct Controls {
  bool ao = true, self = true, neighbours = true, ground = true, floor = true, playing = true;
  float intensity = 1, turn = 0, height = 0.35f, distance_m = 8;
  int link_count = 4;
  DebugView debug;
  std::string model_text;  // what happened when the model's file was last loaded

  std::uint32_t terms() const {
    return std::uint32_t(self * NOOK_TERM_SELF | neighbours * NOOK_TERM_LINKS | ground * NOOK_TERM_GROUND);
  }
  Camera camera() const {
    Camera camera;
    const glm::vec3 away(std::sin(turn) * std::cos(height), std::sin(height),
                         std::cos(turn) * std::cos(height));
    camera.eye_ws = camera.target_ws + distance_m * away;
    return camera;
  }
};

// Numbers that are typed into a slider are also clamped.
void show_controls(Controls& c, const nook_scene_info& info, float width) {
  constexpr ImGuiSliderFlags clamped = ImGuiSliderFlags_AlwaysClamp;
  // A row of boxes wraps if the panel is too narrow.
  const auto boxes = [=](std::initializer_list<std::pair<const char*, bool*>> row) {
    for (const auto& [name, on] : row) {
      const float needed = ImGui::CalcTextSize(name).x + 3 * ImGui::GetFontSize();
      const bool fits = ImGui::GetItemRectMax().x + needed < ImGui::GetWindowPos().x + width;
      if (name != row.begin()->first && fits) ImGui::SameLine();
      ImGui::Checkbox(name, on);
    }
  };
  boxes({{"ambient occlusion", &c.ao}, {"AO on the floor", &c.floor}});
  boxes({{"self", &c.self}, {"neighbours", &c.neighbours}, {"ground", &c.ground}});
  ImGui::SliderFloat("intensity", &c.intensity, 0, 1, "%.3f", clamped);
  ImGui::SliderInt("nearest neighbours", &c.link_count, 0, 16, "%d", clamped);
  ImGui::SliderInt("bodies", &c.debug.bodies, 1, 16, "%d", clamped);
  boxes({{"spheres", &c.debug.spheres}, {"links", &c.debug.links}, {"play", &c.playing}});
  ImGui::Text("%u links, %u culled, frame %.1f ms", info.links, info.links_culled,
              1000 / double(ImGui::GetIO().Framerate));
  ImGui::TextWrapped("Camera: A, D, W, S, Q, E. Controls: arrows, space, Tab.");
  if (!c.model_text.empty()) ImGui::TextWrapped("%s", c.model_text.c_str());
}

// The panel is as wide as the window allows, and moves back inside when the window becomes smaller.
void show_panel(Controls& c, const nook_scene_info& info) {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  const float line = ImGui::GetFontSize();
  ImGui::SetNextWindowPos(ImVec2(line, line), ImGuiCond_FirstUseEver);
  ImGui::Begin("Nook", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  if (!ImGui::IsWindowFocused()) ImGui::SetWindowFocus();  // keys reach the panel after a click beside it
  // The name next to a slider is up to 10 line heights wide.
  const float width = std::clamp(room.x - 3 * line, 13 * line, 23 * line);
  ImGui::PushItemWidth(width - 11 * line);
  ImGui::PushTextWrapPos(width);
  show_controls(c, info, width);
  ImGui::PopTextWrapPos();
  ImGui::PopItemWidth();
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  ImGui::SetWindowPos(ImVec2(std::clamp(at.x, 0.0f, std::max(room.x - size.x, 0.0f)),
                             std::clamp(at.y, 0.0f, std::max(room.y - size.y, 0.0f))));
  ImGui::End();
}

void move_camera(Controls& c, GLFWwindow* window) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool over_panel = io.WantCaptureMouse, drags = !over_panel && ImGui::IsMouseDragging(0);
  const auto held = [&](int key) { return !io.WantTextInput && glfwGetKey(window, key) == GLFW_PRESS; };
  // In a slow frame, a key moves the camera by at most a tenth of a second's distance.
  const float step = std::min(io.DeltaTime, 0.1f);
  const float turn = step * float(held(GLFW_KEY_D) - held(GLFW_KEY_A)),
              rise = step * float(held(GLFW_KEY_W) - held(GLFW_KEY_S)),
              nearer =
                  8 * step * float(held(GLFW_KEY_E) - held(GLFW_KEY_Q)) + (over_panel ? 0 : io.MouseWheel);
  c.turn += 1.5f * turn - (drags ? 0.005f * io.MouseDelta.x : 0);
  c.height = std::clamp(c.height + 1.5f * rise + (drags ? 0.005f * io.MouseDelta.y : 0), 0.02f, 1.5f);
  c.distance_m = std::clamp(c.distance_m * std::pow(0.9f, nearer), 1.5f, 200.0f);
}

bool has_input(const Controls& before, const Controls& after) {
  const ImGuiIO& io = ImGui::GetIO();
  return before.turn != after.turn || before.height != after.height ||
         before.distance_m != after.distance_m || io.MouseDelta.x != 0 || io.MouseDelta.y != 0 ||
         ImGui::IsAnyItemActive();
}

// Loads the model again. If the file does not fit the character, the old model stays.
std::string load_again(CrowdScene& scene, const std::filesystem::path& model) {
  try {
    scene.set_model(platform::read_file(model));
    return "loaded " + model.filename().string() + " again";
  } catch (const std::exception& failure) {
    return std::string("kept the old model: ") + failure.what();
  }
}

class Window {
 public:
  Window(platform::Context& context, const Hero& hero, CrowdScene& scene, const Light& light)
      : context_(context), scene_(scene), light_(light), renderer_(context.gl(), hero) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    // Keys that are pressed and released between two frames are not lost.
    glfwSetInputMode(context.window(), GLFW_STICKY_KEYS, GLFW_TRUE);
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
    width = std::max(width, 1), height = std::max(height, 1);
    const nook_gl_view view = scene_.light();
    Look look{light_, view.texture, view.glsl, c.ao ? c.intensity : 0, fog_start_m, {}};
    if (c.floor) look.screen_ao = draw_passes(drawn, camera, width, height);
    context_.framebuffer();
    gl.Viewport(0, 0, width, height);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    renderer_.draw(drawn, camera, look);
    gl.Disable(GL_FRAMEBUFFER_SRGB);  // ImGui's colours are encoded already
    scale_panel();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    draw_debug_lines(scene_, camera, c.debug);
    show_panel(c, scene_.scene().info());
    move_camera(c, context_.window());
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
  // Follows the scale of the display that the window is on. ImGui's sizes are for a scale of 1.
  void scale_panel() {
    float scale = 1;
    glfwGetWindowContentScale(context_.window(), &scale, nullptr);
    // If a unit of the window is more than a pixel, ImGui scales on its own. While the window is resized, the
    // two sizes may come from different frames. Then their quotient is wrong.
    const float unit_px = ImGui::GetIO().DisplayFramebufferScale.x;
    if (!(unit_px > 0)) return;
    scale = std::clamp(scale / unit_px, 1.0f, 8.0f);
    if (scale == scale_) return;
    scale_ = scale;
    ImFontConfig font;
    font.SizePixels = std::floor(13 * scale);
    ImGui::GetIO().Fonts->Clear();
    ImGui::GetIO().Fonts->AddFontDefault(&font);
    ImGui::GetStyle() = ImGuiStyle();
    ImGui::GetStyle().ScaleAllSizes(scale);
    ImGui_ImplOpenGL3_DestroyDeviceObjects();  // the next frame makes the font's texture
  }

  ScreenAo draw_passes(const std::vector<DrawnInstance>& drawn, const Camera& camera, int width, int height) {
    if (!passes_ || passes_->width_px != width || passes_->height_px != height)
      passes_.emplace(context_, scene_.gl(), width, height);
    return passes_->draw(renderer_, drawn, camera, scene_.scene().get(), &light_);
  }

  platform::Context& context_;
  CrowdScene& scene_;
  const Light& light_;
  Renderer renderer_;
  std::optional<ScreenPasses> passes_;  // as large as the window
  float scale_ = 0;
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
  const auto shows = [&](const char* name) {
    return std::ranges::find(request.debug, name) != request.debug.end();
  };
  c.debug = {shows("spheres"), shows("links"), request.bodies};
  c.distance_m = radius_m + 4;
  int links = c.link_count;
  float time_s = 0;
  platform::Stopwatch watch;
  int moving_frames = frames_before_picture;  // frames that are still drawn without a pause
  for (int frame = 1; !context.should_close(); ++frame) {
    const auto now_written = std::filesystem::last_write_time(request.model, absent);
    if (now_written != written) c.model_text = load_again(scene, request.model);
    written = now_written;
    if (c.link_count != links) scene.link_nearest(std::uint32_t(links = c.link_count));
    const float passed_s = float(watch.lap_seconds());
    if (c.playing) time_s += passed_s;
    const Controls before = c;
    window.draw(pose_crowd(hero, places, time_s), c, 1.2f * radius_m + 8);
    moving_frames =
        c.playing || has_input(before, c) ? frames_before_picture : std::max(moving_frames - 1, 0);
    if (frame == frames_before_picture && !request.picture.empty())
      return window.write_picture(request.picture);
    context.present(moving_frames > 0 ? 0 : still_frame_s);
  }
}

}  // namespace crowd
