// Makes the reference of the crowd at one moment: ray-traced ambient occlusion and light, and errors against
// them.
#pragma once

#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace nook::lab::crowd {

// The skinning matrices of one character: 12 floats for each bone, the three rows of a matrix from the rest
// pose to world space.
using Bones = std::vector<float>;

// The values at the vertices of several characters are one array per character. A vertex has one float or,
// for light, three.
using VertexValues = std::vector<std::vector<float>>;

// A character in a pose: three floats per vertex, in world space, positions in metres.
struct Body {
  std::vector<float> positions, normals;
};

// Many instances of one imported character.
class PosedCrowd {
 public:
  // The character and the poses must outlive this object.
  PosedCrowd(nook_bake_character character, std::span<const Bones> poses);

  std::size_t size() const { return poses_.size(); }
  std::uint32_t vertex_count() const { return vertex_count_; }
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }  // three indices each

  Body body(std::size_t character) const;
  // Returns the x and z of the first bone, which is precise enough to find distant bodies.
  glm::vec2 ground_position_m(std::size_t character) const;

 private:
  nook_bake_character character_;
  std::span<const Bones> poses_;
  std::uint32_t vertex_count_ = 0;
  std::vector<std::uint32_t> triangles_;
};

struct TraceSettings {
  std::uint32_t rays = 64;  // per vertex
  std::uint64_t seed = 1;
  bool ground = true;  // whether the ground plane y = 0 occludes
};

// Returns the AO of the receivers' vertices. All bodies near a receiver occlude it. The ground occludes it if
// the settings include it.
VertexValues traced_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                       const TraceSettings& settings);

// A square of the ground plane y = 0 with side x side points. The first point lies at the low corner, and x
// runs fastest.
struct FloorPatch {
  float low_x_m = 0, low_z_m = 0, size_m = 1;
  std::uint32_t side = 2;
};

// Returns the AO of the patch's points. Only the given characters occlude them. Rays end after radius_m.
std::vector<float> traced_floor_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> casters,
                                   const FloorPatch& patch, float radius_m, const TraceSettings& settings);

// Irradiance, three floats per point. All bodies and the ground are black, so that this is what occlusion
// alone leaves of the environment's light.
struct TracedIrradiance {
  VertexValues bodies;
  std::vector<float> floor;
};

// Returns the irradiance of the receivers' vertices and, unless patch is null, of a patch of the floor.
TracedIrradiance traced_irradiance(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                                   const FloorPatch* patch, const nook_bake_environment& environment,
                                   const TraceSettings& settings);

// Errors of values at vertices against their reference.
struct Errors {
  double mse = 0;  // mean over vertices
  // For AO: the mean over vertices whose reference is at least visible_truth; 0 if there are none.
  double mse_visible = 0;
  double mse_area = 0;  // weighted by each vertex's area on the posed surface
};

// Returns the errors over all receivers. Each vertex has `channels` values, and errors are in units of
// `unit`. Vertices without a triangle do not count. Values with one channel are AO.
Errors compare(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers, const VertexValues& values,
               const VertexValues& reference, std::uint32_t channels = 1, float unit = 1);

}  // namespace nook::lab::crowd
