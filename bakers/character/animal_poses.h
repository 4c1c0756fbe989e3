// Makes poses for bodies that are not human. Any number of legs can walk with planted feet. Spines, necks and
// tails bend as chains. Jaws and wings turn like hinges. The ranges of motion depend on the lengths of the
// limbs and on their bends in the rest pose.
#pragma once

#include <span>
#include <vector>

#include "bakers/character/body_plan.h"
#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

// What a body does in one pose. At rest or in a gait (walk or trot), its feet are planted. In a leap, such as
// a gallop or a jump, the legs swing from the hips. In a free pose, each part moves independently. Rest and
// gait have large shares, because game characters stand or walk most of the time.
enum class AnimalAct : std::uint8_t { rest, gait, leap, free };
constexpr float rest_share = 0.3f, gait_share = 0.25f, leap_share = 0.25f;
AnimalAct random_act(PoseRandom& random);

// One leg: the joints from the hip to the end of the leg, which stands on the ground in the rest pose.
struct LegChain {
  std::vector<std::size_t> bones;  // from the hip; without the foot
  std::vector<std::size_t> foot;
  Vec3 end;  // end of the last bone: the foot's joint, or the lowest skin; metres, rest space
  float length_m = 0;
  int row = 0;  // index of the pair of legs, counted from the front
  bool left = false;
};

class AnimalRig {
 public:
  // Keeps references to both arguments.
  AnimalRig(const SkinnedMesh& mesh, std::span<const Joint> joints);

  Pose pose(AnimalAct act, PoseRandom& random) const;
  std::span<const LegChain> legs() const { return legs_; }

  // Returns the turns of a leg's bones, from the hip on, that bring the end of the leg to `place`. `place` is
  // in the space of the hip's parent at rest. If `place` is out of reach, the leg stretches towards it.
  // bend_share contains a factor for the bend of each joint after the hip. If it has too few factors, the
  // remaining joints have the factor 1.
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
  float neck_reach_ = 0;  // the pitch of the neck that brings the head to the ground, radians
  float size_m_ = 0;      // size of the body: the mean length of its legs, or half its height if it has none
};

}  // namespace nook::bake
