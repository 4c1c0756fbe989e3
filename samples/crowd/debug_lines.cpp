#include "samples/crowd/debug_lines.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace crowd {
namespace {

struct Lines {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  const glm::mat4 clip_from_ws;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();

  explicit Lines(const Camera& camera) : clip_from_ws(clip_from_world(camera, room.x / room.y)) {}

  void add(const glm::vec3& a_ws, const glm::vec3& b_ws, ImU32 colour) {
    glm::vec4 a = clip_from_ws * glm::vec4(a_ws, 1), b = clip_from_ws * glm::vec4(b_ws, 1);
    constexpr float nearest = 0.1f;
    if (std::max(a.w, b.w) <= nearest) return;
    // If one end is behind the camera, clip the line at the near plane.
    if (a.w < nearest) a = glm::mix(b, a, (b.w - nearest) / (b.w - a.w));
    if (b.w < nearest) b = glm::mix(a, b, (a.w - nearest) / (a.w - b.w));
    const auto pixel = [&](const glm::vec4& at) {
      return ImVec2((0.5f + 0.5f * at.x / at.w) * room.x, (0.5f - 0.5f * at.y / at.w) * room.y);
    };
    list.AddLine(pixel(a), pixel(b), colour);
  }

  // Three circles, in hues a golden angle apart, so that neighbouring bones differ.
  void add_sphere(const nook_scene_sphere& sphere) {
    constexpr int corners = 24;
    const ImU32 colour = ImColor::HSV(std::fmod(0.618034f * float(sphere.bone), 1.0f), 0.75f, 0.95f);
    for (int axis = 0; axis < 3; ++axis) {
      const auto corner = [&](int k) {
        const float angle = glm::two_pi<float>() * float(k) / corners;
        glm::vec3 at = glm::make_vec3(sphere.centre_ws);
        at[axis] += sphere.radius * std::cos(angle);
        at[(axis + 1) % 3] += sphere.radius * std::sin(angle);
        return at;
      };
      for (int k = 0; k < corners; ++k) add(corner(k), corner(k + 1), colour);
    }
  }
};

glm::vec3 centre_ws(const CrowdScene& scene, nook_instance_id id) {
  return glm::make_vec3(nook::instance_info(scene.scene(), id).bound_centre_ws);
}

}  // namespace

void draw_debug_lines(const CrowdScene& scene, const Camera& camera, const DebugView& view) {
  Lines lines(camera);
  std::vector<nook_instance_id> nearest = scene.instances();
  std::ranges::sort(nearest, {},
                    [&](nook_instance_id id) { return glm::distance(centre_ws(scene, id), camera.eye_ws); });
  nearest.resize(std::min(nearest.size(), std::size_t(view.bodies)));
  if (view.spheres)
    for (const nook_instance_id id : nearest)
      for (const nook_scene_sphere& s : nook::posed_spheres(scene.scene(), id)) lines.add_sphere(s);
  if (view.links)
    for (const nook_instance_id receiver : scene.instances())
      for (const nook_instance_id caster : nook::linked_casters(scene.scene(), receiver))
        lines.add(centre_ws(scene, caster), centre_ws(scene, receiver), IM_COL32(243, 159, 39, 255));
}

}  // namespace crowd
