#include "bakers/character/animal_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "bakers/character/pose_sets.h"
#include "bakers/character/rotation.h"

namespace nook::bake {

// Where a leg ends in a pose, and how its foot is oriented there.
struct AnimalRig::FootPlan {
  Vec3 place;          // metres, rest space
  bool hangs = false;  // true if `place` is in the space of the hip's parent, so that it moves with the body
  float planted = 1;   // 1: the foot keeps its direction in the world; 0: the foot turns with the leg
  float curl = 0;      // backward bend of the foot, radians
  // Factor for the bend of each joint after the hip. If empty, all factors are 1.
  std::vector<float> bend_share = {};
};

struct AnimalRig::Plan {
  AnimalAct act = AnimalAct::rest;
  float amount = 1;            // factor for all joint turns; small if the animal rests
  Mat3x4 body;                 // motion of the whole body relative to its feet
  std::vector<FootPlan> foot;  // one for each leg
  float phase = 0;             // phase of the gait, 0 to 1
  float gallop = 0;            // bend of the spine that follows the gait, radians
};

namespace {

float ground_of(const SkinnedMesh& mesh) {
  float low = INFINITY;
  for (const Vec3 p : mesh.position) low = std::min(low, p.y);
  return std::isfinite(low) ? low : 0;
}

float height_of(const SkinnedMesh& mesh) {
  float high = -INFINITY;
  for (const Vec3 p : mesh.position) high = std::max(high, p.y);
  return std::isfinite(high) ? high - ground_of(mesh) : 0;
}

// Returns the centre of the lowest fifth of a bone's skin, or the joint's origin if the bone has no skin.
Vec3 lowest_skin(const SkinnedMesh& mesh, std::size_t bone) {
  float low = INFINITY, high = -INFINITY;
  const auto is_own = [&](std::size_t i) { return mesh.weights[i].bone[0] == bone; };
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
    if (is_own(i)) {
      low = std::min(low, mesh.position[i].y);
      high = std::max(high, mesh.position[i].y);
    }
  Vec3 sum;
  float count = 0;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
    if (is_own(i) && mesh.position[i].y <= low + 0.2f * (high - low)) {
      sum += mesh.position[i];
      ++count;
    }
  return count > 0 ? (1 / count) * sum : joint_origin(mesh.bones[bone]);
}

// Returns the chains of bones with one of the given roles. Each chain runs from parents to children. At a
// fork, the longest branch continues the chain, and each other branch starts a new chain.
std::vector<std::vector<std::size_t>> chains_of(const BodyTree& tree, std::span<const Joint> joints,
                                                std::initializer_list<JointRole> roles) {
  const auto is_in = [&](std::size_t b) {
    return std::find(roles.begin(), roles.end(), joints[b].role) != roles.end();
  };
  std::vector<int> reach(joints.size(), 0);
  std::vector<std::int32_t> next(joints.size(), -1);
  for (std::size_t i = tree.order.size(); i-- > 0;) {
    const std::uint32_t b = tree.order[i];
    const std::int32_t p = tree.parent[b];
    if (!is_in(b) || p < 0 || !is_in(std::size_t(p)) || reach[b] + 1 <= reach[std::size_t(p)]) continue;
    reach[std::size_t(p)] = reach[b] + 1;
    next[std::size_t(p)] = std::int32_t(b);
  }
  std::vector<std::vector<std::size_t>> chains;
  for (const std::uint32_t b : tree.order) {
    const std::int32_t p = tree.parent[b];
    if (!is_in(b) || (p >= 0 && is_in(std::size_t(p)) && next[std::size_t(p)] == std::int32_t(b))) continue;
    chains.emplace_back();
    for (std::int32_t at = std::int32_t(b); at >= 0; at = next[std::size_t(at)])
      chains.back().push_back(std::size_t(at));
  }
  return chains;
}

}  // namespace

AnimalRig::AnimalRig(const SkinnedMesh& mesh, std::span<const Joint> joints)
    : mesh_(mesh),
      joints_(joints),
      tree_(body_tree(mesh, joints)),
      frame_(body_frame(mesh, joints)),
      posable_(mesh.bones.size(), 0) {
  for (const std::uint32_t b : posable_joints(mesh)) posable_[b] = 1;
  find_legs();
  find_chains();
}

void AnimalRig::find_legs() {
  std::map<std::int32_t, LegChain> legs;
  for (const std::uint32_t b : tree_.order) {
    const Joint& joint = joints_[b];
    if (joint.limb < 0 || (joint.role != JointRole::leg && joint.role != JointRole::foot)) continue;
    LegChain& leg = legs[joint.limb];
    const auto& above = leg.foot.empty() ? leg.bones : leg.foot;
    if (!above.empty() && !is_below(tree_, b, above.back())) continue;
    (joint.role == JointRole::leg && leg.foot.empty() ? leg.bones : leg.foot).push_back(b);
  }
  for (auto& [number, leg] : legs) {
    if (leg.bones.empty() || leg.bones.size() + leg.foot.size() < 2) continue;
    leg.end = leg.foot.empty() ? lowest_skin(mesh_, leg.bones.back()) : origin(leg.foot.front());
    leg.left = joints_[leg.bones.front()].side != Side::right;
    for (std::size_t i = 0; i + 1 < leg.bones.size(); ++i)
      leg.length_m += length(origin(leg.bones[i + 1]) - origin(leg.bones[i]));
    leg.length_m += length(leg.end - origin(leg.bones.back()));
    size_m_ += leg.length_m;
    legs_.push_back(std::move(leg));
  }
  // Numbers the legs of each side from the front. Gaits use these numbers to choose the phase of a leg.
  for (LegChain& leg : legs_)
    for (const LegChain& other : legs_)
      leg.row += other.left == leg.left && dot(other.end - leg.end, frame_.forward) > 0;
  size_m_ = legs_.empty() ? 0.5f * height_of(mesh_) : size_m_ / float(legs_.size());
}

void AnimalRig::find_chains() {
  spines_ = chains_of(tree_, joints_, {JointRole::spine});
  necks_ = chains_of(tree_, joints_, {JointRole::neck, JointRole::head});
  tails_ = chains_of(tree_, joints_, {JointRole::tail});
  for (const auto& neck : necks_) {
    const Vec3 root = origin(neck.front());
    Vec3 end = lowest_skin(mesh_, neck.back());
    const float reach = length(end - root), down = root.y - ground_of(mesh_);
    if (reach <= 0) continue;
    const float now = std::asin(std::clamp((end.y - root.y) / reach, -1.0f, 1.0f));
    const float ground = -std::asin(std::clamp(down / reach, -1.0f, 1.0f));
    neck_reach_ = std::max(neck_reach_, std::clamp(now - ground, 0.0f, 110 * degree));
  }
}

namespace {

// Returns the phase of a leg in a gait with planted feet. Four legs walk or trot. Two legs alternate. With
// more legs, groups of legs such as tripods move together. Neighbouring legs never move at the same time.
float leg_phase(const LegChain& leg, std::size_t legs, bool trots) {
  const float side = leg.left ? 0.0f : 0.5f;
  if (legs != 4) return std::fmod(side + 0.5f * float(leg.row % 2), 1.0f);
  const bool hind = leg.row > 0;
  // A walk has the order left hind, left fore, right hind, right fore. In a trot, diagonal legs move
  // together.
  return std::fmod(side + (trots ? (hind ? 0.5f : 0.0f) : (hind ? 0.0f : 0.25f)), 1.0f);
}

// `along` is the position of a foot along its stride, from -1 (behind) to 1 (ahead). `lift` is 0 to 1.
struct Step {
  float along = 0, lift = 0;
};
Step step_at(float phase, float stance) {
  if (phase < stance) return {1 - 2 * phase / stance, 0};
  const float swing = (phase - stance) / (1 - stance);
  return {-std::cos(std::numbers::pi_v<float> * swing), std::sin(std::numbers::pi_v<float> * swing)};
}

// Returns a random angle for a joint, in radians. Most angles are small, but a few are large.
float heavy_turn(PoseRandom& random, float usual, float most) {
  const float turn = usual * random.normal();
  return std::clamp(turn * std::exp(0.4f * random.normal()), -most, most);
}

}  // namespace

AnimalAct random_act(PoseRandom& random) {
  const float kind = random.unit();
  if (kind < rest_share) return AnimalAct::rest;
  if (kind < rest_share + gait_share) return AnimalAct::gait;
  return kind < rest_share + gait_share + leap_share ? AnimalAct::leap : AnimalAct::free;
}

AnimalRig::Plan AnimalRig::draw(AnimalAct act, PoseRandom& random) const {
  Plan plan;
  plan.act = act;
  plan.amount = plan.act == AnimalAct::rest ? 0.35f : plan.act == AnimalAct::gait ? 0.8f : 1.0f;
  plan.phase = random.unit();
  const float loose = plan.amount;
  const Vec3 turn = in_body({5 * degree * loose * random.normal(), 4 * degree * loose * random.normal(),
                             3 * degree * loose * random.normal()});
  const float drop = plan.act == AnimalAct::free && random.chance(0.3f) ? random.between(0, 0.35f)
                                                                        : 0.03f * loose * random.normal();
  Vec3 middle;
  for (const LegChain& leg : legs_) middle += (1 / float(legs_.size())) * origin(leg.bones.front());
  plan.body = rotation_about(middle, turn);
  plan.body.m[7] -= drop * size_m_;
  place_feet(plan, random);
  // Legs of the same row bend in the same way.
  std::map<int, std::vector<float>> bends;
  for (std::size_t l = 0; l < legs_.size(); ++l) {
    std::vector<float>& share = bends[legs_[l].row];
    while (share.size() + 1 < legs_[l].bones.size()) share.push_back(std::exp(0.4f * random.normal()));
    plan.foot[l].bend_share = share;
  }
  return plan;
}

void AnimalRig::place_feet(Plan& plan, PoseRandom& random) const {
  switch (plan.act) {
    case AnimalAct::rest:
      stand(plan, random);
      break;
    case AnimalAct::gait:
      step(plan, random);
      break;
    case AnimalAct::leap:
      leap(plan, random);
      break;
    case AnimalAct::free:
      random.chance(0.5f) ? move_feet(plan, random) : swing_legs(plan, random);
      break;
  }
}

void AnimalRig::stand(Plan& plan, PoseRandom& random) const {
  for (const LegChain& leg : legs_) {
    Vec3 move = in_body({0.02f * random.normal(), 0, 0.05f * random.normal()});
    if (random.chance(0.08f)) move.y += random.between(0, 0.08f);  // the leg is lifted a little
    plan.foot.push_back({leg.end + leg.length_m * move});
  }
}

void AnimalRig::step(Plan& plan, PoseRandom& random) const {
  const bool trots = legs_.size() == 4 && random.chance(0.5f);
  const bool runs = trots || random.chance(0.4f);
  const float stride = runs ? random.between(0.2f, 0.75f) : random.between(0.12f, 0.45f);
  const float rise = runs ? random.between(0.1f, 0.5f) : random.between(0.06f, 0.3f);
  // A foot that leaves the ground turns backwards. Paws and fetlocks turn much farther than heels.
  const float curl = random.between(15, 130) * degree;
  const float stance = runs ? random.between(0.3f, 0.5f) : random.between(0.55f, 0.75f);
  for (const LegChain& leg : legs_) {
    const float phase = plan.phase + leg_phase(leg, legs_.size(), trots) + 0.03f * random.normal();
    const Step at = step_at(phase - std::floor(phase), stance);
    const Vec3 move = in_body({0.02f * random.normal(), rise * at.lift, stride * at.along});
    plan.foot.push_back({leg.end + leg.length_m * move, false, 1 - at.lift, at.lift * curl});
  }
}

// Returns the position of a leg's end after the leg swings from its hip. `forward` and `aside` are the angles
// in radians by which the leg swings to the front and away from the body. `stretch` is the leg's length
// divided by its length at rest.
Vec3 AnimalRig::swung(const LegChain& leg, float forward, float aside, float stretch) const {
  const Vec3 hip = origin(leg.bones.front());
  const float mirror = leg.left ? 1.0f : -1.0f;
  const Mat3x4 turn =
      rotation_about({}, mirror * aside * frame_.forward) * rotation_about({}, -forward * frame_.left);
  return hip + stretch * transform_vector(turn, leg.end - hip);
}

// Makes gallops, bounds, runs and jumps. Legs swing from the hips, and all feet may be in the air. In a
// gallop, hind and fore legs swing in opposite directions, and the spine bends with them. When hind and fore
// legs come together, some animals bend the spine up and others bend it down. A leg that swings forwards is
// bent. A leg that swings backwards is stretched.
void AnimalRig::leap(Plan& plan, PoseRandom& random) const {
  const float amplitude = random.between(20, 65) * degree;
  const float bent = random.between(0.05f, 0.45f);
  const float curl = random.between(0, 130) * degree;
  const float lead = random.between(-0.15f, 0.15f);
  const bool gallops = legs_.size() == 4;
  const float apart = gallops ? 0.5f + 0.06f * random.normal() : 0.5f;
  for (const LegChain& leg : legs_) {
    const float row = gallops ? apart * float(leg.row == 0) : apart * float(leg.row % 2);
    const float side = gallops ? (leg.left ? 0 : lead) : (leg.left ? 0 : 0.5f);
    const float angle = 2 * std::numbers::pi_v<float> * (plan.phase + row + side + 0.03f * random.normal());
    const float forward = amplitude * std::cos(angle) + 8 * degree * random.normal();
    const float air = std::max(0.0f, -std::sin(angle));  // greater than 0 while the leg swings forwards
    const float stretch = 1.1f - bent * air - 0.1f * random.unit();
    plan.foot.push_back({swung(leg, forward, 4 * degree * random.normal(), stretch), true, 0.0f,
                         (0.25f + 0.75f * air) * curl});
  }
  if (gallops)
    plan.gallop =
        random.between(-0.3f, 0.5f) * amplitude * std::cos(2 * std::numbers::pi_v<float> * plan.phase);
}

// Makes kicks and crouches. A foot may step to any place that its leg can reach while the body stands.
void AnimalRig::move_feet(Plan& plan, PoseRandom& random) const {
  const bool tucked = random.chance(0.25f);  // all legs are drawn up, as in jumps and falls
  const float curl = random.between(15, 90) * degree;
  for (const LegChain& leg : legs_) {
    const float up = tucked                ? random.between(0.1f, 0.6f)
                     : random.chance(0.3f) ? random.between(0, 0.5f)
                                           : 0.0f;
    const float along = random.chance(0.4f) ? random.between(-0.9f, 0.9f) : 0.35f * random.normal();
    const Vec3 move = in_body({0.08f * random.normal(), up, along});
    const bool lifted = up > 0;
    plan.foot.push_back(
        {leg.end + leg.length_m * move, false, lifted ? 0.0f : 1.0f, lifted ? random.unit() * curl : 0.0f});
  }
}

// Moves each leg independently to any place that it can reach from its hip.
void AnimalRig::swing_legs(Plan& plan, PoseRandom& random) const {
  for (const LegChain& leg : legs_) {
    const float forward = heavy_turn(random, 35 * degree, 80 * degree);
    const float aside = heavy_turn(random, 8 * degree, 40 * degree);
    const float stretch = 1.05f - 0.5f * random.unit() * random.unit();
    plan.foot.push_back({swung(leg, forward, aside, stretch), true, 0.0f, random.between(-20, 110) * degree});
  }
}

namespace {

struct Bends {
  std::vector<Vec3> axis;    // for each joint after the hip; a positive turn about it bends the leg further
  std::vector<float> angle;  // for each joint after the hip, the bend at rest, radians
};

// A joint that is bent at rest bends further in the same direction. A joint that is straight at rest bends
// like a knee: the lower part swings backwards.
Bends bends_of(std::span<const Vec3> points, Vec3 left) {
  constexpr float least_bend = 0.05f;  // radians
  Bends bends;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3 in = normalised(points[i] - points[i - 1]), out = normalised(points[i + 1] - points[i]);
    const Vec3 turn = cross(in, out);
    const float angle = std::atan2(length(turn), dot(in, out));
    bends.axis.push_back(angle > least_bend ? normalised(turn) : left);
    bends.angle.push_back(angle > least_bend ? angle : 0);
  }
  return bends;
}

// Returns the turns of all joints after the hip for a leg that is bent by `flexion` radians per joint. A
// negative flexion stretches the leg. Each joint keeps at least a tenth of its rest bend, so that a stretched
// leg does not bend in the wrong direction.
std::vector<Mat3x4> flexed(std::span<const Vec3> points, const Bends& bends, float flexion,
                           std::span<const float> share) {
  std::vector<Mat3x4> turns;
  for (std::size_t i = 0; i < bends.axis.size(); ++i) {
    const float own = i < share.size() ? share[i] * flexion : flexion;
    const float angle = std::max(own, -0.9f * bends.angle[i]);
    turns.push_back(rotation_about(points[i + 1], angle * bends.axis[i]));
  }
  return turns;
}

Vec3 end_of(std::span<const Vec3> points, std::span<const Mat3x4> turns) {
  Vec3 end = points.back();
  for (std::size_t i = turns.size(); i-- > 0;) end = transform_point(turns[i], end);
  return end;
}

}  // namespace

std::vector<Mat3x4> AnimalRig::reach(const LegChain& leg, Vec3 place,
                                     std::span<const float> bend_share) const {
  constexpr float most_flexion = 1.6f, most_stretch = -1.6f;  // radians per joint
  constexpr int halvings = 24;
  std::vector<Vec3> points;
  for (const std::size_t b : leg.bones) points.push_back(origin(b));
  points.push_back(leg.end);
  // A shoulder blade is a short bone at the top of a leg with at least three bones. When the leg swings, the
  // shoulder blade makes a part of the turn.
  constexpr float girdle_share = 0.25f;
  const bool girdle = leg.bones.size() >= 3 && length(points[1] - points[0]) < 0.3f * leg.length_m;
  Mat3x4 first;
  if (girdle) {
    const Vec3 from = normalised(points.back() - points[0]), to = normalised(place - points[0]);
    first = rotation_about(points[0], girdle_share * shortest_arc(from, to));
    place = transform_point(inverse_rigid(first), place);
  }
  const std::span<const Vec3> own = std::span(points).subspan(girdle ? 1 : 0);
  const Bends bends = bends_of(own, frame_.left);
  const float wanted = length(place - own[0]);
  float low = most_stretch, high = most_flexion;  // flexions at which the leg is longest and shortest
  for (int i = 0; i < halvings; ++i) {
    const float middle = 0.5f * (low + high);
    (length(end_of(own, flexed(own, bends, middle, bend_share)) - own[0]) > wanted ? low : high) = middle;
  }
  const std::vector<Mat3x4> turns = flexed(own, bends, 0.5f * (low + high), bend_share);
  const Vec3 end = end_of(own, turns);
  std::vector<Mat3x4> all;
  if (girdle) all.push_back(first);
  all.push_back(rotation_about(own[0], shortest_arc(normalised(end - own[0]), normalised(place - own[0]))));
  all.insert(all.end(), turns.begin(), turns.end());
  return all;
}

// Bends each chain as a whole, and adds small random turns to its joints.
void AnimalRig::bend_chains(const Plan& plan, std::vector<Mat3x4>& local, PoseRandom& random) const {
  const auto bend = [&](const std::vector<std::size_t>& chain, Vec3 whole, Vec3 curl, float jitter) {
    const float share = 1 / float(chain.size());
    for (std::size_t i = 0; i < chain.size(); ++i) {
      // `curl` has opposite signs at the root and at the end. Together with `whole`, it can give a chain an S
      // shape.
      const float at = chain.size() > 1 ? float(i) * 2 / float(chain.size() - 1) - 1 : 0;
      const Vec3 turn = share * whole + share * at * curl + jitter * std::sqrt(share) * normal3(random);
      if (posable_[chain[i]]) local[chain[i]] = rotation_about(origin(chain[i]), turn);
    }
  };
  const float a = plan.amount;
  const float snake = legs_.empty() ? 3.0f : 1.0f;  // bodies without legs bend their spine much more
  for (const auto& spine : spines_)
    bend(spine,
         in_body({(a * snake * 10 * random.normal()) * degree + plan.gallop,
                  a * snake * 10 * degree * random.normal(), a * 5 * degree * random.normal()}),
         in_body({a * snake * 5 * degree * random.normal(), a * snake * 12 * degree * random.normal(), 0}),
         a * 3 * degree);
  // The head looks around, grazes or is raised. It stays level while the neck moves. A standing body often
  // moves only its head.
  const float h = plan.act == AnimalAct::rest && random.chance(0.5f) ? 1 : a;
  const float kind = random.unit();
  const float pitch = kind < 0.55f   ? h * 22 * degree * random.normal()
                      : kind < 0.85f ? random.unit() * neck_reach_
                                     : -h * random.between(5, 35) * degree;
  const float level = random.between(0.2f, 0.9f);
  const Vec3 aside = in_body({0, h * 28 * degree * random.normal(), h * 8 * degree * random.normal()});
  const Vec3 look = in_body({h * 10 * degree * random.normal(), h * 20 * degree * random.normal(), 0});
  for (const auto& neck : necks_) {
    const std::vector<std::size_t> below(neck.begin(), neck.end() - (neck.size() > 1));
    bend(below, pitch * frame_.left + aside,
         in_body({h * 20 * degree * random.normal(), h * 12 * degree * random.normal(), 0}), a * 4 * degree);
    if (neck.size() > 1) bend({neck.back()}, look - level * pitch * frame_.left, {}, a * 6 * degree);
  }
  for (const auto& tail : tails_)
    bend(tail, in_body({a * 45 * degree * random.normal(), a * 40 * degree * random.normal(), 0}),
         in_body({a * 40 * degree * random.normal(), a * 30 * degree * random.normal(), 0}), a * 6 * degree);
}

void AnimalRig::turn_others(const Plan& plan, std::vector<Mat3x4>& local, PoseRandom& random) const {
  const float a = plan.amount;
  const float flap = (random.chance(0.5f) ? 35.0f * std::sin(2 * std::numbers::pi_v<float> * plan.phase)
                                          : 20 * random.normal()) *
                     degree;
  const float mouth = random.chance(0.4f) ? random.between(0, 30) * degree : 0;
  const float laid_back = a * 35 * degree * std::fabs(random.normal());
  for (const std::uint32_t b : tree_.order) {
    if (!posable_[b]) continue;
    const Joint& joint = joints_[b];
    const float mirror = joint.side == Side::right ? -1.0f : 1.0f;
    Vec3 turn;
    switch (joint.role) {
      case JointRole::jaw:  // a jaw opens downwards
        turn = mouth * frame_.left;
        break;
      case JointRole::wing:
        turn = mirror * (joint.segment == 0 ? 1.0f : 0.4f) * flap * frame_.forward +
               a * 6 * degree * normal3(random);
        break;
      case JointRole::arm:
        turn = a * (joint.segment == 0 ? 20 : 14) * degree * normal3(random);
        break;
      case JointRole::ear:  // both ears are laid back together
        turn = joint.segment == 0 ? -laid_back * frame_.left + a * 10 * degree * normal3(random)
                                  : a * 8 * degree * normal3(random);
        break;
      case JointRole::finger:
      case JointRole::toe:
      case JointRole::other:
        turn = a * 5 * degree * normal3(random);
        break;
      default:
        continue;
    }
    local[b] = rotation_about(origin(b), turn);
  }
}

Pose AnimalRig::pose(AnimalAct act, PoseRandom& random) const {
  const Plan plan = draw(act, random);
  std::vector<Mat3x4> local(mesh_.bones.size());
  bend_chains(plan, local, random);
  turn_others(plan, local, random);
  std::vector<std::int32_t> hip_of(local.size(), -1), foot_of(local.size(), -1);
  for (std::size_t l = 0; l < legs_.size(); ++l) {
    hip_of[legs_[l].bones.front()] = std::int32_t(l);
    if (!legs_[l].foot.empty()) foot_of[legs_[l].foot.front()] = std::int32_t(l);
  }
  Pose pose(local.size());
  for (const std::uint32_t b : tree_.order) {
    const std::int32_t p = tree_.parent[b];
    const Mat3x4 above = p >= 0 ? pose[std::size_t(p)] : plan.body;
    if (hip_of[b] >= 0) {
      const LegChain& leg = legs_[std::size_t(hip_of[b])];
      const FootPlan& foot = plan.foot[std::size_t(hip_of[b])];
      const Vec3 place = foot.hangs ? foot.place : transform_point(inverse_rigid(above), foot.place);
      const std::vector<Mat3x4> turns = reach(leg, place, foot.bend_share);
      for (std::size_t i = 0; i < turns.size(); ++i) local[leg.bones[i]] = turns[i];
    }
    if (foot_of[b] >= 0) {
      // A planted foot stays level. A foot in the air hangs backwards.
      const FootPlan& foot = plan.foot[std::size_t(foot_of[b])];
      const Vec3 up = normalised(transform_vector(inverse_rigid(above), frame_.up));
      const Vec3 turn = 0.9f * foot.planted * shortest_arc(frame_.up, up) + foot.curl * frame_.left;
      local[b] = rotation_about(origin(b), turn);
    }
    pose[b] = above * local[b];
  }
  return pose;
}

}  // namespace nook::bake
