// The occluded directions of a model's vertices (sdk/src/character/bent_normal.h), fitted to ray tracing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/bent_normal.h"

namespace nook::bake {

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
