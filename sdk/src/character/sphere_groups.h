// Merges the spheres of a caster into a few spheres, for distant receivers.
//
// At a distance d, a sphere reduces AO by mass * cos / d^2 with `mass` = weight * radius^2, where cos is the
// cosine between the receiver's normal and the direction to the sphere. This is like the field of a charge.
// If several spheres are close together as seen from the receiver, one sphere at their centre with the sum of
// their masses has almost the same effect. cos / d^2 is the field of a dipole, which is harmonic. So the
// error of a group is of second order in the extent of the group, and is 0 if the extent is the same in all
// directions. The nearest part of the receiver determines the error. Therefore two bodies whose arms cross
// use their single spheres instead of groups.
#pragma once

#include <cmath>
#include <cstdint>

#include "sdk/src/character/model.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/memory.h"

namespace nook {

inline constexpr std::uint32_t group_tiers = 3;
// Tier 0 is the finest. A group of a tier consists of whole groups of the previous tier.
inline constexpr std::uint32_t tier_groups[group_tiers] = {16, 6, 2};

// The groups of a model's spheres, which do not depend on the pose.
class SphereGroups {
 public:
  // Splits the spheres in the rest pose. Each step splits the group with the largest moment. It splits the
  // group at its centre, across its longest axis.
  explicit SphereGroups(const CharacterModel& model, Memory* memory = default_memory());

  // Group g of tier t consists of member[first[g]] up to but not including member[first[g + 1]]. For t = 0,
  // the members are spheres, otherwise groups of tier t - 1.
  struct Tier {
    AlignedArray<std::uint32_t> first, member;
    std::uint32_t count() const {
      return first.size() == 0 ? 0 : static_cast<std::uint32_t>(first.size() - 1);
    }
  };
  const Tier& tier(std::uint32_t t) const { return tiers_[t]; }

 private:
  Tier tiers_[group_tiers];
};

// The posed groups of a tier, as spheres. Each array has tier_groups[tier] entries, padded to simd_width.
struct GroupLanes {
  float *x = nullptr, *y = nullptr, *z = nullptr;
  float* inverse_radius = nullptr;  // per metre
  float* caster_weight = nullptr;
  float* moment = nullptr;  // metres^4: sum over the spheres of mass * (distance from the centre)^2
  std::uint32_t count = 0;
};

// The places at which a receiver is darkened: their bounding box, and a sample of the places, in metres. If
// there are no places, the box is empty.
struct Receiver {
  static constexpr std::uint32_t samples = 16;

  Vec3 min{INFINITY, INFINITY, INFINITY}, max{-INFINITY, -INFINITY, -INFINITY};
  float x[samples] = {}, y[samples] = {}, z[samples] = {};
  float scale = 1;  // scale of the body
};
// Takes samples from the places at equal index steps. The places must be in the order of
// with_near_key_points_together.
Receiver receiver_of(const float* x, const float* y, const float* z, std::uint32_t count, float scale);

// Merges `parts` into the groups of a tier. `parts` are the posed spheres, or the groups of the previous
// tier. A group gets the mass and centre of its parts. Its radius is chosen so that it has the same spread as
// its parts. A disc of radius r has the spread r^2 / 4 along each of its axes. part_moments are the moments
// of the groups of the previous tier, or null for spheres. The moment of a group is computed from the pose.
// So a group whose parts have moved apart in the pose has a large moment and is not used near the receiver.
void merge_groups(const SphereGroups::Tier& tier, const SphereSoa& parts, const float* part_moments,
                  const GroupLanes& out);

// Estimates the RMS error in AO that the groups cause over a receiver. Returns infinity if the centre of a
// group of several spheres lies in the receiver's box. The largest second derivative of cos / d^2 is 6 / d^4,
// so the error is at most half of 6 * moment / d^4. Half of the receiver faces away, and the mean square of
// cos over the other half is 1/3, which gives 1.2 * moment / d^4. The result is the mean over the samples,
// but at least 1/16 of the estimate for the nearest point of the box, because the samples can miss a part
// that is near, such as an arm.
float group_error(const GroupLanes& groups, const Receiver& receiver);

}  // namespace nook
