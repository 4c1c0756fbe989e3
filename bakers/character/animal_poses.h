// Poses of a body that is not a person's: gaits of any number of legs with planted feet, spines, necks and
// tails as chains, jaws and wings as hinges. Ranges follow from the lengths of limbs and their bends at rest.
#pragma once

#include <span>
#include <vector>

#include "bakers/character/body_plan.h"
#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

// What a body does in one pose. It rests, or it walks or trots with planted feet. In a leap, as in a gallop
// or a jump, the legs swing from the hips. Free bodies move each part by itself. Games show characters that
// stand or walk most of the time.
enum class AnimalAct : std::uint8_t { rest, gait, leap, free };
constexpr float rest_share = 0.3f, gait_share = 0.25f, leap_share = 0.25f;
AnimalAct random_act(PoseRandom& random);

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

  Pose pose(AnimalAct act, PoseRandom& random) const;
  std::span<const LegChain> legs() const { return legs_; }

  // The turns of a leg's bones, of which the first is its hip, that bring its end to a place. In the space of
  // the hip's parent at rest. A place out of reach is approached as far as the leg stretches.
  // bend_share: how much more each joint behind the hip bends than the others, 1 where the span has none.
  std::vector<Mat3x4> reach(const LegChain& leg, Vec3 place, std::span<const float> bend_share = {}) const;

 private:
  struct FootPlan;
  struct Plan;
  void find_legs();
  void find_chains();
  Plan draw(AnimalAct act, PoseRandom& random) const;
  void place_feet(Plan& plan, PoseRandom& random) const;
  void stand(Plan& plan, PoseRandom& random) const;
  void step(Plan& plan, PoseRandom& random) const;
  void leap(Plan& plan, PoseRandom& random) const;
  void move_feet(Plan& plan, PoseRandom& random) const;
  void swing_legs(Plan& plan, PoseRandom& random) const;
  Vec3 swung(const LegChain& leg, float forward, float aside, float stretch) const;
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
