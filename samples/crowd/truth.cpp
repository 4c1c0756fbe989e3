#include "samples/crowd/truth.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace crowd {
namespace {

// A body farther away than this takes less than 1e-3 of a vertex's hemisphere.
constexpr float kFarBody_m = 15.0f;
constexpr float kGroundHalf_m = 1000.0f, g = kGroundHalf_m;
constexpr float kGround[12] = {-g, 0, -g, g, 0, -g, -g, 0, g, g, 0, g};
constexpr std::uint32_t kGroundTriangles[6] = {0, 2, 1, 1, 2, 3};

struct Body {
  std::vector<float> positions, normals;
};

// Of the first bone: near enough to tell which bodies are far.
glm::vec2 place_of(const Bones& bones) {
  return {bones[3], bones[11]};
}

// The bodies that matter to some receivers, and where among them those are.
struct Surroundings {
  Surroundings(const Hero& hero, const std::vector<Bones>& poses, std::span<const std::uint32_t> receivers)
      : body_of(poses.size(), 0) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool near = std::ranges::any_of(receivers, [&](std::uint32_t r) {
        return glm::length(place_of(poses[i]) - place_of(poses[r])) < kFarBody_m;
      });
      if (!near) continue;
      body_of[i] = std::uint32_t(bodies.size());
      Body& body = bodies.emplace_back();
      hero.skin(poses[i], body.positions, body.normals);
    }
  }

  void add_receivers(std::span<const std::uint32_t> receivers, std::vector<float>& positions,
                     std::vector<float>& normals) const {
    for (const std::uint32_t r : receivers) {
      const Body& body = bodies[body_of[r]];
      positions.insert(positions.end(), body.positions.begin(), body.positions.end());
      normals.insert(normals.end(), body.normals.begin(), body.normals.end());
    }
  }

  std::vector<Body> bodies;
  std::vector<std::uint32_t> body_of;  // by character
};

void add_floor(const FloorPatch& patch, std::vector<float>& positions, std::vector<float>& normals) {
  const float step_m = patch.size_m / float(patch.side - 1);
  for (std::uint32_t z = 0; z < patch.side; ++z)
    for (std::uint32_t x = 0; x < patch.side; ++x) {
      positions.insert(positions.end(),
                       {patch.low_x_m + float(x) * step_m, 0, patch.low_z_m + float(z) * step_m});
      normals.insert(normals.end(), {0, 1, 0});
    }
}

// Into as many arrays of equal length.
std::vector<std::vector<float>> split(const std::vector<float>& values, std::size_t parts) {
  std::vector<std::vector<float>> pieces;
  const std::size_t length = parts ? values.size() / parts : 0;
  for (std::size_t r = 0; r < parts; ++r) {
    const auto first = values.begin() + std::ptrdiff_t(r * length);
    pieces.emplace_back(first, first + std::ptrdiff_t(length));
  }
  return pieces;
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
  add_floor(patch, positions, normals);
  return trace(meshes_of(hero, bodies), positions, normals, radius_m, request);
}

std::vector<std::vector<float>> traced_ao(const Hero& hero, const std::vector<Bones>& poses,
                                          std::span<const std::uint32_t> receivers,
                                          const TraceRequest& request) {
  const Surroundings around(hero, poses, receivers);
  std::vector<nook_bake_occluder_mesh> meshes = meshes_of(hero, around.bodies);
  if (request.ground) meshes.push_back({kGround, kGroundTriangles, 4, 6});
  std::vector<float> positions, normals;
  around.add_receivers(receivers, positions, normals);
  return split(trace(meshes, positions, normals, INFINITY, request), receivers.size());
}

TracedLight traced_light(const Hero& hero, const std::vector<Bones>& poses,
                         std::span<const std::uint32_t> receivers, const FloorPatch* patch,
                         const nook_bake_environment& environment, const TraceRequest& request) {
  const Surroundings around(hero, poses, receivers);
  std::vector<nook_bake_lit_mesh> meshes;
  const auto add_black = [&](const float* positions, const std::uint32_t* indices, std::uint32_t vertices,
                             std::uint32_t index_count) {
    meshes.push_back({positions, indices, vertices, index_count, {0, 0, 0}, {0, 0, 0}});
  };
  for (const Body& body : around.bodies)
    add_black(body.positions.data(), hero.triangles.data(), hero.vertex_count(),
              std::uint32_t(hero.triangles.size()));
  if (request.ground) add_black(kGround, kGroundTriangles, 4, 6);
  std::vector<float> positions, normals;
  around.add_receivers(receivers, positions, normals);
  if (patch) add_floor(*patch, positions, normals);

  nook_bake_irradiance_desc desc;
  bake_check(nook_bake_irradiance_desc_init(&desc, sizeof desc, NOOK_VERSION));
  desc.meshes = meshes.data();
  desc.mesh_count = std::uint32_t(meshes.size());
  desc.positions = positions.data();
  desc.normals = normals.data();
  desc.point_count = std::uint32_t(positions.size() / 3);
  desc.environment = environment;
  desc.rays = request.rays;
  desc.seed = request.seed;
  desc.max_bounces = 0;
  std::vector<float> irradiance(positions.size());
  bake_check(nook_bake_trace_irradiance(&desc, irradiance.data(), desc.point_count));

  TracedLight light;
  const std::size_t floor_begin = 3 * receivers.size() * std::size_t(hero.vertex_count());
  light.floor.assign(irradiance.begin() + std::ptrdiff_t(floor_begin), irradiance.end());
  irradiance.resize(floor_begin);
  light.bodies = split(irradiance, receivers.size());
  return light;
}

Errors compare(const Hero& hero, const std::vector<Bones>& poses, std::span<const std::uint32_t> receivers,
               const std::vector<std::vector<float>>& values, const std::vector<std::vector<float>>& truth,
               std::uint32_t channels, float unit) {
  double squares = 0, weighted_squares = 0, vertices = 0, area = 0;
  Body body;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    hero.skin(poses[receivers[r]], body.positions, body.normals);
    const std::vector<double> areas = vertex_areas(hero, body.positions);
    for (std::size_t v = 0; v < areas.size(); ++v) {
      if (areas[v] <= 0) continue;
      double square = 0;
      for (std::uint32_t c = 0; c < channels; ++c) {
        const double error =
            (double(values[r][channels * v + c]) - double(truth[r][channels * v + c])) / double(unit);
        square += error * error / channels;
      }
      squares += square;
      weighted_squares += areas[v] * square;
      vertices += 1;
      area += areas[v];
    }
  }
  return {vertices > 0 ? squares / vertices : 0, area > 0 ? weighted_squares / area : 0};
}

}  // namespace crowd
