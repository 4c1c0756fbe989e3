// The reference of the crowd: its bodies in the poses of one moment, their ambient occlusion and light by ray
// tracing, and errors against these.
#pragma once

#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace nook::lab::crowd {

// The skinning matrices of one character: 12 floats for each bone, the three rows of a matrix that takes the
// rest pose to world space.
using Bones = std::vector<float>;

// Values at the vertices of several characters, one array for each character. A vertex has one float or, for
// light, three.
using VertexValues = std::vector<std::vector<float>>;

// A character in a pose: three floats for each vertex, in world space, positions in metres.
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
  // The x and z of the first bone, which is precise enough to find the bodies that are far apart.
  glm::vec2 ground_position_m(std::size_t character) const;

 private:
  nook_bake_character character_;
  std::span<const Bones> poses_;
  std::uint32_t vertex_count_ = 0;
  std::vector<std::uint32_t> triangles_;
};

struct TraceSettings {
  std::uint32_t rays = 64;  // for each vertex
  std::uint64_t seed = 1;
  bool ground = true;  // whether the ground plane y = 0 occludes
};

// The AO of the receivers' vertices. All bodies near a receiver occlude it, and the ground does if it is
// in the settings.
VertexValues traced_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                       const TraceSettings& settings);

// A square of the ground plane y = 0 with side x side points. The first point lies at the low corner, and x
// runs fastest.
struct FloorPatch {
  float low_x_m = 0, low_z_m = 0, size_m = 1;
  std::uint32_t side = 2;
};

// The AO of the patch's points, which only the given characters occlude. Rays end after radius_m.
std::vector<float> traced_floor_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> casters,
                                   const FloorPatch& patch, float radius_m, const TraceSettings& settings);

// Irradiance, three floats for each point. All bodies and the ground are black, so that this is what
// occlusion alone leaves of the environment's light.
struct TracedIrradiance {
  VertexValues bodies;
  std::vector<float> floor;
};

// The irradiance of the receivers' vertices and, unless patch is null, of a patch of the floor.
TracedIrradiance traced_irradiance(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                                   const FloorPatch* patch, const nook_bake_environment& environment,
                                   const TraceSettings& settings);

// Errors of values at vertices against their reference.
struct Errors {
  double mse = 0;  // mean over vertices
  // Of AO: the mean over vertices whose reference is at least visible_truth, 0 where there are none.
  double mse_visible = 0;
  double mse_area = 0;  // each vertex weighted by its area of the posed surface
};

// The errors over all receivers. Each vertex has `channels` values, and errors are in units of `unit`.
// Vertices that no triangle uses count nothing. Values of one channel are AO.
Errors compare(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers, const VertexValues& values,
               const VertexValues& reference, std::uint32_t channels = 1, float unit = 1);

}  // namespace nook::lab::crowd
