#include "bakers/lab/crowd/debug_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

namespace crowd::lab {
namespace {

constexpr float point_radius_m = 0.009f, normal_length_m = 0.05f, normal_width_px = 1.5f;
constexpr float caster_width_px = 7, receiver_width_px = 1;
constexpr glm::vec3 link_colour(0.90f, 0.35f, 0.02f);

glm::vec3 vec(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

glm::vec3 centre_ws(const CrowdScene& scene, nook_instance_id id) {
  return vec(nook::instance_info(scene.scene(), id).bound_centre_ws);
}

glm::vec3 linear(const glm::vec3& srgb) {
  return glm::pow(srgb, glm::vec3(2.2f));
}

// Returns the colour of a bone. The hues of consecutive bones differ by the golden angle, so that
// neighbouring bones look different.
glm::vec3 bone_colour(std::uint32_t bone) {
  const float hue = 6 * std::fmod(0.618034f * float(bone), 1.0f);
  const glm::vec3 full = glm::clamp(glm::abs(glm::mod(glm::vec3(hue, hue + 4, hue + 2), 6.0f) - 3.0f) - 1.0f,
                                    glm::vec3(0), glm::vec3(1));
  return linear(0.30f + 0.62f * full);
}

void add_spheres(const CrowdScene& scene, std::uint32_t character, std::vector<Ball>& out) {
  for (const nook_scene_sphere& s : nook::posed_spheres(scene.scene(), scene.instances()[character]))
    out.push_back({vec(s.centre_ws), s.radius, bone_colour(s.bone)});
}

// Adds the key points of a character. Points that face away from the eye are left out, because they are on
// the far side of the body.
void add_key_points(const CrowdScene& scene, std::uint32_t character, const glm::vec3& eye_ws,
                    DebugShapes& out) {
  for (const nook_scene_key_point& p : nook::posed_key_points(scene.scene(), scene.instances()[character])) {
    const glm::vec3 at = vec(p.position_ws), normal = vec(p.normal_ws), colour = shadow_colour(p.shadow);
    if (glm::dot(eye_ws - at, normal) <= 0) continue;
    out.key_points.push_back({at, point_radius_m, colour});
    out.normals.push_back({at, normal_width_px, at + normal_length_m * normal, normal_width_px, colour});
  }
}

void add_links(const CrowdScene& scene, std::vector<Line>& out) {
  for (const nook_instance_id receiver : scene.instances())
    for (const nook_instance_id caster : nook::linked_casters(scene.scene(), receiver))
      out.push_back({centre_ws(scene, caster), caster_width_px, centre_ws(scene, receiver), receiver_width_px,
                     link_colour});
}

// The depth of spheres is moved towards the eye by this distance, because the body would hide the spheres
// otherwise.
constexpr float sphere_lift_m = 0.3f;
// The depth of key points is moved too, because fitted key points do not lie exactly on the surface.
constexpr float point_lift_m = 0.05f;

// Draws a square that covers the sphere as seen from the eye. Its size is the section of the silhouette cone
// with the plane through the sphere's centre.
const char* const ball_vertex = R"(#version 330 core
layout(location = 0) in vec4 centre_radius;
layout(location = 1) in vec3 ball_colour;
uniform mat4 clip_from_world;
uniform vec3 eye_ws;
flat out vec4 ball;
flat out vec3 surface_albedo;
out vec3 position_ws;
void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  vec3 to_eye = eye_ws - centre_radius.xyz;
  float distance_m = length(to_eye), radius_m = centre_radius.w;
  vec3 forward = to_eye / distance_m;
  vec3 side = normalize(cross(abs(forward.y) < 0.99 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), forward));
  vec3 up = cross(forward, side);
  float half_size_m = radius_m * distance_m / sqrt(max(distance_m * distance_m - radius_m * radius_m, 1e-6));
  position_ws = centre_radius.xyz + half_size_m * (corner.x * side + corner.y * up);
  ball = centre_radius;
  surface_albedo = ball_colour;
  gl_Position = clip_from_world * vec4(position_ws, 1.0);
}
)";

// Draws the point where the ray from the eye hits the sphere. The sphere's edge fades out over one pixel.
const char* const ball_fragment = R"(#version 330 core
flat in vec4 ball;
flat in vec3 surface_albedo;
in vec3 position_ws;
uniform mat4 clip_from_world;
uniform vec3 eye_ws;
uniform float lift_m;
uniform float opacity;
out vec4 colour;
void main() {
  vec3 ray = normalize(position_ws - eye_ws), to_centre = ball.xyz - eye_ws;
  float along_m = dot(to_centre, ray);
  vec3 off = to_centre - along_m * ray;
  float inside = 1.0 - dot(off, off) / (ball.w * ball.w);
  float edge = fwidth(inside);
  if (inside <= 0.0) discard;
  float hit_m = along_m - ball.w * sqrt(inside);
  vec3 normal_ws = (hit_m * ray - to_centre) / ball.w;
  vec4 clip = clip_from_world * vec4(eye_ws + max(hit_m - lift_m, 0.1) * ray, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
  float facing = max(-dot(normal_ws, ray), 0.0);
  vec3 lit = surface_albedo * (0.25 + 0.75 * facing * (0.7 + 0.3 * normal_ws.y));
  colour = vec4(lit, opacity * min(inside / max(edge, 1e-6), 1.0));
}
)";

// Draws a line as a quad with constant width on the screen, clipped at the near plane.
const char* const line_vertex = R"(#version 330 core
layout(location = 0) in vec4 from_width;
layout(location = 1) in vec4 to_width;
layout(location = 2) in vec3 line_colour;
uniform mat4 clip_from_world;
uniform vec3 eye_ws;
uniform vec2 viewport_px;
uniform float lift_m;
flat out vec3 surface_albedo;
out float across;
out float half_width_px;
const float near = 0.1;
vec4 lifted(vec3 position_ws) {
  vec3 to_eye = eye_ws - position_ws;
  return clip_from_world * vec4(position_ws + min(lift_m, 0.5 * length(to_eye)) * normalize(to_eye), 1.0);
}
void main() {
  vec4 from = lifted(from_width.xyz), to = lifted(to_width.xyz);
  if (from.w < near) from = mix(from, to, clamp((near - from.w) / max(to.w - from.w, 1e-6), 0.0, 1.0));
  if (to.w < near) to = mix(to, from, clamp((near - to.w) / max(from.w - to.w, 1e-6), 0.0, 1.0));
  vec2 step_px = (to.xy / to.w - from.xy / from.w) * viewport_px;
  vec2 normal = length(step_px) > 1e-3 ? normalize(vec2(-step_px.y, step_px.x)) : vec2(0.0, 1.0);
  bool first = (gl_VertexID & 1) == 0;
  vec4 clip = first ? from : to;
  // The quad is one pixel wider than the line on each side. The line fades out there.
  half_width_px = 0.5 * (first ? from_width.w : to_width.w) + 1.0;
  across = (gl_VertexID >> 1) == 0 ? -half_width_px : half_width_px;
  clip.xy += 2.0 * across * normal / viewport_px * clip.w;
  surface_albedo = line_colour;
  gl_Position = clip;
}
)";

const char* const line_fragment = R"(#version 330 core
flat in vec3 surface_albedo;
in float across;
in float half_width_px;
uniform float opacity;
out vec4 colour;
void main() { colour = vec4(surface_albedo, opacity * clamp(half_width_px - abs(across), 0.0, 1.0)); }
)";

// Dark blue and dark red are the ends of the colour map vik, which colour-blind people can distinguish. The
// shading keeps the shape of the body visible.
const char* const error_fragment = R"(#version 330 core
in vec3 surface_position_ws;
in vec3 surface_normal_ws;
in float surface_ao;
uniform vec3 eye_ws;
uniform float full_error;
out vec4 colour;
void main() {
  float t = clamp(surface_ao / full_error, -1.0, 1.0);
  vec3 end = t > 0.0 ? vec3(0.004, 0.09, 0.38) : vec3(0.42, 0.02, 0.01);
  vec3 near = t > 0.0 ? vec3(0.15, 0.45, 0.75) : vec3(0.78, 0.30, 0.10);
  float size = abs(t);
  vec3 hue = size < 0.5 ? mix(vec3(0.78), near, 2.0 * size) : mix(near, end, 2.0 * size - 1.0);
  float facing = abs(dot(normalize(surface_normal_ws), normalize(eye_ws - surface_position_ws)));
  colour = vec4(hue * (0.7 + 0.3 * facing), 1.0);
}
)";

const void* at(std::size_t offset) {
  return reinterpret_cast<const void*>(offset);
}

}  // namespace

std::vector<std::uint32_t> nearest_characters(const CrowdScene& scene, const glm::vec3& to_ws,
                                              std::uint32_t count) {
  std::vector<std::uint32_t> characters(scene.instances().size());
  std::iota(characters.begin(), characters.end(), 0u);
  std::vector<float> distance_m;
  for (const std::uint32_t c : characters)
    distance_m.push_back(glm::distance(centre_ws(scene, scene.instances()[c]), to_ws));
  std::sort(characters.begin(), characters.end(),
            [&](std::uint32_t a, std::uint32_t b) { return distance_m[a] < distance_m[b]; });
  characters.resize(std::min<std::size_t>(characters.size(), count));
  return characters;
}

std::vector<float> read_ao(const CrowdScene& scene, std::size_t character) {
  std::vector<float> ao(scene.model().info().file_vertex_count);
  scene.gl().read(scene.scene(), scene.instances()[character], NOOK_CHANNEL_AO, ao.data(),
                  std::uint32_t(ao.size()));
  return ao;
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

// The colours are sky blue, bluish green, yellow, orange and vermilion of Okabe and Ito, which colour-blind
// people can distinguish.
glm::vec3 level_colour(std::uint32_t level) {
  static const glm::vec3 colours[] = {{0.34f, 0.71f, 0.91f},
                                      {0.00f, 0.62f, 0.45f},
                                      {0.94f, 0.89f, 0.26f},
                                      {0.90f, 0.62f, 0.00f},
                                      {0.84f, 0.37f, 0.00f}};
  return linear(colours[std::min<std::size_t>(level, std::size(colours) - 1)]);
}

// Interpolates between the two ends and the middle of the colour map cividis.
glm::vec3 shadow_colour(float shadow) {
  const glm::vec3 dark(0.00f, 0.14f, 0.31f), grey(0.49f, 0.48f, 0.47f), yellow(0.99f, 0.91f, 0.22f);
  const float t = std::clamp(shadow / full_shadow, 0.0f, 1.0f);
  return linear(t < 0.5f ? glm::mix(dark, grey, 2 * t) : glm::mix(grey, yellow, 2 * t - 1));
}

DebugRenderer::DebugRenderer(const GladGLContext& gl)
    : gl_(gl),
      ball_(gl, {ball_vertex}, {ball_fragment}),
      line_(gl, {line_vertex}, {line_fragment}),
      error_(gl, {character_vertex}, {error_fragment}) {
  gl.GenVertexArrays(2, arrays_);
  gl.GenBuffers(1, &buffer_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  const auto attribute = [&](GLuint slot, GLint components, GLsizei stride, std::size_t offset) {
    gl.EnableVertexAttribArray(slot);
    gl.VertexAttribPointer(slot, components, GL_FLOAT, GL_FALSE, stride, at(offset));
    gl.VertexAttribDivisor(slot, 1);
  };
  gl.BindVertexArray(arrays_[0]);
  attribute(0, 4, sizeof(Ball), offsetof(Ball, centre_ws));
  attribute(1, 3, sizeof(Ball), offsetof(Ball, colour));
  gl.BindVertexArray(arrays_[1]);
  attribute(0, 4, sizeof(Line), offsetof(Line, from_ws));
  attribute(1, 4, sizeof(Line), offsetof(Line, to_ws));
  attribute(2, 3, sizeof(Line), offsetof(Line, colour));
}

DebugRenderer::~DebugRenderer() {
  gl_.DeleteVertexArrays(2, arrays_);
  gl_.DeleteBuffers(1, &buffer_);
}

DebugRenderer::View DebugRenderer::view_of(const Camera& camera) const {
  GLint viewport[4];
  gl_.GetIntegerv(GL_VIEWPORT, viewport);
  const glm::vec2 size_px(viewport[2], viewport[3]);
  return {clip_from_world(camera, size_px.x / size_px.y), camera.eye_ws, size_px};
}

void DebugRenderer::set_view(const platform::Program& program, const View& view, float lift_m,
                             float opacity) const {
  program.use();
  gl_.UniformMatrix4fv(program.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(view.clip_from_world));
  gl_.Uniform3fv(program.uniform("eye_ws"), 1, glm::value_ptr(view.eye_ws));
  gl_.Uniform2fv(program.uniform("viewport_px"), 1, glm::value_ptr(view.viewport_px));
  gl_.Uniform1f(program.uniform("lift_m"), lift_m);
  gl_.Uniform1f(program.uniform("opacity"), opacity);
}

// Draws the spheres twice: first only their depth, then the colours of the nearest ones. A translucent sphere
// thus hides the spheres behind it.
void DebugRenderer::draw_balls(const std::vector<Ball>& balls, const View& view, float lift_m,
                               float opacity) {
  if (balls.empty()) return;
  gl_.BindVertexArray(arrays_[0]);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(balls.size() * sizeof(Ball)), balls.data(), GL_STREAM_DRAW);
  set_view(ball_, view, lift_m, opacity);
  const auto draw = [&] { gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(balls.size())); };
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw();
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.DepthFunc(GL_EQUAL);
  draw();
  gl_.DepthFunc(GL_LESS);
}

void DebugRenderer::draw_lines(const std::vector<Line>& lines, const View& view, float lift_m) {
  if (lines.empty()) return;
  gl_.BindVertexArray(arrays_[1]);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(lines.size() * sizeof(Line)), lines.data(), GL_STREAM_DRAW);
  set_view(line_, view, lift_m, 0.9f);
  gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(lines.size()));
}

void DebugRenderer::draw(const DebugShapes& shapes, const Camera& camera) {
  const View view = view_of(camera);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  draw_lines(shapes.normals, view, point_lift_m);
  draw_balls(shapes.key_points, view, point_lift_m, 1);
  draw_balls(shapes.spheres, view, sphere_lift_m, shapes.key_points.empty() ? 0.75f : 0.4f);
  gl_.Disable(GL_DEPTH_TEST);  // links are visible through bodies
  draw_lines(shapes.links, view, 0);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
}

void DebugRenderer::draw_errors(Renderer& renderer, std::span<const DrawnInstance> bodies,
                                const Camera& camera) {
  if (bodies.empty()) return;
  const View view = view_of(camera);
  set_view(error_, view, 0, 1);
  gl_.Uniform1f(error_.uniform("full_error"), full_error);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(-1, -1);
  renderer.draw_characters(error_, bodies, view.clip_from_world);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.DepthFunc(GL_LESS);
}

}  // namespace crowd::lab
