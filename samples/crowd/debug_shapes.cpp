#include "samples/crowd/debug_shapes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crowd {
namespace {

constexpr float kPointRadius_m = 0.009f, kNormalLength_m = 0.05f, kNormalWidth_px = 1.5f;
constexpr float kCasterWidth_px = 7, kReceiverWidth_px = 1;
constexpr glm::vec3 kLinkColour(0.90f, 0.35f, 0.02f);

glm::vec3 vec(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

glm::vec3 linear(const glm::vec3& srgb) {
  return glm::pow(srgb, glm::vec3(2.2f));
}

// Hues a golden angle apart, so that neighbouring bones differ.
glm::vec3 bone_colour(std::uint32_t bone) {
  const float hue = 6 * std::fmod(0.618034f * float(bone), 1.0f);
  const glm::vec3 full = glm::clamp(glm::abs(glm::mod(glm::vec3(hue, hue + 4, hue + 2), 6.0f) - 3.0f) - 1.0f,
                                    glm::vec3(0), glm::vec3(1));
  return linear(0.30f + 0.62f * full);
}

void add_spheres(const CrowdScene& scene, std::uint32_t character, std::vector<Ball>& out) {
  for (const nook_scene_sphere& s : scene.spheres(character))
    out.push_back({vec(s.centre_ws), s.radius, bone_colour(s.bone)});
}

// Points that face away are left out: they lie on the far side of the body.
void add_key_points(const CrowdScene& scene, std::uint32_t character, const glm::vec3& eye_ws,
                    DebugShapes& out) {
  for (const nook_scene_key_point& p : scene.key_points(character)) {
    const glm::vec3 at = vec(p.position_ws), normal = vec(p.normal_ws), colour = shadow_colour(p.shadow);
    if (glm::dot(eye_ws - at, normal) <= 0) continue;
    out.key_points.push_back({at, kPointRadius_m, colour});
    out.normals.push_back({at, kNormalWidth_px, at + kNormalLength_m * normal, kNormalWidth_px, colour});
  }
}

void add_links(const CrowdScene& scene, std::vector<Line>& out) {
  for (std::uint32_t receiver = 0; receiver < scene.size(); ++receiver)
    for (const std::uint32_t caster : scene.links(receiver))
      out.push_back({scene.centre_ws(caster), kCasterWidth_px, scene.centre_ws(receiver), kReceiverWidth_px,
                     kLinkColour});
}

}  // namespace

std::vector<std::uint32_t> nearest_characters(const CrowdScene& scene, const glm::vec3& to_ws,
                                              std::uint32_t count) {
  std::vector<std::uint32_t> characters(scene.size());
  std::iota(characters.begin(), characters.end(), 0u);
  std::vector<float> distance_m;
  for (const std::uint32_t c : characters) distance_m.push_back(glm::distance(scene.centre_ws(c), to_ws));
  std::sort(characters.begin(), characters.end(),
            [&](std::uint32_t a, std::uint32_t b) { return distance_m[a] < distance_m[b]; });
  characters.resize(std::min<std::size_t>(characters.size(), count));
  return characters;
}

DebugShapes debug_shapes(const CrowdScene& scene, const DebugView& view, const glm::vec3& eye_ws) {
  DebugShapes shapes;
  for (const std::uint32_t character : nearest_characters(scene, eye_ws, view.bodies)) {
    if (view.spheres) add_spheres(scene, character, shapes.spheres);
    if (view.key_points) add_key_points(scene, character, eye_ws, shapes);
  }
  if (view.links) add_links(scene, shapes.links);
  return shapes;
}

// Sky blue, bluish green, yellow, orange and vermilion of Okabe and Ito, whom colour-blind readers can
// follow.
glm::vec3 level_colour(std::uint32_t level) {
  static const glm::vec3 colours[] = {{0.34f, 0.71f, 0.91f},
                                      {0.00f, 0.62f, 0.45f},
                                      {0.94f, 0.89f, 0.26f},
                                      {0.90f, 0.62f, 0.00f},
                                      {0.84f, 0.37f, 0.00f}};
  return linear(colours[std::min<std::size_t>(level, std::size(colours) - 1)]);
}

// The ends and the middle of the map cividis.
glm::vec3 shadow_colour(float shadow) {
  const glm::vec3 dark(0.00f, 0.14f, 0.31f), grey(0.49f, 0.48f, 0.47f), yellow(0.99f, 0.91f, 0.22f);
  const float t = std::clamp(shadow / kFullShadow, 0.0f, 1.0f);
  return linear(t < 0.5f ? glm::mix(dark, grey, 2 * t) : glm::mix(grey, yellow, 2 * t - 1));
}

}  // namespace crowd
