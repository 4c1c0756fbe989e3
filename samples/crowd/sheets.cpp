#include "samples/crowd/sheets.h"

#include <glad/gl.h>

#include <algorithm>
#include <cmath>

#include "samples/crowd/label.h"

namespace crowd {
namespace {

constexpr float kGroupDistance_m = 4.6f;  // from the camera to the group
constexpr int kBearings = 24;
constexpr float kReach_m = 1.2f;  // from a root to fingers and toes

// How much stands between a camera at this bearing and the group.
float obstruction(const std::vector<Placement>& places, const Placement& focus, float bearing_rad) {
  const float s = std::sin(bearing_rad), c = std::cos(bearing_rad);
  float sum = 0;
  for (const Placement& p : places) {
    const float dx = p.x_m - focus.x_m, dz = p.z_m - focus.z_m;
    const float ahead_m = dx * s + dz * c, aside_m = std::abs(dx * c - dz * s);
    if (ahead_m > 0.8f && ahead_m < kGroupDistance_m + 1.0f && aside_m < 1.1f) sum += 1.0f + ahead_m;
  }
  return sum;
}

}  // namespace

Group choose_group(const std::vector<Placement>& places, std::size_t count) {
  const Placement& focus = places[busiest(places, 1.0f)];
  float best = 0, best_obstruction = INFINITY;
  for (int k = 0; k < kBearings; ++k) {
    const float bearing = 6.2831853f * float(k) / kBearings;
    const float found = obstruction(places, focus, bearing);
    if (found < best_obstruction) {
      best = bearing;
      best_obstruction = found;
    }
  }
  Group group;
  group.camera.target_ws = {focus.x_m, 0.82f, focus.z_m};
  group.camera.eye_ws =
      group.camera.target_ws + kGroupDistance_m * glm::vec3(std::sin(best), 0.28f, std::cos(best));
  group.camera.fov_rad = 0.5f;
  group.members = nearest_to(places, focus.x_m, focus.z_m, count);
  // Bodies right before the lens would hide the group; their shadow stays.
  std::erase_if(group.members, [&](std::uint32_t i) {
    return std::hypot(places[i].x_m - group.camera.eye_ws.x, places[i].z_m - group.camera.eye_ws.z) <
           0.6f * kGroupDistance_m;
  });
  return group;
}

FloorPatch floor_under(const Group& group, const std::vector<Placement>& places, float margin_m,
                       std::uint32_t side) {
  glm::vec2 low(INFINITY), high(-INFINITY);
  for (const std::uint32_t member : group.members) {
    const glm::vec2 at(places[member].x_m, places[member].z_m);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const float reach_m = margin_m + kReach_m;
  const float size_m = std::max(high.x - low.x, high.y - low.y) + 2 * reach_m;
  return {low.x - reach_m, low.y - reach_m, size_m, side};
}

FloorAo SheetPainter::upload(const FloorPatch& patch, const std::vector<float>& values,
                             std::uint32_t channels) const {
  const GladGLContext& gl = stage_.context.gl();
  FloorAo floor;
  // Texel centres lie on the patch's points: the texture is wider by half a texel on each side.
  const float texel_m = patch.size_m / float(patch.side - 1);
  floor.first_m = glm::vec2(patch.low_x_m, patch.low_z_m) - 0.5f * texel_m;
  floor.extent_m = glm::vec2(patch.size_m + texel_m);
  gl.GenTextures(1, &floor.texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, floor.texture);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  gl.TexImage2D(GL_TEXTURE_2D, 0, channels == 3 ? GL_RGB32F : GL_R16F, GLsizei(patch.side),
                GLsizei(patch.side), 0, channels == 3 ? GL_RGB : GL_RED, GL_FLOAT, values.data());
  return floor;
}

GLuint SheetPainter::upload(const std::vector<std::vector<float>>& values, std::uint32_t channels,
                            std::vector<AoSource>& sources) const {
  const GladGLContext& gl = stage_.context.gl();
  sources.assign(group_.members.size(), AoSource{});
  if (values.empty()) return 0;
  const std::uint32_t stride = channels * std::uint32_t(sizeof(float));
  GLuint buffer = 0;
  gl.GenBuffers(1, &buffer);
  std::vector<float> all;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    sources[i] = {buffer, all.size() * sizeof(float), stride};
    all.insert(all.end(), values[i].begin(), values[i].end());
  }
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  gl.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(all.size() * sizeof(float)), all.data(), GL_STREAM_DRAW);
  return buffer;
}

void SheetPainter::add(const std::string& label, const std::vector<std::vector<float>>& ao,
                       const FloorPatch& patch, const std::vector<float>& floor_ao) {
  floor_ = upload(patch, floor_ao, 1);
  add(label, ao);
  stage_.context.gl().DeleteTextures(1, &floor_.texture);
  floor_ = {};
}

void SheetPainter::add(const std::string& label, const std::vector<std::vector<float>>& ao) {
  std::vector<AoSource> sources;
  const GLuint buffer = upload(ao, 1, sources);
  add_panel(label, sources, ScreenSpace::kOff);
  stage_.context.gl().DeleteBuffers(1, &buffer);
}

void SheetPainter::add_lit(const std::string& label, const std::vector<std::vector<float>>& irradiance,
                           const LitFloor& floor) {
  std::vector<AoSource> sources;
  const GLuint buffer = upload(irradiance, 3, sources);
  GivenLight light;
  light.exposure = floor.exposure;
  light.floor = upload(floor.patch, floor.irradiance, 3);
  std::vector<DrawnInstance> drawn;
  for (std::size_t i = 0; i < sources.size(); ++i)
    drawn.push_back({&poses_[group_.members[i]], {}, glm::vec3(0.72f), sources[i], 0});
  stage_.target.bind();
  stage_.renderer.draw_given_light(drawn, group_.camera, light);
  panels_.push_back(stage_.target.read());
  draw_label(panels_.back(), label);
  stage_.context.gl().DeleteTextures(1, &light.floor.texture);
  stage_.context.gl().DeleteBuffers(1, &buffer);
}

std::vector<AoSource> SheetPainter::sources_of(const CrowdScene& scene) const {
  std::vector<AoSource> sources;
  for (const std::uint32_t member : group_.members) sources.push_back(scene.ao(member));
  return sources;
}

void SheetPainter::add(const std::string& label, const CrowdScene& scene) {
  add_panel(label, sources_of(scene), ScreenSpace::kOff);
}

void SheetPainter::add_with_screen_space(const std::string& label, const CrowdScene& scene) {
  add_panel(label, sources_of(scene), ScreenSpace::kBesideCharacters);
}

void SheetPainter::add_screen_space_alone(const std::string& label) {
  add_panel(label, std::vector<AoSource>(group_.members.size()), ScreenSpace::kAlone);
}

void SheetPainter::add_panel(const std::string& label, std::span<const AoSource> sources,
                             ScreenSpace screen_space) {
  Look look;
  look.key_strength = 0.16f;  // mostly ambient light, in which AO is what there is to see
  look.ground_albedo = glm::vec3(0.5f);
  look.background = glm::vec3(0.62f);
  look.fog_start_m = 14;
  look.floor_ao = floor_;
  std::vector<DrawnInstance> drawn;
  for (std::size_t i = 0; i < sources.size(); ++i)
    drawn.push_back({&poses_[group_.members[i]], sources[i], glm::vec3(0.72f), {}, 0});
  if (screen_space != ScreenSpace::kOff)
    look.screen_ao = stage_.screen_space->draw(
        stage_.renderer, drawn, group_.camera,
        screen_space == ScreenSpace::kAlone ? NOOK_NNAO_LAYER_NONE : NOOK_NNAO_LAYER_REPLACE);
  stage_.target.bind();
  stage_.renderer.draw(drawn, group_.camera, look, group_.camera.target_ws, 6.0f);
  panels_.push_back(stage_.target.read());
  draw_label(panels_.back(), label);
}

void SheetPainter::write(const std::filesystem::path& path, int columns) const {
  platform::write_image(path, tile(panels_, columns));
}

}  // namespace crowd
