#include "bakers/lab/crowd/truth.h"

#include <nook/experimental/nook_trace.h>
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <nook/nook_bake.hpp>

#include "bakers/measure/character/character_error.h"

namespace nook::lab::crowd {
namespace {

// Bodies farther away than this are ignored, because they cover less than 1e-3 of a vertex's hemisphere.
constexpr float far_body_m = 15.0f;

constexpr float ground_half_m = 1000.0f, g = ground_half_m;
constexpr float ground_corners[12] = {-g, 0, -g, g, 0, -g, -g, 0, g, g, 0, g};
constexpr std::uint32_t ground_triangles[6] = {0, 2, 1, 1, 2, 3};

// The points at which AO or light is traced.
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
        return glm::length(crowd.ground_position_m(i) - crowd.ground_position_m(r)) < far_body_m;
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
  std::vector<std::uint32_t> body_of;  // for each character, the index into `bodies`
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
  bake::check(nook_bake_trace_desc_init(&desc));
  desc.meshes = meshes.data();
  desc.mesh_count = std::uint32_t(meshes.size());
  desc.positions = points.positions.data();
  desc.normals = points.normals.data();
  desc.point_count = std::uint32_t(ao.size());
  desc.rays = settings.rays;
  desc.radius = radius_m;
  desc.seed = settings.seed;
  bake::check(nook_bake_trace_ao(&desc, ao.data(), desc.point_count));
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
  bake::check(nook_bake_irradiance_desc_init(&desc));
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
  bake::check(nook_bake_trace_irradiance(&desc, irradiance.data(), desc.point_count));
  return irradiance;
}

std::vector<nook_bake_occluder_mesh> occluders_of(const PosedCrowd& crowd, const Surroundings& around,
                                                  const TraceSettings& settings) {
  std::vector<nook_bake_occluder_mesh> meshes = meshes_of(crowd, around.bodies);
  if (settings.ground) meshes.push_back({ground_corners, ground_triangles, 4, 6});
  return meshes;
}

glm::vec3 point(const std::vector<float>& positions, std::uint32_t vertex) {
  return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
}

// Returns the area of each vertex in square metres: a third of the area of each triangle that uses the
// vertex.
std::vector<double> vertex_areas(const PosedCrowd& crowd, const std::vector<float>& positions) {
  std::vector<double> areas(crowd.vertex_count(), 0.0);
  for (std::size_t t = 0; t < crowd.triangles().size(); t += 3) {
    const std::uint32_t* v = &crowd.triangles()[t];
    const glm::vec3 a = point(positions, v[0]);
    const double area =
        0.5 * double(glm::length(glm::cross(point(positions, v[1]) - a, point(positions, v[2]) - a)));
    for (int k = 0; k < 3; ++k) areas[v[k]] += area / 3;
  }
  return areas;
}

}  // namespace

PosedCrowd::PosedCrowd(nook_bake_character character, std::span<const Bones> poses)
    : character_(character), poses_(poses) {
  nook_bake_character_info info{};
  info.struct_size = sizeof info;
  bake::check(nook_bake_character_describe(character, &info));
  vertex_count_ = info.file_vertex_count;
  triangles_.resize(3 * std::size_t(info.triangle_count));
  bake::check(nook_bake_character_read(character, NOOK_BAKE_ARRAY_TRIANGLES, triangles_.data(),
                                       info.triangle_count, 0));
}

Body PosedCrowd::body(std::size_t character) const {
  const Bones& bones = poses_[character];
  Body body;
  body.positions.resize(3 * std::size_t(vertex_count_));
  body.normals.resize(body.positions.size());
  bake::check(nook_bake_character_skin(character_, bones.data(), std::uint32_t(bones.size() / 12),
                                       body.positions.data(), body.normals.data(), vertex_count_));
  return body;
}

glm::vec2 PosedCrowd::ground_position_m(std::size_t character) const {
  return {poses_[character][3], poses_[character][11]};
}

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

Errors compare(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers, const VertexValues& values,
               const VertexValues& reference, std::uint32_t channels, float unit) {
  double squares = 0, visible_squares = 0, weighted_squares = 0, vertices = 0, visible = 0, area = 0;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const std::vector<double> areas = vertex_areas(crowd, crowd.body(receivers[r]).positions);
    for (std::size_t v = 0; v < areas.size(); ++v) {
      if (areas[v] <= 0) continue;
      double square = 0;
      for (std::uint32_t c = 0; c < channels; ++c) {
        const double error =
            (double(values[r][channels * v + c]) - double(reference[r][channels * v + c])) / double(unit);
        square += error * error / channels;
      }
      squares += square;
      weighted_squares += areas[v] * square;
      vertices += 1;
      area += areas[v];
      if (channels != 1 || double(reference[r][v]) < measure::visible_truth) continue;
      visible_squares += square;
      visible += 1;
    }
  }
  return {vertices > 0 ? squares / vertices : 0, visible > 0 ? visible_squares / visible : 0,
          area > 0 ? weighted_squares / area : 0};
}

}  // namespace nook::lab::crowd
