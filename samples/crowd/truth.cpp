#include "truth.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace crowd {
namespace {

// A body farther away than this takes less than 1e-3 of a vertex's hemisphere.
constexpr float kFarBody_m = 15.0f;
constexpr float kGroundHalfSize_m = 1000.0f;

struct Body {
  std::vector<float> positions, normals;
};

// Of the first bone: near enough to tell which bodies are far.
glm::vec2 place_of(const Bones& bones) {
  return {bones[3], bones[11]};
}

glm::vec3 point(const std::vector<float>& positions, std::uint32_t vertex) {
  return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
}

// A third of each triangle goes to each of its vertices.
std::vector<double> vertex_areas(const Hero& hero, const std::vector<float>& positions) {
  std::vector<double> areas(hero.vertex_count(), 0.0);
  for (std::size_t t = 0; t < hero.triangles.size(); t += 3) {
    const std::uint32_t* v = &hero.triangles[t];
    const glm::vec3 a = point(positions, v[0]);
    const double area =
        0.5 * double(glm::length(glm::cross(point(positions, v[1]) - a, point(positions, v[2]) - a)));
    for (int k = 0; k < 3; ++k) areas[v[k]] += area / 3;
  }
  return areas;
}

std::vector<nook_bake_occluder_mesh> meshes_of(const Hero& hero, const std::vector<Body>& bodies) {
  std::vector<nook_bake_occluder_mesh> meshes;
  for (const Body& body : bodies)
    meshes.push_back({body.positions.data(), hero.triangles.data(), hero.vertex_count(),
                      std::uint32_t(hero.triangles.size())});
  return meshes;
}

std::vector<float> trace(const std::vector<nook_bake_occluder_mesh>& meshes,
                         const std::vector<float>& positions, const std::vector<float>& normals,
                         float radius_m, const TraceRequest& request) {
  std::vector<float> ao(positions.size() / 3);
  nook_bake_trace_desc desc;
  bake_check(nook_bake_trace_desc_init(&desc, sizeof desc, NOOK_VERSION));
  desc.meshes = meshes.data();
  desc.mesh_count = std::uint32_t(meshes.size());
  desc.positions = positions.data();
  desc.normals = normals.data();
  desc.point_count = std::uint32_t(ao.size());
  desc.rays = request.rays;
  desc.radius = radius_m;
  desc.seed = request.seed;
  bake_check(nook_bake_trace_ao(&desc, ao.data(), desc.point_count));
  return ao;
}

}  // namespace

std::vector<float> traced_floor_ao(const Hero& hero, const std::vector<Bones>& poses,
                                   std::span<const std::uint32_t> casters, const FloorPatch& patch,
                                   float radius_m, const TraceRequest& request) {
  std::vector<Body> bodies(casters.size());
  for (std::size_t i = 0; i < casters.size(); ++i)
    hero.skin(poses[casters[i]], bodies[i].positions, bodies[i].normals);
  std::vector<float> positions, normals;
  const float step_m = patch.size_m / float(patch.side - 1);
  for (std::uint32_t z = 0; z < patch.side; ++z)
    for (std::uint32_t x = 0; x < patch.side; ++x) {
      positions.insert(positions.end(),
                       {patch.low_x_m + float(x) * step_m, 0, patch.low_z_m + float(z) * step_m});
      normals.insert(normals.end(), {0, 1, 0});
    }
  return trace(meshes_of(hero, bodies), positions, normals, radius_m, request);
}

std::vector<std::vector<float>> traced_ao(const Hero& hero, const std::vector<Bones>& poses,
                                          std::span<const std::uint32_t> receivers,
                                          const TraceRequest& request) {
  const auto is_near = [&](const Bones& pose) {
    return std::any_of(receivers.begin(), receivers.end(), [&](std::uint32_t r) {
      return glm::length(place_of(pose) - place_of(poses[r])) < kFarBody_m;
    });
  };
  std::vector<Body> bodies;
  std::vector<std::uint32_t> body_of(poses.size(), 0);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!is_near(poses[i])) continue;
    body_of[i] = std::uint32_t(bodies.size());
    Body& body = bodies.emplace_back();
    hero.skin(poses[i], body.positions, body.normals);
  }
  std::vector<nook_bake_occluder_mesh> meshes = meshes_of(hero, bodies);
  constexpr float g = kGroundHalfSize_m;
  const float ground[12] = {-g, 0, -g, g, 0, -g, -g, 0, g, g, 0, g};
  const std::uint32_t ground_triangles[6] = {0, 2, 1, 1, 2, 3};
  if (request.ground) meshes.push_back({ground, ground_triangles, 4, 6});

  std::vector<float> positions, normals;
  for (const std::uint32_t r : receivers) {
    const Body& body = bodies[body_of[r]];
    positions.insert(positions.end(), body.positions.begin(), body.positions.end());
    normals.insert(normals.end(), body.normals.begin(), body.normals.end());
  }
  const std::vector<float> ao = trace(meshes, positions, normals, INFINITY, request);
  std::vector<std::vector<float>> split;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const auto first = ao.begin() + std::ptrdiff_t(r * hero.vertex_count());
    split.emplace_back(first, first + hero.vertex_count());
  }
  return split;
}

Errors compare(const Hero& hero, const std::vector<Bones>& poses, std::span<const std::uint32_t> receivers,
               const std::vector<std::vector<float>>& ao, const std::vector<std::vector<float>>& truth) {
  double squares = 0, weighted_squares = 0, vertices = 0, area = 0;
  Body body;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    hero.skin(poses[receivers[r]], body.positions, body.normals);
    const std::vector<double> areas = vertex_areas(hero, body.positions);
    for (std::size_t v = 0; v < areas.size(); ++v) {
      if (areas[v] <= 0) continue;
      const double error = double(ao[r][v]) - double(truth[r][v]);
      squares += error * error;
      weighted_squares += areas[v] * error * error;
      vertices += 1;
      area += areas[v];
    }
  }
  return {vertices > 0 ? squares / vertices : 0, area > 0 ? weighted_squares / area : 0};
}

}  // namespace crowd
