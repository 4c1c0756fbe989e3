#include "bakers/mannequin/skin_weights.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bakers/mannequin/bones.h"
#include "bakers/mannequin/shape_primitives.h"

namespace nook::mannequin {
namespace {

/// The weights of a point in the bind pose, before the blur.
struct WeightSeed {
  struct Share {
    int bone;
    double weight;
  };
  std::vector<Share> shares;  ///< Sums to one.
  double spread_m;            ///< Blur radius: about the thickness of the flesh.
  int finger = -1;  ///< Index in left_fingers(), -1 if the point is not on a finger. Weights never spread
                    ///< from one finger to another.
};

double distance_to_segment_m(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return glm::length(p - a - ab * t);
}

/// Makes the seed for a point. A point on the right side is mirrored to the left first; `side` is its
/// original side.
class Seeder {
 public:
  Seeder(const Skeleton& skeleton, const Vec3& folded_m, std::string side)
      : skeleton_(skeleton),
        p_(folded_m),
        side_(std::move(side)),
        arm_(left_arm_frame()),
        leg_(left_leg_frame()) {}

  WeightSeed seed() {
    const double along_m = glm::dot(p_ - arm_.shoulder_m, arm_.along);
    const Vec3 off = p_ - arm_.shoulder_m - arm_.along * along_m;
    // Near the body, the arm begins at a sloping plane from the top of the shoulder to the armpit.
    const double start_m = 0.012 + 0.25 * glm::dot(off, arm_.outward);
    if (along_m > start_m && glm::length(off) < (along_m < 0.4 ? 0.095 : 0.16)) {
      if (glm::dot(p_ - arm_.wrist_m, arm_.along) > 0.0) {
        return hand();
      }
      return arm(along_m);
    }
    // The crease of the groin rises from the crotch to the hip bone. It rises less steeply at the back, under
    // the glutes.
    const double steepness = glm::mix(0.62, 1.05, ramp(p_.z, -0.08, 0.05));
    const double crease_m = leg_.hip_m.y + steepness * (p_.x - leg_.hip_m.x);
    if (p_.y < crease_m && p_.y < 0.99) {
      return leg();
    }
    return torso();
  }

 private:
  int bone(const char* name) const { return skeleton_.find(std::string(name) + side_); }
  int middle(const char* name) const { return skeleton_.find(name); }
  double past(const char* name) const {
    const Bone& b = skeleton_.bone(std::string(name) + "_l");
    return glm::dot(p_ - b.position_m, glm::normalize(b.tip_m - b.position_m));
  }

  WeightSeed arm(double along_m) const {
    const double elbow_m = glm::length(arm_.elbow_m - arm_.shoulder_m);
    const double wrist_m = glm::length(arm_.wrist_m - arm_.shoulder_m);
    if (along_m < elbow_m) {
      // When the arm twists, the twist bone turns less than the arm. So it moves the end at the shoulder.
      const double turned = ramp(along_m, 0.03, 0.20);
      return {{{bone("upperarm_twist_01"), 1.0 - turned}, {bone("upperarm"), turned}},
              glm::mix(0.042, 0.022, ramp(along_m, 0.05, 0.18))};
    }
    const double turned = ramp(along_m, elbow_m + 0.06, wrist_m - 0.03);
    return {{{bone("lowerarm"), 1.0 - turned}, {bone("lowerarm_twist_01"), turned}},
            glm::mix(0.022, 0.010, ramp(along_m, elbow_m + 0.05, wrist_m - 0.04))};
  }

  WeightSeed hand() const {
    double nearest_m = 1.0;
    std::string owner = "hand";
    int owner_finger = -1;
    for (std::size_t f = 0; f < left_fingers().size(); ++f) {
      const FingerChain& finger = left_fingers()[f];
      for (int i = 0; i < 3; ++i) {
        const double radius = 0.5 * (finger.radii_m[i] + finger.radii_m[i + 1]);
        const double d = distance_to_segment_m(p_, finger.joints_m[i], finger.joints_m[i + 1]) - radius;
        if (d < nearest_m) {
          nearest_m = d;
          owner = std::string(finger.name) + "_0" + std::to_string(i + 1);
          owner_finger = static_cast<int>(f);
        }
      }
    }
    const bool is_thumb = owner_finger == 0;
    // The flesh of the palm and the skin between the fingers extend beyond the knuckles.
    const bool in_palm = owner.find("_01") != std::string::npos && past(owner.c_str()) < 0.010;
    const double spread_m = is_thumb ? 0.0075 : 0.0052;
    if (in_palm || nearest_m > 0.008) {
      return {{{bone("hand"), 1.0}}, 0.008};
    }
    return {{{bone(owner.c_str()), 1.0}}, spread_m, owner_finger};
  }

  WeightSeed leg() const {
    if (past("ball") > -0.004 && p_.y < 0.08) {
      return {{{bone("ball"), 1.0}}, 0.010};
    }
    if (p_.y < leg_.ankle_m.y + 0.25 * (p_.z - leg_.ankle_m.z)) {
      return {{{bone("foot"), 1.0}}, 0.014};
    }
    if (p_.y < leg_.knee_m.y) {
      return {{{bone("calf"), 1.0}}, glm::mix(0.018, 0.026, ramp(p_.y, 0.15, 0.40))};
    }
    return {{{bone("thigh"), 1.0}}, glm::mix(0.026, 0.042, ramp(p_.y, 0.55, 0.75))};
  }

  WeightSeed torso() const {
    // The chin moves with the head, and the nape moves with the neck.
    const double head_m = p_.y - (1.560 - 0.45 * p_.z);
    const double neck_m = p_.y - (1.475 - 0.45 * p_.z) - 0.10 * p_.x;
    if (head_m > -0.03) {
      const double w = ramp(head_m, -0.03, 0.03);
      return {{{middle("head"), w}, {middle("neck_01"), 1.0 - w}}, 0.014};
    }
    if (neck_m > 0.0) {
      return {{{middle("neck_01"), 1.0}}, 0.022};
    }
    const Bone& collar = skeleton_.bone("clavicle_l");
    const double reach_m = distance_to_segment_m(p_, collar.position_m, collar.tip_m);
    const double collar_w =
        (1.0 - ramp(reach_m, 0.045, 0.105)) * ramp(p_.x, 0.035, 0.105) * ramp(p_.y, 1.34, 1.41);
    const double one = ramp(p_.y, 1.010, 1.110), two = ramp(p_.y, 1.120, 1.220),
                 three = ramp(p_.y, 1.235, 1.340);
    return {{{middle("pelvis"), 1.0 - one},
             {middle("spine_01"), one * (1.0 - two)},
             {middle("spine_02"), one * two * (1.0 - three)},
             {middle("spine_03"), one * two * three * (1.0 - collar_w)},
             {bone("clavicle"), one * two * three * collar_w}},
            p_.y < 1.02 ? 0.042 : glm::mix(0.034, 0.042, ramp(p_.x, 0.08, 0.14))};
  }

  const Skeleton& skeleton_;
  Vec3 p_;
  std::string side_;
  ArmFrame arm_;
  LegFrame leg_;
};

WeightSeed seed_at(const Vec3& point_m, const Skeleton& skeleton) {
  const Vec3 folded(std::abs(point_m.x), point_m.y, point_m.z);
  return Seeder(skeleton, folded, point_m.x < 0.0 ? "_r" : "_l").seed();
}

/// One weight per vertex and bone, vertex by vertex.
using Table = std::vector<double>;

// After one implicit diffusion step, weights decay exponentially from a sharp edge. A second step makes the
// transition a smooth S curve.
constexpr int steps = 2;
constexpr int sweeps = 50;
// Smaller weights are removed, so that each joint affects only a small area.
constexpr double faintest = 0.012;

Table seed_table(const std::vector<WeightSeed>& seeds, const Skeleton& skeleton) {
  Table table(seeds.size() * skeleton.size(), 0.0);
  for (std::size_t v = 0; v < seeds.size(); ++v) {
    for (const WeightSeed::Share& share : seeds[v].shares) {
      table[v * skeleton.size() + static_cast<std::size_t>(share.bone)] += share.weight;
    }
  }
  return table;
}

/// Solves (1 + spread² L) w = seeds by Gauss-Seidel sweeps. L is the graph Laplacian divided by squared edge
/// lengths.
Table spread(const Table& from, const TriangleMesh& mesh, const std::vector<WeightSeed>& seeds,
             std::size_t bones) {
  const auto neighbours = vertex_neighbours(mesh);
  Table table = from;
  std::vector<double> sum(bones);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t v = 0; v < neighbours.size(); ++v) {
      std::copy_n(&from[v * bones], bones, sum.begin());
      double total = 1.0;
      for (std::uint32_t n : neighbours[v]) {
        if (seeds[n].finger >= 0 && seeds[v].finger >= 0 && seeds[n].finger != seeds[v].finger) {
          continue;
        }
        const Vec3 edge = mesh.positions_m[n] - mesh.positions_m[v];
        const double reach = std::min(seeds[v].spread_m, seeds[n].spread_m);
        // In a plane, a vertex has about six neighbours. The mean of their values differs from the vertex's
        // value by a quarter of L h².
        const double pull = 4.0 / static_cast<double>(neighbours[v].size()) * reach * reach /
                            glm::dot(edge, edge) / static_cast<double>(steps);
        total += pull;
        for (std::size_t b = 0; b < bones; ++b) {
          sum[b] += pull * table[n * bones + b];
        }
      }
      for (std::size_t b = 0; b < bones; ++b) {
        table[v * bones + b] = sum[b] / total;
      }
    }
  }
  return table;
}

VertexWeights strongest(const double* weights, std::size_t bones) {
  std::vector<std::uint16_t> order(bones);
  for (std::size_t b = 0; b < bones; ++b) {
    order[b] = static_cast<std::uint16_t>(b);
  }
  std::partial_sort(order.begin(), order.begin() + 4, order.end(), [&](std::uint16_t a, std::uint16_t b) {
    return weights[a] != weights[b] ? weights[a] > weights[b] : a < b;
  });
  // We subtract `faintest` instead of comparing with it, so that weights fade in from zero.
  std::array<double, 4> kept{};
  double total = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    kept[k] = std::max(weights[order[k]] - faintest, 0.0);
    total += kept[k];
  }
  VertexWeights result;
  float rest = 1.0F;
  for (std::size_t k = 3; k > 0; --k) {
    result.weights[k] = static_cast<float>(kept[k] / total);
    result.bones[k] = result.weights[k] > 0.0F ? order[k] : std::uint16_t{0};
    rest -= result.weights[k];
  }
  result.weights[0] = rest;
  result.bones[0] = order[0];
  return result;
}

}  // namespace

std::vector<VertexWeights> make_skin_weights(const TriangleMesh& mesh, const Skeleton& skeleton) {
  std::vector<WeightSeed> seeds;
  for (const Vec3& p : mesh.positions_m) {
    seeds.push_back(seed_at(p, skeleton));
  }
  Table table = seed_table(seeds, skeleton);
  for (int step = 0; step < steps; ++step) {
    table = spread(table, mesh, seeds, skeleton.size());
  }
  std::vector<VertexWeights> result;
  for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
    result.push_back(strongest(&table[v * skeleton.size()], skeleton.size()));
  }
  return result;
}

}  // namespace nook::mannequin
