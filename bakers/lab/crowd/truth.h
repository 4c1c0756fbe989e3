// Computes the reference of the crowd at one moment by ray tracing, for ambient occlusion and light. Also
// computes errors relative to the reference.
#pragma once

#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace nook::lab::crowd {

// The skinning matrices of one character. Each bone has 12 floats, the three rows of the matrix from the rest
// pose to world space.
using Bones = std::vector<float>;

// Values at the vertices of several characters, one array per character. Each vertex has one float or, for
// light, three floats.
using VertexValues = std::vector<std::vector<float>>;

// A posed character in world space. Each array has three floats per vertex. Positions are in metres.
struct Body {
  std::vector<float> positions, normals;
};

// Many instances of one imported character, each in its own pose.
class PosedCrowd {
 public:
  // `character` and `poses` must outlive this object.
  PosedCrowd(nook_bake_character character, std::span<const Bones> poses);

  std::size_t size() const { return poses_.size(); }
  std::uint32_t vertex_count() const { return vertex_count_; }
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }  // three indices each

  Body body(std::size_t character) const;
  // Returns x and z of the first bone. This is precise enough to find distant bodies.
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
  bool ground = true;  // true if the ground plane y = 0 occludes
};

// Returns the AO of the receivers' vertices. All bodies near a receiver occlude it. The ground also occludes
// it if settings.ground is true.
VertexValues traced_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                       const TraceSettings& settings);

// A square of the ground plane y = 0 with `side` x `side` points. The first point is at the corner with the
// lowest x and z, and x varies fastest.
struct FloorPatch {
  float low_x_m = 0, low_z_m = 0, size_m = 1;
  std::uint32_t side = 2;
};

// Returns the AO at the points of the patch. Only the given characters occlude. Rays end after radius_m.
std::vector<float> traced_floor_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> casters,
                                   const FloorPatch& patch, float radius_m, const TraceSettings& settings);

// Irradiance, three floats per point. All bodies and the ground are treated as black. The irradiance is
// therefore only the part of the environment's light that is not occluded. It does not include light from
// surfaces.
struct TracedIrradiance {
  VertexValues bodies;
  std::vector<float> floor;
};

// Returns the irradiance at the receivers' vertices. If `patch` is not null, also returns the irradiance at
// the points of the patch.
TracedIrradiance traced_irradiance(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                                   const FloorPatch* patch, const nook_bake_environment& environment,
                                   const TraceSettings& settings);

// Errors of vertex values relative to their reference.
struct Errors {
  double mse = 0;  // mean over vertices
  // Only for AO: the mean over vertices whose reference AO is at least visible_truth, or 0 if there are none.
  double mse_visible = 0;
  double mse_area = 0;  // like mse, but weighted by each vertex's area on the posed surface
};

// Returns the errors over all receivers. Each vertex has `channels` values; one channel means AO. Errors are
// in units of `unit`. Vertices without a triangle do not count.
Errors compare(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers, const VertexValues& values,
               const VertexValues& reference, std::uint32_t channels = 1, float unit = 1);

}  // namespace nook::lab::crowd
