#include "samples/crowd/debug_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace crowd {
namespace {

const char* const line_vertex = R"(#version 330 core
layout(location = 0) in vec3 position_ws;
layout(location = 1) in vec3 line_colour;
uniform mat4 clip_from_world;
out vec3 surface_colour;
void main() {
  surface_colour = line_colour;
  gl_Position = clip_from_world * vec4(position_ws, 1.0);
}
)";
const char* const line_fragment = R"(#version 330 core
in vec3 surface_colour;
out vec4 colour;
void main() { colour = vec4(surface_colour, 1.0); }
)";

struct LineEnd {
  glm::vec3 at_ws, colour;
};

// Hues a golden angle apart, so that neighbouring bones differ.
glm::vec3 bone_colour(std::uint32_t bone) {
  const float hue = 6 * std::fmod(0.618034f * float(bone), 1.0f);
  return glm::clamp(glm::abs(glm::mod(glm::vec3(hue, hue + 4, hue + 2), 6.0f) - 3.0f) - 1.0f,
                    glm::vec3(0.05f), glm::vec3(0.9f));
}

// Three circles of a sphere.
void add_sphere(const nook_scene_sphere& sphere, std::vector<LineEnd>& out) {
  constexpr int corners = 24;
  const glm::vec3 colour = bone_colour(sphere.bone);
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 2 * corners; ++k) {
      const float angle = glm::two_pi<float>() * float((k + 1) / 2) / corners;
      glm::vec3 at = glm::make_vec3(sphere.centre_ws);
      at[axis] += sphere.radius * std::cos(angle);
      at[(axis + 1) % 3] += sphere.radius * std::sin(angle);
      out.push_back({at, colour});
    }
}

glm::vec3 centre_ws(const CrowdScene& scene, nook_instance_id id) {
  return glm::make_vec3(nook::instance_info(scene.scene(), id).bound_centre_ws);
}

}  // namespace

DebugLines::DebugLines(const GladGLContext& gl) : gl_(gl), program_(gl, {line_vertex}, {line_fragment}) {
  gl.GenVertexArrays(1, &array_);
  gl.GenBuffers(1, &buffer_);
  gl.BindVertexArray(array_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  for (const GLuint slot : {0u, 1u}) {
    gl.EnableVertexAttribArray(slot);
    gl.VertexAttribPointer(slot, 3, GL_FLOAT, GL_FALSE, sizeof(LineEnd),
                           reinterpret_cast<const void*>(slot * sizeof(glm::vec3)));
  }
}

DebugLines::~DebugLines() {
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteBuffers(1, &buffer_);
}

void DebugLines::draw(const CrowdScene& scene, const Camera& camera, float aspect, const DebugView& view) {
  std::vector<nook_instance_id> nearest = scene.instances();
  std::ranges::sort(nearest, {},
                    [&](nook_instance_id id) { return glm::distance(centre_ws(scene, id), camera.eye_ws); });
  nearest.resize(std::min(nearest.size(), std::size_t(view.bodies)));
  std::vector<LineEnd> ends;
  if (view.spheres)
    for (const nook_instance_id id : nearest)
      for (const nook_scene_sphere& s : nook::posed_spheres(scene.scene(), id)) add_sphere(s, ends);
  if (view.links)
    for (const nook_instance_id receiver : scene.instances())
      for (const nook_instance_id caster : nook::linked_casters(scene.scene(), receiver))
        for (const nook_instance_id id : {caster, receiver})
          ends.push_back({centre_ws(scene, id), {0.90f, 0.35f, 0.02f}});
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(ends.size() * sizeof(LineEnd)), ends.data(), GL_STREAM_DRAW);
  program_.use();
  gl_.UniformMatrix4fv(program_.uniform("clip_from_world"), 1, GL_FALSE,
                       glm::value_ptr(clip_from_world(camera, aspect)));
  gl_.Disable(GL_DEPTH_TEST);
  gl_.DrawArrays(GL_LINES, 0, GLsizei(ends.size()));
}

}  // namespace crowd
