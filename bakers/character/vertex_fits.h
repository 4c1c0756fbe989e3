// Values of vertices that are fitted for a model that exists already.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/bent_normal.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// The linear layer of a model for another mesh of the same rig, such as a level of detail. Spheres, key
// points, levels and casters stay: only what each vertex makes of the key points' shadows is fitted, to ray
// tracing of the other mesh, so that the AO follows its own shape.

struct RefitSettings {
  std::uint32_t rays = 128;  // for each vertex and pose
  std::uint64_t seed = 1;
};

// The mesh has the bones of the model, in the same order, and one matrix a bone in each pose. The result has
// the mesh's welded vertices; bind data and the rest surface are the caller's to set. Throws
// Failure(NOOK_ERROR_CANCELLED) if progress returns false.
CharacterModel refit_vertices(const CharacterModel& model, const SkinnedMesh& mesh,
                              std::span<const Pose> poses, const RefitSettings& settings,
                              const Progress& progress = {});

// The occluded directions of a model's vertices (sdk/src/character/bent_normal.h), fitted to ray tracing.

struct OccludedFitSettings {
  std::uint32_t rays = 128;  // for each vertex and pose
  std::uint64_t seed = 1;
};

// A pose as observations of each welded vertex: its AO, and its occluded direction turned back to rest space
// by the vertex' own blend of bones.
struct OccludedSample {
  std::vector<float> ao;
  std::vector<Vec3> occluded;
};
OccludedSample trace_occluded(const SkinnedMesh& mesh, const Pose& pose, const OccludedFitSettings& settings);

// The line over AO that is nearest to the observations of one vertex, in least squares. Two more observations
// of a small weight keep it where AO hardly changes: nothing is occluded at AO 1, and at AO 0 everything is,
// which is 2/3 of the normal.
class OccludedLine {
 public:
  void add(float ao, Vec3 occluded, double weight = 1);
  OccludedEnds ends(Vec3 normal_rest) const;

 private:
  double dark_dark_ = 0, dark_open_ = 0, open_open_ = 0;  // of the normal equations
  double dark_[3] = {}, open_[3] = {};
};

// Both ends of each welded vertex. The same seed gives the same bits on any number of threads. Throws
// Failure: INVALID_ARGUMENT (no poses), CANCELLED.
std::vector<OccludedEnds> fit_occluded(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                       const OccludedFitSettings& settings, const Progress& progress = {});

}  // namespace nook::bake
