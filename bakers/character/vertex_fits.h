// Fits per-vertex values for an existing model.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/bent_normal.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Fits the linear layer of a model for another mesh of the same rig, such as a level of detail. Only the
// weights of each vertex are fitted, to ray tracing of the other mesh, so that AO matches the shape of that
// mesh. Spheres, key points, levels and casters do not change.

struct RefitSettings {
  std::uint32_t rays = 128;  // per vertex and pose
  std::uint64_t seed = 1;
};

// The mesh must have the bones of the model, in the same order. Each pose must have one matrix per bone. The
// result has the mesh's welded vertices. The caller must set the bind data and the rest surface. Throws
// Failure(NOOK_ERROR_CANCELLED) if progress returns false.
CharacterModel refit_vertices(const CharacterModel& model, const SkinnedMesh& mesh,
                              std::span<const Pose> poses, const RefitSettings& settings,
                              const Progress& progress = {});

// Fits the occluded directions of a model's vertices (sdk/src/character/bent_normal.h) to ray tracing.

struct OccludedFitSettings {
  std::uint32_t rays = 128;  // per vertex and pose
  std::uint64_t seed = 1;
};

// The AO and the occluded direction of each welded vertex in one pose. The direction is turned back to rest
// space by the inverse of the vertex's blended bone matrix.
struct OccludedSample {
  std::vector<float> ao;
  std::vector<Vec3> occluded;
};
OccludedSample trace_occluded(const SkinnedMesh& mesh, const Pose& pose, const OccludedFitSettings& settings);

// Fits the occluded direction of one vertex as a linear function of AO, by least squares. Two known
// observations with a small weight keep the line stable where AO hardly changes. At AO 1, nothing is
// occluded, so the direction is 0. At AO 0, everything is occluded, so the direction is 2/3 of the normal.
class OccludedLine {
 public:
  void add(float ao, Vec3 occluded, double weight = 1);
  OccludedEnds ends(Vec3 normal_rest) const;

 private:
  double dark_dark_ = 0, dark_open_ = 0, open_open_ = 0;  // sums of the normal equations
  double dark_[3] = {}, open_[3] = {};
};

// For each welded vertex, returns the values at both ends of the line (AO 0 and 1). The same seed gives the
// same bits on any number of threads. Throws Failure: INVALID_ARGUMENT (no poses), CANCELLED.
std::vector<OccludedEnds> fit_occluded(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                       const OccludedFitSettings& settings, const Progress& progress = {});

}  // namespace nook::bake
