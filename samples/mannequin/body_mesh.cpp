#include "samples/mannequin/body_mesh.h"

#include <algorithm>
#include <cmath>

#include "samples/mannequin/ramp.h"
#include "samples/mannequin/remesher.h"
#include "samples/mannequin/skeleton.h"
#include "samples/mannequin/surface_mesher.h"

namespace nook_samples::mannequin {
namespace {

// The cells are fine enough that the gaps between the fingers stay open.
constexpr double kCell_m = 0.0060;
constexpr int kRounds = 7;

double target_edge_m(const Vec3& point_m) {
  static const ArmFrame arm = left_arm_frame();
  const Vec3 p(std::abs(point_m.x), point_m.y, point_m.z);
  double edge_m = 0.0268;
  // Limbs are thinner than the trunk, and joints need rings of vertices to bend.
  const double along_arm_m = glm::dot(p - arm.shoulder_m, arm.along);
  const double off_arm_m = glm::length(p - arm.shoulder_m - arm.along * along_arm_m);
  if (off_arm_m < 0.12 && along_arm_m > 0.0) {
    edge_m = glm::mix(edge_m, 0.0218, ramp(along_arm_m, 0.0, 0.10));
    const double past_wrist_m = glm::dot(p - arm.wrist_m, arm.along);
    edge_m = glm::mix(edge_m, 0.0105, ramp(past_wrist_m, -0.10, 0.010));
    edge_m = glm::mix(edge_m, 0.0066, ramp(past_wrist_m, 0.020, 0.075));
    // The thumb leaves the palm sideways.
    const double thumb =
        ramp(glm::dot(p - arm.wrist_m, arm.forward), 0.025, 0.045) * ramp(past_wrist_m, 0.0, 0.03);
    edge_m = glm::mix(edge_m, 0.0068, thumb);
  }
  edge_m = glm::mix(edge_m, 0.0165, ramp(p.y, 1.42, 1.58));
  edge_m =
      glm::mix(edge_m, 0.0088, ramp(p.y, 1.51, 1.54) * ramp(p.z, 0.02, 0.07) * ramp(1.75 - p.y, 0.02, 0.07));
  const double ear = 1.0 - ramp(glm::length(p - Vec3(0.082, 1.632, -0.012)), 0.030, 0.060);
  edge_m = glm::mix(edge_m, 0.0090, ear);
  edge_m = glm::mix(edge_m, 0.0235, ramp(0.62 - p.y, 0.0, 0.12));
  edge_m = glm::mix(edge_m, 0.0148, ramp(0.14 - p.y, 0.0, 0.10));
  return edge_m;
}

}  // namespace

TriangleMesh make_body_mesh() {
  const BodySdf sdf;
  return remesh(march_tetrahedra(sdf, kCell_m), sdf, target_edge_m, kRounds);
}

}  // namespace nook_samples::mannequin
