#include "samples/crowd/window_loop.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <glad/gl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "platform/stopwatch.h"
#include "samples/crowd/frames.h"
#include "samples/crowd/recorded_frames.h"

namespace crowd {
namespace {

struct Controls {
  bool ao = true, probe_light = true, self = true, neighbours = true, ground = true, screen_space = true,
       playing = true;
  bool record = false;   // the next frame of the screen-space pass
  std::string recorded;  // the name of the last file
  float intensity = 1.0f, key = 0.5f;
  int link_count = 4;
  int tier = 0;  // 33, 43, or 0 for the best
  float turn = 0, height = 0.35f, distance_m = 8;

  std::uint32_t terms() const {
    std::uint32_t bits = 0;
    if (self) bits |= NOOK_TERM_SELF;
    if (neighbours) bits |= NOOK_TERM_LINKS;
    if (ground) bits |= NOOK_TERM_GROUND;
    return bits;
  }
};

class Gui {
 public:
  explicit Gui(GLFWwindow* window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330");
  }
  ~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
  }
  void draw() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }
};

// Returns true if the user has changed the tier.
bool show_controls(Controls& c, const CrowdScene& scene, bool have_light, double update_ms) {
  ImGui::Begin("Nook");
  ImGui::Checkbox("ambient occlusion", &c.ao);
  ImGui::SliderFloat("intensity", &c.intensity, 0, 1);
  ImGui::Checkbox("self", &c.self);
  ImGui::SameLine();
  ImGui::Checkbox("neighbours", &c.neighbours);
  ImGui::SameLine();
  ImGui::Checkbox("ground", &c.ground);
  ImGui::Checkbox("AO on the floor", &c.screen_space);
  ImGui::SliderInt("nearest neighbours", &c.link_count, 0, 16);
  if (c.screen_space) {
    c.record = ImGui::Button("record a frame");
    if (!c.recorded.empty()) ImGui::TextUnformatted(c.recorded.c_str());
  }
  if (have_light) ImGui::Checkbox("light of a probe", &c.probe_light);
  if (!have_light || !c.probe_light) ImGui::SliderFloat("key light", &c.key, 0, 1);
  ImGui::Checkbox("play", &c.playing);
  const int tier = scene.gl().info().tier;
  ImGui::Text("OpenGL tier:");
  const int before = c.tier;
  for (const int choice : {33, 43}) {
    ImGui::SameLine();
    if (ImGui::RadioButton(choice == 33 ? "3.3" : "4.3", tier == choice)) c.tier = choice;
  }
  ImGui::Text("update %.2f ms, frame %.1f ms, %u links", update_ms, 1000 / double(ImGui::GetIO().Framerate),
              scene.stats().links);
  ImGui::End();
  const ImGuiIO& io = ImGui::GetIO();
  if (!io.WantCaptureMouse) {
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
      c.turn -= 0.005f * io.MouseDelta.x;
      c.height = std::clamp(c.height + 0.005f * io.MouseDelta.y, 0.02f, 1.5f);
    }
    c.distance_m = std::clamp(c.distance_m * std::pow(0.9f, io.MouseWheel), 1.5f, 200.0f);
  }
  return c.tier != before;
}

Camera camera_of(const Controls& c) {
  Camera camera;
  camera.eye_ws =
      camera.target_ws + c.distance_m * glm::vec3(std::sin(c.turn) * std::cos(c.height), std::sin(c.height),
                                                  std::cos(c.turn) * std::cos(c.height));
  return camera;
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

}  // namespace

void run_window(platform::Context& context, const Hero& hero, std::span<const unsigned char> model,
                const std::vector<Placement>& places, Renderer& renderer, const Light* light,
                const Options& options) {
  const GladGLContext& gl = context.gl();
  Gui gui(context.window());
  Controls controls;
  controls.link_count = int(options.neighbours);
  controls.tier = options.tier;
  controls.screen_space = options.screen_space;
  const SplitLight parts = light ? light->split() : SplitLight{};
  const float radius_m = crowd_radius_m(places);
  controls.distance_m = radius_m + 4;
  const std::filesystem::path record_folder = options.record.empty() ? options.out : options.record;
  std::unique_ptr<CrowdScene> scene;
  std::unique_ptr<ScreenSpaceAo> screen_space;
  bool tier_changed = true;
  int linked = -1;
  bool lit = false;
  double time_s = 0, update_ms = 0;
  platform::Stopwatch frame_watch;
  while (!context.should_close()) {
    if (tier_changed) {
      screen_space.reset();
      scene.reset();
      const CrowdSceneRequest request{std::uint32_t(places.size()), std::uint32_t(controls.link_count),
                                      controls.tier, NOOK_COMBINE_COMPOSED};
      scene = std::make_unique<CrowdScene>(context, model, request);
      linked = controls.link_count;
      lit = false;
    }
    if (const bool want = light && controls.probe_light; want != lit) {
      scene->set_light(want ? std::span(light->lobes()) : std::span<const nook_probe_lobe>());
      lit = want;
    }
    if (linked != controls.link_count) scene->link_nearest(std::uint32_t(linked = controls.link_count));
    const double frame_ms = frame_watch.lap_ms();
    if (controls.playing) time_s += frame_ms / 1000;
    const std::vector<Bones> poses = pose_crowd(hero, places, float(time_s));
    scene->set_poses(poses);
    platform::Stopwatch update_watch;
    scene->update(controls.terms());
    update_ms = update_watch.lap_ms();
    const std::vector<DrawnInstance> drawn = drawn_crowd(*scene, poses, lit);
    Look look;
    look.ao_strength = controls.ao ? controls.intensity : 0;
    look.key_strength = controls.key;
    look.fog_start_m = 1.2f * radius_m + 8;
    int width = 0, height = 0;
    context.size(&width, &height);
    width = std::max(width, 1);
    height = std::max(height, 1);
    const Camera camera = camera_of(controls);
    if (controls.screen_space) {
      if (!screen_space || screen_space->width_px() != width || screen_space->height_px() != height) {
        screen_space.reset();  // frees its memory before the next one takes its own
        screen_space = std::make_unique<ScreenSpaceAo>(context, scene->gl(), width, height);
      }
      look.screen_ao = screen_space->draw(renderer, drawn, camera, scene->handle(), lit ? &parts : nullptr);
      if (controls.record) controls.recorded = record_frame(*screen_space, record_folder);
      controls.record = false;
    }
    context.framebuffer();
    gl.Viewport(0, 0, width, height);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    if (lit) {
      ProbeLight probe = probe_light(*scene, *light, camera);
      probe.ao_strength = look.ao_strength;
      probe.fog_start_m = look.fog_start_m;
      probe.screen_ao = look.screen_ao;
      renderer.draw_probe_light(drawn, camera, probe);
    } else {
      renderer.draw(drawn, camera, look, glm::vec3(0), radius_m + 1);
    }
    gl.Disable(GL_FRAMEBUFFER_SRGB);  // ImGui's colours are encoded already
    gui.begin();
    tier_changed = show_controls(controls, *scene, light != nullptr, update_ms);
    gui.draw();
    context.present();
  }
}

}  // namespace crowd
