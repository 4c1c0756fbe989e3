// Poses of a body that is not a person's: gaits of any number of legs with planted feet, spines, necks and
// tails as chains, jaws and wings as hinges. Ranges follow from the lengths of limbs and their bends at rest.
#pragma once

#include <span>
#include <vector>

#include "bakers/character/body_plan.h"
#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

// The act of a body in one pose. Games show characters that stand or walk most of the time. So a third of all
// poses rest and a third walk or run. The last third shows the other acts of the body.
enum class AnimalAct : std::uint8_t { rest, gait, free };
constexpr float rest_share = 0.35f, gait_share = 0.35f;

// One leg: joints from the hip to its end, which stands on the ground at rest.
struct LegChain {
  std::vector<std::size_t> bones;  // from the hip; without the foot
  std::vector<std::size_t> foot;
  Vec3 end;  // of the last bone: the foot's joint, or the lowest skin; metres, rest space
  float length_m = 0;
  int row = 0;  // pairs of legs from the front
  bool left = false;
};

class AnimalRig {
 public:
  // Both are kept by reference.
  AnimalRig(const SkinnedMesh& mesh, std::span<const Joint> joints);

  Pose pose(PoseRandom& random) const;
  std::span<const LegChain> legs() const { return legs_; }

  // The turns of a leg's bones, of which the first is its hip, that bring its end to a place. In the space of
  // the hip's parent at rest. A place out of reach is approached as far as the leg stretches.
  std::vector<Mat3x4> reach(const LegChain& leg, Vec3 place) const;

 private:
  struct Plan;
  void find_legs();
  void find_chains();
  Plan draw(PoseRandom& random) const;
  void place_feet(Plan& plan, PoseRandom& random) const;
  void bend_chains(const Plan& plan, std::vector<Mat3x4>& local, PoseRandom& random) const;
  void turn_others(const Plan& plan, std::vector<Mat3x4>& local, PoseRandom& random) const;
  Vec3 in_body(Vec3 v) const { return v.x * frame_.left + v.y * frame_.up + v.z * frame_.forward; }
  Vec3 origin(std::size_t b) const { return joint_origin(mesh_.bones[b]); }

  const SkinnedMesh& mesh_;
  std::span<const Joint> joints_;
  BodyTree tree_;
  BodyFrame frame_;
  std::vector<char> posable_;
  std::vector<LegChain> legs_;
  std::vector<std::vector<std::size_t>> spines_, necks_, tails_;
  float neck_reach_ = 0;  // the pitch that brings the head to the ground, radians
  float size_m_ = 0;      // of the body: the mean length of legs, or half its height
};

}  // namespace nook::bake
