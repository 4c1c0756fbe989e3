#include "samples/crowd/debug_renderer.h"

#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "samples/crowd/shaders.h"

namespace crowd {
namespace {

// Spheres lie inside the body and would be hidden by it: their depth is moved towards the eye by this much.
constexpr float kSphereLift_m = 0.3f;
// The fit leaves key points beside the surface.
constexpr float kPointLift_m = 0.05f;

// A square that covers the sphere as the eye sees it: the silhouette's cone, cut by the plane through the
// centre.
const char* const kBallVertex = R"(#version 330 core
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

// The sphere's surface where the ray from the eye meets it. Its edge fades over a pixel.
const char* const kBallFragment = R"(#version 330 core
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

// A quad of constant width on the screen, cut at the near plane.
const char* const kLineVertex = R"(#version 330 core
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
const float kNear = 0.1;
vec4 lifted(vec3 position_ws) {
  vec3 to_eye = eye_ws - position_ws;
  return clip_from_world * vec4(position_ws + min(lift_m, 0.5 * length(to_eye)) * normalize(to_eye), 1.0);
}
void main() {
  vec4 from = lifted(from_width.xyz), to = lifted(to_width.xyz);
  if (from.w < kNear) from = mix(from, to, clamp((kNear - from.w) / max(to.w - from.w, 1e-6), 0.0, 1.0));
  if (to.w < kNear) to = mix(to, from, clamp((kNear - to.w) / max(from.w - to.w, 1e-6), 0.0, 1.0));
  vec2 step_px = (to.xy / to.w - from.xy / from.w) * viewport_px;
  vec2 normal = length(step_px) > 1e-3 ? normalize(vec2(-step_px.y, step_px.x)) : vec2(0.0, 1.0);
  bool first = (gl_VertexID & 1) == 0;
  vec4 clip = first ? from : to;
  // One pixel more than the line is wide, in which it fades.
  half_width_px = 0.5 * (first ? from_width.w : to_width.w) + 1.0;
  across = (gl_VertexID >> 1) == 0 ? -half_width_px : half_width_px;
  clip.xy += 2.0 * across * normal / viewport_px * clip.w;
  surface_albedo = line_colour;
  gl_Position = clip;
}
)";

const char* const kLineFragment = R"(#version 330 core
flat in vec3 surface_albedo;
in float across;
in float half_width_px;
uniform float opacity;
out vec4 colour;
void main() { colour = vec4(surface_albedo, opacity * clamp(half_width_px - abs(across), 0.0, 1.0)); }
)";

// Dark blue and dark red are the ends of the map vik, whose sides differ for colour-blind readers too. The
// shading keeps the form of the body visible.
const char* const kErrorFragment = R"(#version 330 core
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

DebugRenderer::DebugRenderer(const GladGLContext& gl)
    : gl_(gl),
      ball_(gl, {kBallVertex}, {kBallFragment}),
      line_(gl, {kLineVertex}, {kLineFragment}),
      error_(gl, {kCharacterVertex}, {kErrorFragment}) {
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

// Depth first, and then the colours of what is nearest, so that translucent spheres cover each other.
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
  draw_lines(shapes.normals, view, kPointLift_m);
  draw_balls(shapes.key_points, view, kPointLift_m, 1);
  draw_balls(shapes.spheres, view, kSphereLift_m, shapes.key_points.empty() ? 0.75f : 0.4f);
  gl_.Disable(GL_DEPTH_TEST);  // links show through bodies
  draw_lines(shapes.links, view, 0);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
}

void DebugRenderer::draw_errors(Renderer& renderer, std::span<const DrawnInstance> bodies,
                                const Camera& camera) {
  if (bodies.empty()) return;
  const View view = view_of(camera);
  set_view(error_, view, 0, 1);
  gl_.Uniform1f(error_.uniform("full_error"), kFullError);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(-1, -1);
  renderer.draw_characters(error_, bodies, view.clip_from_world);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.DepthFunc(GL_LESS);
}

}  // namespace crowd
