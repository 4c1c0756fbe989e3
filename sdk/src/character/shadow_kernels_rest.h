// The spheres and key points of a character model, in the layout that the pose kernels need.
#pragma once

#include <cstdint>

#include "sdk/src/character/model.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/memory.h"

namespace nook {

class RestSpheres {
 public:
  // Throws Failure if a sphere has a bone that is not in the model.
  explicit RestSpheres(const CharacterModel& model, Memory* memory = default_memory());

  const RestSphereView& view() const { return view_; }
  // Returns SphereSoa::caster_weight, which does not depend on the pose.
  const float* caster_weight() const { return caster_weight_; }

 private:
  AlignedArray<float> numbers_;
  AlignedArray<std::uint16_t> bone_;
  const float* caster_weight_ = nullptr;
  RestSphereView view_;
};

// Key points, padded to key_point_group with copies of the last one.
class RestKeyPoints {
 public:
  // Throws Failure if a key point has a bone that is not in the model.
  explicit RestKeyPoints(const CharacterModel& model, Memory* memory = default_memory());

  const RestKeyPointView& view() const { return view_; }
  std::uint32_t padded_count() const { return view_.padded_count; }

 private:
  AlignedArray<float> numbers_;
  AlignedArray<std::uint16_t> bone_;
  AlignedArray<float> weight_;
  RestKeyPointView view_;
};

}  // namespace nook
