#include "bakers/measure/crowd/truth.h"

#include <nook/experimental/nook_trace.h>
#include <algorithm>
#include <cmath>

namespace nook::measure::crowd {
namespace {

// A body that is farther away takes less than 1e-3 of a vertex's hemisphere.
constexpr float kFarBody_m = 15.0f;

constexpr float kGroundHalf_m = 1000.0f, g = kGroundHalf_m;
constexpr float kGround[12] = {-g, 0, -g, g, 0, -g, -g, 0, g, g, 0, g};
constexpr std::uint32_t kGroundTriangles[6] = {0, 2, 1, 1, 2, 3};

// The points at which something is traced.
struct Points {
  std::vector<float> positions, normals;

  void add(const Body& body) {
    positions.insert(positions.end(), body.positions.begin(), body.positions.end());
    normals.insert(normals.end(), body.normals.begin(), body.normals.end());
  }

  void add(const FloorPatch& patch) {
    const float step_m = patch.size_m / float(patch.side - 1);
    for (std::uint32_t z = 0; z < patch.side; ++z)
      for (std::uint32_t x = 0; x < patch.side; ++x) {
        positions.insert(positions.end(),
                         {patch.low_x_m + float(x) * step_m, 0, patch.low_z_m + float(z) * step_m});
        normals.insert(normals.end(), {0, 1, 0});
      }
  }
};

// The bodies that are near enough to a receiver to occlude it.
struct Surroundings {
  Surroundings(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers) : body_of(crowd.size(), 0) {
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      const bool near = std::ranges::any_of(receivers, [&](std::uint32_t r) {
        return glm::length(crowd.ground_position_m(i) - crowd.ground_position_m(r)) < kFarBody_m;
      });
      if (!near) continue;
      body_of[i] = std::uint32_t(bodies.size());
      bodies.push_back(crowd.body(i));
    }
  }

  Points points_of(std::span<const std::uint32_t> receivers) const {
    Points points;
    for (const std::uint32_t r : receivers) points.add(bodies[body_of[r]]);
    return points;
  }

  std::vector<Body> bodies;
  std::vector<std::uint32_t> body_of;  // index into bodies by character
};

VertexValues split_evenly(const std::vector<float>& values, std::size_t parts) {
  VertexValues pieces;
  const std::size_t length = parts ? values.size() / parts : 0;
  for (std::size_t r = 0; r < parts; ++r) {
    const auto first = values.begin() + std::ptrdiff_t(r * length);
    pieces.emplace_back(first, first + std::ptrdiff_t(length));
  }
  return pieces;
}

std::vector<nook_bake_occluder_mesh> meshes_of(const PosedCrowd& crowd, const std::vector<Body>& bodies) {
  std::vector<nook_bake_occluder_mesh> meshes;
  for (const Body& body : bodies)
    meshes.push_back({body.positions.data(), crowd.triangles().data(), crowd.vertex_count(),
                      std::uint32_t(crowd.triangles().size())});
  return meshes;
}

std::vector<float> trace_ao(const std::vector<nook_bake_occluder_mesh>& meshes, const Points& points,
                            float radius_m, const TraceSettings& settings) {
  std::vector<float> ao(points.positions.size() / 3);
  nook_bake_trace_desc desc;
  check_bake(nook_bake_trace_desc_init(&desc));
  desc.meshes = meshes.data();
  desc.mesh_count = std::uint32_t(meshes.size());
  desc.positions = points.positions.data();
  desc.normals = points.normals.data();
  desc.point_count = std::uint32_t(ao.size());
  desc.rays = settings.rays;
  desc.radius = radius_m;
  desc.seed = settings.seed;
  check_bake(nook_bake_trace_ao(&desc, ao.data(), desc.point_count));
  return ao;
}

std::vector<nook_bake_lit_mesh> black_meshes(const std::vector<nook_bake_occluder_mesh>& occluders) {
  std::vector<nook_bake_lit_mesh> meshes;
  for (const nook_bake_occluder_mesh& m : occluders)
    meshes.push_back({m.positions, m.indices, m.vertex_count, m.index_count, {0, 0, 0}, {0, 0, 0}});
  return meshes;
}

std::vector<float> trace_irradiance(const std::vector<nook_bake_occluder_mesh>& occluders,
                                    const Points& points, const nook_bake_environment& environment,
                                    const TraceSettings& settings) {
  const std::vector<nook_bake_lit_mesh> meshes = black_meshes(occluders);
  nook_bake_irradiance_desc desc;
  check_bake(nook_bake_irradiance_desc_init(&desc));
  desc.meshes = meshes.data();
  desc.mesh_count = std::uint32_t(meshes.size());
  desc.positions = points.positions.data();
  desc.normals = points.normals.data();
  desc.point_count = std::uint32_t(points.positions.size() / 3);
  desc.environment = environment;
  desc.rays = settings.rays;
  desc.seed = settings.seed;
  desc.max_bounces = 0;
  std::vector<float> irradiance(points.positions.size());
  check_bake(nook_bake_trace_irradiance(&desc, irradiance.data(), desc.point_count));
  return irradiance;
}

std::vector<nook_bake_occluder_mesh> occluders_of(const PosedCrowd& crowd, const Surroundings& around,
                                                  const TraceSettings& settings) {
  std::vector<nook_bake_occluder_mesh> meshes = meshes_of(crowd, around.bodies);
  if (settings.ground) meshes.push_back({kGround, kGroundTriangles, 4, 6});
  return meshes;
}

}  // namespace

VertexValues traced_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                       const TraceSettings& settings) {
  const Surroundings around(crowd, receivers);
  const std::vector<float> ao =
      trace_ao(occluders_of(crowd, around, settings), around.points_of(receivers), INFINITY, settings);
  return split_evenly(ao, receivers.size());
}

std::vector<float> traced_floor_ao(const PosedCrowd& crowd, std::span<const std::uint32_t> casters,
                                   const FloorPatch& patch, float radius_m, const TraceSettings& settings) {
  std::vector<Body> bodies;
  for (const std::uint32_t caster : casters) bodies.push_back(crowd.body(caster));
  Points points;
  points.add(patch);
  return trace_ao(meshes_of(crowd, bodies), points, radius_m, settings);
}

TracedIrradiance traced_irradiance(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers,
                                   const FloorPatch* patch, const nook_bake_environment& environment,
                                   const TraceSettings& settings) {
  const Surroundings around(crowd, receivers);
  Points points = around.points_of(receivers);
  const std::size_t floor_begin = points.positions.size();
  if (patch) points.add(*patch);
  std::vector<float> irradiance =
      trace_irradiance(occluders_of(crowd, around, settings), points, environment, settings);
  TracedIrradiance traced;
  traced.floor.assign(irradiance.begin() + std::ptrdiff_t(floor_begin), irradiance.end());
  irradiance.resize(floor_begin);
  traced.bodies = split_evenly(irradiance, receivers.size());
  return traced;
}

}  // namespace nook::measure::crowd
