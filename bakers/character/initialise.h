// Makes the model that the fit starts from (Le et al. 2019, appendix B): proxy spheres along the flesh of
// each bone, and key points by clustering.
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

// Places spheres by an eigen-analysis of the vertices that each bone moves, weighted by skin weight and
// Voronoi area. A bone gets about sqrt(l3 / l1) spheres of radius sqrt(l1) along its longest axis (l1 is the
// smallest eigenvalue, l3 the largest). The counts are scaled so that all bones together get at most
// `sphere_count` spheres. Each bone with vertices gets at least one sphere. If there are more such bones than
// spheres, only the bones with the largest areas get one.
std::vector<InitialSphere> initial_spheres(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                           std::size_t sphere_count);

// Returns unit vectors from each vertex's optimised centre of rotation to the vertex (Le & Hodgins 2016, with
// the Gaussian weight similarity of appendix B). If the centre of rotation is at the vertex, returns the mesh
// normal.
std::vector<Vec3> centre_of_rotation_normals(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                             std::span<const Vec3> mesh_normal);

// Returns the weights for placing key points. Each is the given weight times the vertex's AO variance over
// the first `poses` rows of the targets, relative to the mean variance. AO that never changes needs no key
// point, because the bias represents it.
std::vector<float> placement_weights(std::span<const float> vertex_weight, const AoTargets& targets,
                                     std::size_t poses);

struct ClusterSettings {
  std::size_t count = 500;
  float position_scale = 1;  // factor for positions, such that a tenth of the body's height is about 1
  float normal_scale = 0.7f;
  float weight_scale = 1.0f;
};

// Clusters the vertices by edge collapse (Schaefer & Yuksel 2007) in the space of position, normal and skin
// weights. The edges are the mesh edges, plus edges between near vertices with similar weights. Returns the
// cluster of each vertex. The result has settings.count clusters. It has fewer if the mesh has fewer
// vertices, and more if the mesh has more unconnected parts.
std::vector<std::uint32_t> cluster_vertices(const SkinnedMesh& mesh, std::span<const float> vertex_weight,
                                            std::span<const Vec3> normal, const ClusterSettings& settings);

// Returns one key point per cluster: the mean position, the mean normal and the four largest mean skin
// weights.
std::vector<KeyPoint> key_points_of_clusters(const SkinnedMesh& mesh, std::span<const std::uint32_t> cluster,
                                             std::span<const float> vertex_weight,
                                             std::span<const Vec3> normal);

// Packs spheres and key points into a structure and its parameter vector. Leaves the linear layer empty.
FitState initial_state(const Kernel& kernel, std::span<const InitialSphere> spheres,
                       std::span<const KeyPoint> key_points);

// The `count` key points nearest to each vertex in position, normal and skin weights.
struct NearKeyPoints {
  std::vector<std::uint16_t> key_point;  // vertices x count, nearest first
  std::vector<float> nearness;           // same shape; 1 at distance 0, falls with the squared distance
};
NearKeyPoints nearest_key_points(const SkinnedMesh& mesh, std::span<const Vec3> normal,
                                 std::span<const KeyPoint> key_points, std::size_t count);

}  // namespace nook::bake
