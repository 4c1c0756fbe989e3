// The model before the fit (Le et al. 2019, appendix B): proxy spheres along each bone's flesh, key points by
// clustering.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/fit_state.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

struct InitialSphere {
  Vec3 centre;  // rest space, metres
  float radius = 0;
  std::uint16_t bone = 0;
};

// Eigen-analysis of the geometry each bone moves, weighted by skin weight and Voronoi area: spheres of radius
// sqrt(l1) spread along the major axis, about sqrt(l3 / l1) of them; the numbers are scaled so that all bones
// together get at most `sphere_count`, each bone with geometry at least one while they last (largest area
// first).
std::vector<InitialSphere> initial_spheres(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                           std::size_t sphere_count);

// Unit vectors from each vertex's optimised centre of rotation (Le & Hodgins 2016, with the Gaussian weight
// similarity of appendix B) to the vertex; where they coincide, the mesh normal.
std::vector<Vec3> centre_of_rotation_normals(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                             std::span<const Vec3> mesh_normal);

// The weights by which key points are placed: those given times the variance of each vertex' AO
// over the first `poses` rows of the targets, over its mean. What never changes needs no key point of its
// own: a constant holds it.
std::vector<float> placement_weights(std::span<const float> vertex_weight, const AoTargets& targets,
                                     std::size_t poses);

struct ClusterSettings {
  std::size_t count = 500;
  float position_scale = 1;  // of a feature of about unit size over a tenth of the body's height
  float normal_scale = 0.7f;
  float weight_scale = 1.0f;
};

// Edge-collapse clustering of the vertices (Schaefer & Yuksel 2007) in the space of position, normal and skin
// weights, over mesh edges and extra edges between near vertices with near weights. Returns the cluster of
// each vertex; the number of clusters is settings.count, or fewer when the mesh has fewer vertices, or more
// when that many parts never touch.
std::vector<std::uint32_t> cluster_vertices(const SkinnedMesh& mesh, std::span<const float> vertex_weight,
                                            std::span<const Vec3> normal, const ClusterSettings& settings);

// One key point a cluster: mean position, normal and skin weights (the four largest).
std::vector<KeyPoint> key_points_of_clusters(const SkinnedMesh& mesh, std::span<const std::uint32_t> cluster,
                                             std::span<const float> vertex_weight,
                                             std::span<const Vec3> normal);

// Packs spheres and key points into a structure and its parameter vector; the linear layer is left empty.
FitState initial_state(const Kernel& kernel, std::span<const InitialSphere> spheres,
                       std::span<const KeyPoint> key_points);

// For each vertex the `count` key points nearest to it in position, normal and skin weights, with their
// nearness.
struct NearKeyPoints {
  std::vector<std::uint16_t> key_point;  // vertices x count, nearest first
  std::vector<float> nearness;           // the same: 1 at distance 0, falling with the squared distance
};
NearKeyPoints nearest_key_points(const SkinnedMesh& mesh, std::span<const Vec3> normal,
                                 std::span<const KeyPoint> key_points, std::size_t count);

}  // namespace nook::bake
