#include "samples/crowd/traced_ao.h"

#include <nook/experimental/nook_trace.h>

namespace crowd {
namespace {

// AO of 256 rays has a standard deviation of at most 1/32, which is below an eighth of the colours' range.
constexpr std::uint32_t kRays = 256;
constexpr float kGroundHalfSize_m = 200;

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
  static constexpr float s = kGroundHalfSize_m;
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
  check_bake(nook_bake_trace_desc_init(&desc));
  desc.meshes = meshes.data();
  desc.mesh_count = std::uint32_t(meshes.size());
  desc.positions = body.positions_ws.data();
  desc.normals = body.normals_ws.data();
  desc.point_count = std::uint32_t(body.positions_ws.size() / 3);
  desc.rays = kRays;
  std::vector<float> ao(desc.point_count);
  check_bake(nook_bake_trace_ao(&desc, ao.data(), desc.point_count));
  return ao;
}

}  // namespace

TracedAo::TracedAo(const Hero& hero, std::vector<Bones> poses, std::vector<std::uint32_t> characters)
    : characters_(std::move(characters)), thread_([this, &hero, poses = std::move(poses)] {
        try {
          trace(hero, poses);
        } catch (const std::exception& failure) {
          const std::lock_guard hold(lock_);
          failure_ = failure.what();
        }
      }) {}

TracedAo::~TracedAo() {
  stop_ = true;
  thread_.join();
}

void TracedAo::trace(const Hero& hero, const std::vector<Bones>& poses) {
  const std::vector<Body> bodies = posed_bodies(hero, poses);
  const std::vector<nook_bake_occluder_mesh> meshes = occluders(hero, bodies);
  for (const std::uint32_t character : characters_) {
    if (stop_) return;
    std::vector<float> ao = traced(meshes, bodies[character]);
    const std::lock_guard hold(lock_);
    done_[character] = std::move(ao);
  }
}

std::map<std::uint32_t, std::vector<float>> TracedAo::done() const {
  const std::lock_guard hold(lock_);
  return done_;
}

bool TracedAo::is_done() const {
  const std::lock_guard hold(lock_);
  return done_.size() == characters_.size() || !failure_.empty();
}

std::string TracedAo::failure() const {
  const std::lock_guard hold(lock_);
  return failure_;
}

}  // namespace crowd
