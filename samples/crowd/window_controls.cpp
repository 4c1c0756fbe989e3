#include "samples/crowd/window_controls.h"
#include <nook/experimental/nook_debug.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace crowd {
namespace {

void show_occlusion(Controls& c, const Readings& r) {
  ImGui::Checkbox("ambient occlusion", &c.ao);
  ImGui::SliderFloat("intensity", &c.intensity, 0, 1);
  ImGui::Checkbox("self", &c.self);
  ImGui::SameLine();
  ImGui::Checkbox("neighbours", &c.neighbours);
  ImGui::SameLine();
  ImGui::Checkbox("ground", &c.ground);
  ImGui::Checkbox("AO on the floor", &c.screen_space);
  ImGui::SliderInt("nearest neighbours", &c.link_count, 0, 16);
  ImGui::SliderFloat("error of levels", &c.lod_error, 0, 0.1f);
  if (c.screen_space) {
    c.record = ImGui::Button("record a frame");
    if (!r.recorded.empty()) ImGui::TextUnformatted(r.recorded.c_str());
  }
  if (r.have_light) ImGui::Checkbox("light of a probe", &c.probe_light);
  if (!r.have_light || !c.probe_light) ImGui::SliderFloat("key light", &c.key, 0, 1);
  ImGui::Checkbox("play", &c.playing);
  ImGui::Text("OpenGL tier:");
  for (const int choice : {33, 43}) {
    ImGui::SameLine();
    if (ImGui::RadioButton(choice == 33 ? "3.3" : "4.3", r.tier == choice)) c.tier = choice;
  }
  ImGui::Text("update %.2f ms, frame %.1f ms", r.update_ms, 1000 / double(ImGui::GetIO().Framerate));
  ImGui::Text("%u links, %u culled", r.links, r.culled_links);
}

void show_debug_views(Controls& c, const Readings& r) {
  ImGui::Checkbox("spheres", &c.debug.spheres);
  ImGui::SameLine();
  ImGui::Checkbox("key points", &c.debug.key_points);
  ImGui::SameLine();
  ImGui::Checkbox("links", &c.debug.links);
  ImGui::Checkbox("levels", &c.debug.levels);
  ImGui::SameLine();
  // Bodies have to stand still while they are traced.
  if (ImGui::Checkbox("error", &c.debug.error) && c.debug.error) c.playing = false;
  int bodies = int(c.debug.bodies);
  if (ImGui::SliderInt("bodies", &bodies, 1, int(std::max(1u, std::min(r.characters, 16u)))))
    c.debug.bodies = std::uint32_t(bodies);
  if (!r.error_text.empty()) {
    ImGui::TextUnformatted(r.error_text.c_str());
    ImGui::TextUnformatted("blue: too bright, red: too dark, ends at 0.25");
  }
}

void show_model(Controls& c, const Readings& r) {
  ImGui::TextUnformatted(r.model_name.c_str());
  if (r.bake) {
    const float share = r.bake->total > 0 ? float(r.bake->done) / float(r.bake->total) : 0;
    ImGui::ProgressBar(share, ImVec2(-1, 0), r.bake->stage);
    c.cancel = ImGui::Button("cancel");
  } else {
    c.bake = ImGui::Button("bake");
    ImGui::SameLine();
    ImGui::Combo("preset", &c.preset, "draft\0standard\0production\0");
  }
  if (!r.model_text.empty()) ImGui::TextUnformatted(r.model_text.c_str());
}

void move_camera(Controls& c) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantCaptureMouse) return;
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
    c.turn -= 0.005f * io.MouseDelta.x;
    c.height = std::clamp(c.height + 0.005f * io.MouseDelta.y, 0.02f, 1.5f);
  }
  c.distance_m = std::clamp(c.distance_m * std::pow(0.9f, io.MouseWheel), 1.5f, 200.0f);
}

}  // namespace

std::uint32_t Controls::terms() const {
  std::uint32_t bits = 0;
  if (self) bits |= NOOK_TERM_SELF;
  if (neighbours) bits |= NOOK_TERM_LINKS;
  if (ground) bits |= NOOK_TERM_GROUND;
  return bits;
}

Camera Controls::camera() const {
  Camera camera;
  camera.eye_ws =
      camera.target_ws + distance_m * glm::vec3(std::sin(turn) * std::cos(height), std::sin(height),
                                                std::cos(turn) * std::cos(height));
  return camera;
}

Gui::Gui(GLFWwindow* window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::draw(Controls& controls, const Readings& readings) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  controls.record = controls.bake = controls.cancel = false;
  ImGui::SetNextWindowPos(ImVec2(12, 12), ImGuiCond_FirstUseEver);
  ImGui::Begin("Nook", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::CollapsingHeader("Occlusion", ImGuiTreeNodeFlags_DefaultOpen))
    show_occlusion(controls, readings);
  if (ImGui::CollapsingHeader("Debug views", ImGuiTreeNodeFlags_DefaultOpen))
    show_debug_views(controls, readings);
  if (ImGui::CollapsingHeader("Model", ImGuiTreeNodeFlags_DefaultOpen)) show_model(controls, readings);
  ImGui::End();
  move_camera(controls);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace crowd
