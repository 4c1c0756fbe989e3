#include "bakers/lab/crowd/debug_overlay.h"

#include <nook/experimental/nook_trace.h>

namespace crowd::lab {
namespace {

// With 256 rays, the standard deviation of AO is at most 1/32, which is an eighth of the colour range.
constexpr std::uint32_t rays = 256;
constexpr float ground_half_size_m = 200;

struct Body {
  std::vector<float> positions_ws, normals_ws;
};

std::vector<Body> posed_bodies(const Hero& hero, const std::vector<Bones>& poses) {
  std::vector<Body> bodies(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    hero.skin(poses[i], bodies[i].positions_ws, bodies[i].normals_ws);
  return bodies;
}

std::vector<nook_bake_occluder_mesh> occluders(const Hero& hero, const std::vector<Body>& bodies) {
  static constexpr float s = ground_half_size_m;
  static constexpr float corners[] = {-s, 0, -s, s, 0, -s, s, 0, s, -s, 0, s};
  static constexpr std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  std::vector<nook_bake_occluder_mesh> meshes{{corners, triangles, 4, 6}};
  for (const Body& body : bodies)
    meshes.push_back({body.positions_ws.data(), hero.triangles.data(), hero.vertex_count(),
                      std::uint32_t(hero.triangles.size())});
  return meshes;
}

std::vector<float> traced(const std::vector<nook_bake_occluder_mesh>& meshes, const Body& body) {
  nook_bake_trace_desc desc;
  nook::bake::check(nook_bake_trace_desc_init(&desc));
  desc.meshes = meshes.data();
  desc.mesh_count = std::uint32_t(meshes.size());
  desc.positions = body.positions_ws.data();
  desc.normals = body.normals_ws.data();
  desc.point_count = std::uint32_t(body.positions_ws.size() / 3);
  desc.rays = rays;
  std::vector<float> ao(desc.point_count);
  nook::bake::check(nook_bake_trace_ao(&desc, ao.data(), desc.point_count));
  return ao;
}

}  // namespace

DebugOverlay::DebugOverlay(const GladGLContext& gl) : gl_(gl), shapes_(gl) {
  gl.GenBuffers(1, &error_buffer_);
}

DebugOverlay::~DebugOverlay() {
  gl_.DeleteBuffers(1, &error_buffer_);
}

void DebugOverlay::draw_errors(Renderer& renderer, const PictureOfCrowd& picture, std::uint32_t count) {
  const std::vector<Body> bodies = posed_bodies(picture.hero, picture.poses);
  const std::vector<nook_bake_occluder_mesh> meshes = occluders(picture.hero, bodies);
  std::vector<DrawnInstance> drawn;
  std::vector<float> errors;
  for (const std::uint32_t character : nearest_characters(picture.scene, picture.camera.eye_ws, count)) {
    drawn.push_back(picture.drawn[character]);
    drawn.back().ao = {error_buffer_, errors.size() * sizeof(float), sizeof(float)};
    const std::vector<float> ao = read_ao(picture.scene, character),
                             truth = traced(meshes, bodies[character]);
    for (std::size_t i = 0; i < ao.size(); ++i) errors.push_back(ao[i] - truth[i]);
  }
  gl_.BindBuffer(GL_ARRAY_BUFFER, error_buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(errors.size() * sizeof(float)), errors.data(), GL_STREAM_DRAW);
  shapes_.draw_errors(renderer, drawn, picture.camera);
}

void DebugOverlay::draw(Renderer& renderer, const PictureOfCrowd& picture, const DebugView& view) {
  if (view.error) draw_errors(renderer, picture, view.bodies);
  if (!view.spheres && !view.key_points && !view.links) return;
  // The shadows of key points cannot be read back from the GPU, so they are computed on the CPU.
  if (view.key_points) picture.scene.scene().update();
  shapes_.draw(debug_shapes(picture.scene, view, picture.camera.eye_ws), picture.camera);
}

void colour_by_level(const CrowdScene& scene, std::span<DrawnInstance> drawn) {
  for (std::uint32_t i = 0; i < drawn.size(); ++i)
    drawn[i].albedo = level_colour(nook::instance_info(scene.scene(), scene.instances()[i]).level);
}

}  // namespace crowd::lab
