#include "bakers/mannequin/body_sdf.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/mannequin/bones.h"

namespace nook::mannequin {
namespace {

// The distances of lofts and ellipsoids are estimates, which may be too small. So bounds are enlarged.
constexpr double bound_safety = 0.5;

bool out_of_reach(const Vec3& point_m, const Vec3& centre_m, double radius_m, double limit_m) {
  return (glm::length(point_m - centre_m) - radius_m) * bound_safety > limit_m;
}

void bound(Mass& mass) {
  if (const auto* cone = std::get_if<RoundCone>(&mass.shape)) {
    mass.bound_centre_m = (cone->start_m + cone->end_m) * 0.5;
    mass.bound_radius_m =
        0.5 * glm::length(cone->end_m - cone->start_m) + std::max(cone->start_radius_m, cone->end_radius_m);
  } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&mass.shape)) {
    mass.bound_centre_m = ellipsoid->centre_m;
    mass.bound_radius_m = std::max({ellipsoid->radii_m.x, ellipsoid->radii_m.y, ellipsoid->radii_m.z});
  } else {
    const Loft& loft = std::get<Loft>(mass.shape);
    mass.bound_centre_m = loft.bound_centre_m();
    mass.bound_radius_m = loft.bound_radius_m();
  }
}

Mass bounded(Mass mass) {
  bound(mass);
  return mass;
}

}  // namespace

void Part::add(const RoundCone& cone, double blend_m) {
  masses_.push_back(bounded({cone, blend_m}));
}

void Part::add(const Ellipsoid& ellipsoid, double blend_m) {
  masses_.push_back(bounded({ellipsoid, blend_m}));
}

void Part::add(Loft loft, double blend_m) {
  masses_.push_back(bounded({std::move(loft), blend_m}));
}

void Part::carve(const RoundCone& cone, double blend_m) {
  masses_.push_back(bounded({cone, blend_m, true}));
}

void Part::carve(const Ellipsoid& ellipsoid, double blend_m) {
  masses_.push_back(bounded({ellipsoid, blend_m, true}));
}

void Part::close() {
  bound_centre_m_ = Vec3(0.0);
  for (const Mass& mass : masses_) {
    bound_centre_m_ += mass.bound_centre_m / static_cast<double>(masses_.size());
  }
  for (const Mass& mass : masses_) {
    if (!mass.carved) {
      bound_radius_m_ =
          std::max(bound_radius_m_, glm::length(mass.bound_centre_m - bound_centre_m_) + mass.bound_radius_m);
    }
  }
}

double Part::distance(const Vec3& point_m) const {
  double result = std::numeric_limits<double>::max();
  for (const Mass& mass : masses_) {
    const double limit = mass.carved ? mass.blend_m - std::min(result, mass.blend_m) : result + mass.blend_m;
    if (out_of_reach(point_m, mass.bound_centre_m, mass.bound_radius_m, limit)) {
      continue;
    }
    const double d = std::visit([&](const auto& shape) { return shape.distance(point_m); }, mass.shape);
    result = mass.carved ? smooth_subtract(result, d, mass.blend_m) : smooth_min(result, d, mass.blend_m);
  }
  return result;
}

double Part::join(double known_m, const Vec3& point_m) const {
  if (out_of_reach(point_m, bound_centre_m_, bound_radius_m_, known_m + blend_m_)) {
    return known_m;
  }
  return smooth_min(known_m, distance(point_m), blend_m_);
}

BodySdf::BodySdf() {
  parts_ = {make_torso(), make_head(), make_leg(), make_foot(), make_arm(), make_hand()};
  for (Part& part : parts_) {
    part.close();
  }
}

double BodySdf::distance(const Vec3& point_m) const {
  // Rounds |x| near 0, so that the seam between the mirrored halves is smooth.
  constexpr double seam_m = 0.004;
  const Vec3 folded(std::sqrt(point_m.x * point_m.x + seam_m * seam_m), point_m.y, point_m.z);
  double result = 10.0;
  for (const Part& part : parts_) {
    result = part.join(result, folded);
  }
  return result;
}

Vec3 BodySdf::gradient(const Vec3& point_m) const {
  constexpr double step_m = 2e-4;
  const Vec3 a(1, -1, -1), b(-1, -1, 1), c(-1, 1, -1), d(1, 1, 1);
  return (a * distance(point_m + a * step_m) + b * distance(point_m + b * step_m) +
          c * distance(point_m + c * step_m) + d * distance(point_m + d * step_m)) /
         (4.0 * step_m);
}

Vec3 BodySdf::project(const Vec3& point_m) const {
  Vec3 p = point_m;
  for (int step = 0; step < 4; ++step) {
    const double d = distance(p);
    if (std::abs(d) < 2e-5) {
      break;
    }
    const Vec3 g = gradient(p);
    const Vec3 move = g * (d / std::max(glm::dot(g, g), 0.05));
    // The step length is limited, so that a point cannot jump to another finger.
    constexpr double longest_m = 0.004;
    p -= move * std::min(1.0, longest_m / std::max(glm::length(move), 1e-12));
  }
  return p;
}

namespace {

/// Returns a section of the torso. Front and back are measured from a centre at depth `z_m`.
LoftSection slice(double y_m, double half_width_m, double front_m, double back_m, double z_m = 0.0) {
  return {y_m, 0.0, z_m, half_width_m, half_width_m, front_m, back_m};
}

}  // namespace

Part make_torso() {
  Part torso(0.03);
  torso.add(Loft(Vec3(0.0), x_axis, z_axis, y_axis,
                 {slice(0.845, 0.100, 0.060, 0.070), slice(0.885, 0.150, 0.086, 0.085),
                  slice(0.930, 0.164, 0.095, 0.096), slice(0.980, 0.157, 0.098, 0.090),
                  slice(1.030, 0.147, 0.100, 0.080), slice(1.085, 0.132, 0.094, 0.074),
                  slice(1.140, 0.129, 0.094, 0.079), slice(1.200, 0.138, 0.101, 0.091),
                  slice(1.270, 0.153, 0.107, 0.107), slice(1.330, 0.160, 0.103, 0.116),
                  slice(1.385, 0.153, 0.086, 0.114), slice(1.430, 0.122, 0.056, 0.104),
                  slice(1.465, 0.085, 0.030, 0.086)},
                 0.020, 2.3),
            0.03);
  // Pectorals, and the side of the chest under the arm.
  torso.add(Ellipsoid{Vec3(0.078, 1.338, 0.072), Vec3(0.086, 0.060, 0.040),
                      axes_from(Vec3(0.95, 0.20, -0.32), y_axis)},
            0.030);
  torso.add(RoundCone{Vec3(0.100, 1.355, 0.062), Vec3(0.186, 1.396, 0.010), 0.034, 0.034}, 0.045);
  // Latissimus, serratus and shoulder blade.
  torso.add(RoundCone{Vec3(0.154, 1.345, -0.045), Vec3(0.108, 1.140, -0.040), 0.044, 0.026}, 0.050);
  torso.add(Ellipsoid{Vec3(0.088, 1.370, -0.093), Vec3(0.060, 0.078, 0.030),
                      axes_from(Vec3(0.95, 0.0, 0.30), y_axis)},
            0.040);
  // Trapezius down to the shoulder, and the shoulder girdle below.
  torso.add(RoundCone{Vec3(0.016, 1.510, -0.046), Vec3(0.148, 1.452, -0.034), 0.031, 0.030}, 0.045);
  torso.add(RoundCone{Vec3(0.060, 1.425, -0.020), Vec3(0.182, 1.424, -0.020), 0.045, 0.046}, 0.045);
  // Collar bone.
  torso.add(RoundCone{Vec3(0.022, 1.430, 0.040), Vec3(0.158, 1.462, 0.002), 0.010, 0.010}, 0.026);
  // Flank over the hip bone, belly, glutes.
  torso.add(Ellipsoid{Vec3(0.090, 1.010, -0.005), Vec3(0.054, 0.065, 0.070)}, 0.050);
  torso.add(Ellipsoid{Vec3(0.0, 1.010, 0.055), Vec3(0.085, 0.100, 0.045)}, 0.050);
  torso.add(Ellipsoid{Vec3(0.076, 0.897, -0.060), Vec3(0.078, 0.084, 0.064),
                      axes_from(Vec3(0.97, 0.12, -0.2), y_axis)},
            0.030);
  // Straight abdominal muscles, under the arch of the ribs.
  torso.add(RoundCone{Vec3(0.036, 1.225, 0.074), Vec3(0.030, 0.960, 0.072), 0.031, 0.024}, 0.026);
  torso.carve(RoundCone{Vec3(0.062, 1.190, 0.118), Vec3(0.128, 1.105, 0.082), 0.012, 0.014}, 0.040);
  // Furrows along the spine and between the abdominal muscles.
  torso.carve(RoundCone{Vec3(0.0, 1.380, -0.142), Vec3(0.0, 1.090, -0.098), 0.012, 0.014}, 0.035);
  torso.carve(RoundCone{Vec3(0.0, 1.300, 0.122), Vec3(0.0, 1.080, 0.112), 0.007, 0.006}, 0.024);
  return torso;
}

Part make_head() {
  Part head(0.022);
  // The neck leans forward. Its muscle runs from behind the ear to the collar bone.
  head.add(RoundCone{Vec3(0.0, 1.420, -0.040), Vec3(0.0, 1.590, -0.010), 0.059, 0.053}, 0.02);
  head.add(RoundCone{Vec3(0.056, 1.595, -0.022), Vec3(0.016, 1.440, 0.034), 0.013, 0.009}, 0.022);
  head.add(RoundCone{Vec3(0.0, 1.552, 0.036), Vec3(0.0, 1.520, 0.026), 0.012, 0.010}, 0.020);
  // Skull and face. The forward reach of the loft's sections gives the profile of the face.
  head.add(Ellipsoid{Vec3(0.0, 1.662, -0.008), Vec3(0.0765, 0.088, 0.097)}, 0.03);
  head.add(Loft(Vec3(0.0), x_axis, z_axis, y_axis,
                {slice(1.526, 0.022, 0.046, 0.022, 0.042), slice(1.540, 0.034, 0.060, 0.035, 0.036),
                 slice(1.560, 0.044, 0.066, 0.050, 0.030), slice(1.590, 0.053, 0.071, 0.055, 0.025),
                 slice(1.620, 0.060, 0.074, 0.060, 0.022), slice(1.645, 0.064, 0.073, 0.060, 0.020),
                 slice(1.668, 0.065, 0.076, 0.060, 0.016), slice(1.690, 0.064, 0.077, 0.060, 0.014),
                 slice(1.715, 0.055, 0.066, 0.055, 0.010)},
                0.010, 2.1),
           0.025);
  // Jaw, cheek, cheek bone, chin, brow.
  head.add(RoundCone{Vec3(0.049, 1.580, 0.012), Vec3(0.018, 1.538, 0.070), 0.012, 0.012}, 0.028);
  head.add(Ellipsoid{Vec3(0.037, 1.594, 0.058), Vec3(0.021, 0.030, 0.024)}, 0.030);
  head.add(RoundCone{Vec3(0.056, 1.630, 0.034), Vec3(0.041, 1.622, 0.071), 0.011, 0.013}, 0.034);
  head.add(Ellipsoid{Vec3(0.0, 1.537, 0.084), Vec3(0.015, 0.012, 0.014)}, 0.018);
  head.add(RoundCone{Vec3(0.014, 1.664, 0.088), Vec3(0.048, 1.667, 0.064), 0.008, 0.009}, 0.020);
  // Eye sockets with the eyeballs behind closed lids.
  head.carve(Ellipsoid{Vec3(0.032, 1.646, 0.101), Vec3(0.017, 0.0120, 0.017)}, 0.018);
  head.add(Ellipsoid{Vec3(0.0325, 1.645, 0.073), Vec3(0.0155, 0.0120, 0.0135)}, 0.006);
  // Nose: bridge, tip and wings.
  head.add(RoundCone{Vec3(0.0, 1.652, 0.092), Vec3(0.0, 1.612, 0.112), 0.0075, 0.0100}, 0.012);
  head.add(Ellipsoid{Vec3(0.011, 1.606, 0.101), Vec3(0.0075, 0.0075, 0.0100)}, 0.008);
  // Lips, with the parting between them.
  head.add(RoundCone{Vec3(0.0, 1.5785, 0.0980), Vec3(0.021, 1.5735, 0.088), 0.0065, 0.0030}, 0.008);
  head.add(RoundCone{Vec3(0.0, 1.5660, 0.0965), Vec3(0.017, 1.5690, 0.089), 0.0070, 0.0035}, 0.008);
  // Ear: a tilted dish.
  const Mat3 ear_axes = axes_from(Vec3(0.93, 0.0, 0.36), Vec3(0.0, 0.97, -0.22));
  head.add(Ellipsoid{Vec3(0.079, 1.632, -0.012), Vec3(0.0080, 0.0310, 0.0185), ear_axes}, 0.008);
  head.carve(Ellipsoid{Vec3(0.0885, 1.636, -0.006), Vec3(0.0075, 0.0180, 0.0095), ear_axes}, 0.006);
  return head;
}

Part make_leg() {
  Part leg(0.030);
  // Columns: height; centre x, z; reach outwards, inwards, forwards, backwards.
  leg.add(Loft(Vec3(0.0), x_axis, z_axis, y_axis,
               {{0.930, 0.088, -0.004, 0.072, 0.066, 0.076, 0.080},
                {0.880, 0.093, -0.002, 0.080, 0.072, 0.088, 0.090},
                {0.820, 0.097, 0.001, 0.080, 0.075, 0.092, 0.088},
                {0.750, 0.100, 0.004, 0.076, 0.072, 0.089, 0.080},
                {0.670, 0.102, 0.005, 0.070, 0.066, 0.080, 0.072},
                {0.600, 0.103, 0.005, 0.062, 0.058, 0.069, 0.064},
                {0.545, 0.104, 0.003, 0.054, 0.051, 0.058, 0.057},
                {0.500, 0.104, 0.001, 0.049, 0.049, 0.052, 0.053},
                {0.460, 0.105, -0.003, 0.048, 0.047, 0.047, 0.051},
                {0.415, 0.106, -0.008, 0.051, 0.047, 0.044, 0.058},
                {0.355, 0.107, -0.013, 0.052, 0.049, 0.043, 0.064},
                {0.290, 0.109, -0.018, 0.046, 0.043, 0.040, 0.057},
                {0.225, 0.110, -0.023, 0.038, 0.036, 0.036, 0.044},
                {0.160, 0.111, -0.028, 0.032, 0.031, 0.033, 0.036},
                {0.105, 0.112, -0.031, 0.031, 0.030, 0.034, 0.034},
                {0.075, 0.112, -0.030, 0.031, 0.030, 0.036, 0.034}},
               0.015),
          0.03);
  // Teardrop muscles above the knee, knee cap, tendon below.
  leg.add(Ellipsoid{Vec3(0.075, 0.580, 0.040), Vec3(0.026, 0.056, 0.026)}, 0.030);
  leg.add(Ellipsoid{Vec3(0.133, 0.610, 0.038), Vec3(0.024, 0.062, 0.026)}, 0.030);
  leg.add(Ellipsoid{Vec3(0.104, 0.497, 0.041), Vec3(0.024, 0.031, 0.017)}, 0.020);
  leg.add(RoundCone{Vec3(0.104, 0.470, 0.037), Vec3(0.105, 0.425, 0.031), 0.012, 0.010}, 0.020);
  // The two heads of the calf, shin, Achilles tendon, ankle bones.
  leg.add(Ellipsoid{Vec3(0.083, 0.365, -0.045), Vec3(0.028, 0.080, 0.030)}, 0.026);
  leg.add(Ellipsoid{Vec3(0.130, 0.380, -0.042), Vec3(0.026, 0.074, 0.030)}, 0.026);
  leg.add(RoundCone{Vec3(0.112, 0.220, -0.056), Vec3(0.112, 0.050, -0.066), 0.012, 0.011}, 0.022);
  leg.add(RoundCone{Vec3(0.141, 0.082, -0.034), Vec3(0.139, 0.130, -0.034), 0.010, 0.006}, 0.016);
  leg.add(RoundCone{Vec3(0.085, 0.092, -0.028), Vec3(0.087, 0.140, -0.030), 0.011, 0.006}, 0.016);
  return leg;
}

Part make_foot() {
  Part foot(0.022);
  // The foot is turned outwards by eight degrees. The loft runs along the ground from heel to toe.
  const double turn = glm::radians(8.0);
  const Vec3 along(std::sin(turn), 0.0, std::cos(turn)), across(std::cos(turn), 0.0, -std::sin(turn));
  const Vec3 origin(0.112, 0.002, -0.030);
  foot.add(Loft(origin, across, y_axis, along,
                {{-0.040, 0.000, 0.034, 0.027, 0.027, 0.030, 0.033},
                 {-0.015, 0.000, 0.036, 0.032, 0.031, 0.040, 0.036},
                 {0.020, 0.000, 0.040, 0.033, 0.031, 0.046, 0.040},
                 {0.055, 0.002, 0.038, 0.036, 0.032, 0.040, 0.037},
                 {0.090, 0.003, 0.030, 0.042, 0.037, 0.034, 0.030},
                 {0.125, 0.002, 0.023, 0.047, 0.043, 0.024, 0.023},
                 {0.155, 0.000, 0.018, 0.044, 0.042, 0.017, 0.018},
                 {0.182, -0.004, 0.015, 0.034, 0.036, 0.012, 0.015}},
                0.022, 2.6),
           0.02);
  // Toes are rounded shapes at the front edge. The big toe is separate. Each further toe is a little further
  // back.
  foot.add(RoundCone{origin + along * 0.130 - across * 0.026 + y_axis * 0.018,
                     origin + along * 0.200 - across * 0.026 + y_axis * 0.014, 0.016, 0.0125},
           0.010);
  const double toe_along_m[] = {0.196, 0.189, 0.179, 0.166};
  for (int i = 0; i < 4; ++i) {
    const double side_m = -0.0015 + 0.0145 * i;
    foot.add(RoundCone{origin + along * 0.130 + across * (side_m * 0.9) + y_axis * 0.016,
                       origin + along * toe_along_m[i] + across * side_m + y_axis * 0.0115, 0.0115, 0.0092},
             0.007);
  }
  // Instep, heel, and the hollow on the inner side.
  foot.add(RoundCone{origin + along * 0.010 + y_axis * 0.070,
                     origin + along * 0.100 - across * 0.010 + y_axis * 0.034, 0.028, 0.018},
           0.030);
  foot.add(Ellipsoid{origin - along * 0.035 + y_axis * 0.032, Vec3(0.028, 0.031, 0.028)}, 0.020);
  foot.carve(Ellipsoid{origin + along * 0.050 - across * 0.045 + y_axis * 0.004, Vec3(0.022, 0.016, 0.040)},
             0.020);
  return foot;
}

Part make_arm() {
  Part arm(0.030);
  const ArmFrame frame = left_arm_frame();
  // Columns: distance from the shoulder; centre; reach forwards, backwards, outwards, inwards.
  arm.add(Loft(frame.shoulder_m, frame.forward, frame.outward, frame.along,
               {{0.000, 0.000, 0.000, 0.046, 0.048, 0.046, 0.044},
                {0.050, 0.000, 0.000, 0.048, 0.050, 0.046, 0.046},
                {0.110, 0.000, 0.000, 0.046, 0.048, 0.040, 0.043},
                {0.165, 0.001, 0.000, 0.046, 0.045, 0.037, 0.040},
                {0.220, 0.000, 0.000, 0.041, 0.041, 0.035, 0.037},
                {0.265, 0.000, 0.000, 0.036, 0.038, 0.036, 0.038},
                {0.295, 0.000, 0.000, 0.037, 0.036, 0.039, 0.040},
                {0.335, 0.001, 0.000, 0.041, 0.036, 0.040, 0.041},
                {0.385, 0.000, 0.000, 0.038, 0.034, 0.037, 0.038},
                {0.440, 0.000, 0.000, 0.032, 0.030, 0.030, 0.031},
                {0.495, 0.000, 0.000, 0.027, 0.026, 0.022, 0.023},
                {0.535, 0.000, 0.000, 0.026, 0.026, 0.0185, 0.019}},
               0.012),
          0.03);
  const auto at = [&](double along_m, double forward_m, double outward_m) {
    return frame.shoulder_m + frame.along * along_m + frame.forward * forward_m + frame.outward * outward_m;
  };
  // Deltoid with its three heads, which merges into the arm.
  arm.add(
      Ellipsoid{at(0.020, 0.004, 0.022), Vec3(0.078, 0.050, 0.044), axes_from(frame.along, frame.forward)},
      0.030);
  arm.add(RoundCone{at(0.010, 0.024, 0.014), at(0.120, 0.006, 0.026), 0.034, 0.014}, 0.030);
  arm.add(RoundCone{at(0.010, -0.026, 0.010), at(0.120, -0.002, 0.026), 0.034, 0.014}, 0.030);
  // Biceps in front, triceps behind.
  arm.add(
      Ellipsoid{at(0.160, 0.022, -0.006), Vec3(0.070, 0.029, 0.029), axes_from(frame.along, frame.forward)},
      0.022);
  arm.add(
      Ellipsoid{at(0.130, -0.024, -0.004), Vec3(0.085, 0.027, 0.034), axes_from(frame.along, frame.forward)},
      0.024);
  // Point of the elbow, the forearm's two muscle bellies, the end of the ulna.
  arm.add(RoundCone{at(0.280, -0.027, 0.000), at(0.300, -0.026, 0.000), 0.013, 0.011}, 0.018);
  arm.add(
      Ellipsoid{at(0.335, 0.020, 0.017), Vec3(0.068, 0.026, 0.024), axes_from(frame.along, frame.forward)},
      0.022);
  arm.add(
      Ellipsoid{at(0.345, -0.004, -0.020), Vec3(0.074, 0.030, 0.024), axes_from(frame.along, frame.forward)},
      0.022);
  arm.add(
      Ellipsoid{at(0.520, -0.018, 0.012), Vec3(0.014, 0.009, 0.009), axes_from(frame.along, frame.forward)},
      0.012);
  return arm;
}

Part make_hand() {
  Part hand(0.014);
  const ArmFrame frame = left_arm_frame();
  const auto at = [&](double along_m, double forward_m, double outward_m) {
    return frame.wrist_m + frame.along * along_m + frame.forward * forward_m + frame.outward * outward_m;
  };
  hand.add(Loft(frame.wrist_m, frame.forward, frame.outward, frame.along,
                {{-0.010, 0.000, 0.000, 0.0255, 0.0255, 0.0185, 0.0185},
                 {0.015, 0.000, 0.000, 0.028, 0.028, 0.018, 0.019},
                 {0.040, 0.000, 0.000, 0.036, 0.036, 0.0155, 0.018},
                 {0.065, 0.000, 0.000, 0.040, 0.039, 0.0140, 0.016},
                 {0.083, 0.000, 0.000, 0.040, 0.039, 0.0115, 0.0125}},
                0.006, 2.3),
           0.012);
  // Pads at the base of the thumb and the little finger.
  hand.add(RoundCone{at(0.018, 0.016, -0.010), at(0.050, 0.034, -0.014), 0.016, 0.014}, 0.014);
  hand.add(RoundCone{at(0.018, -0.018, -0.010), at(0.060, -0.026, -0.010), 0.012, 0.010}, 0.014);
  // The fold of skin between thumb and index finger.
  hand.add(RoundCone{at(0.036, 0.034, -0.006), at(0.064, 0.038, -0.002), 0.010, 0.008}, 0.014);
  for (const FingerChain& finger : left_fingers()) {
    for (int i = 0; i < 3; ++i) {
      hand.add(
          RoundCone{finger.joints_m[i], finger.joints_m[i + 1], finger.radii_m[i], finger.radii_m[i + 1]},
          i == 0 ? 0.007 : 0.002);
    }
    // The bulge of a knuckle on the back of the hand.
    if (&finger != &left_fingers().front()) {
      hand.add(Ellipsoid{finger.joints_m[0] + frame.outward * 0.005, Vec3(0.010, 0.008, 0.007),
                         axes_from(frame.along, frame.forward)},
               0.008);
    }
  }
  return hand;
}

}  // namespace nook::mannequin
