#include <cmath>

#include "samples/mannequin/body_sdf.h"
#include "samples/mannequin/skeleton.h"

namespace nook_samples::mannequin {
namespace {

const Vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

}  // namespace

Part make_leg() {
  Part leg(0.030);
  // Columns: height; centre x, z; reach outwards, inwards, to the front, to the back.
  leg.add(Loft(Vec3(0.0), kX, kZ, kY,
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
  // Teardrop muscles over the knee, knee cap, tendon under it.
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
  // The foot turns outwards by eight degrees; the loft runs from heel to toe along the ground.
  const double turn = glm::radians(8.0);
  const Vec3 along(std::sin(turn), 0.0, std::cos(turn)), across(std::cos(turn), 0.0, -std::sin(turn));
  const Vec3 origin(0.112, 0.002, -0.030);
  foot.add(Loft(origin, across, kY, along,
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
  // Toes are rounds at the front edge: the big toe stands off, the others step back one behind the other.
  foot.add(RoundCone{origin + along * 0.130 - across * 0.026 + kY * 0.018,
                     origin + along * 0.200 - across * 0.026 + kY * 0.014, 0.016, 0.0125},
           0.010);
  const double toe_along_m[] = {0.196, 0.189, 0.179, 0.166};
  for (int i = 0; i < 4; ++i) {
    const double side_m = -0.0015 + 0.0145 * i;
    foot.add(RoundCone{origin + along * 0.130 + across * (side_m * 0.9) + kY * 0.016,
                       origin + along * toe_along_m[i] + across * side_m + kY * 0.0115, 0.0115, 0.0092},
             0.007);
  }
  // Instep, heel, and the hollow on the inner side.
  foot.add(RoundCone{origin + along * 0.010 + kY * 0.070,
                     origin + along * 0.100 - across * 0.010 + kY * 0.034, 0.028, 0.018},
           0.030);
  foot.add(Ellipsoid{origin - along * 0.035 + kY * 0.032, Vec3(0.028, 0.031, 0.028)}, 0.020);
  foot.carve(Ellipsoid{origin + along * 0.050 - across * 0.045 + kY * 0.004, Vec3(0.022, 0.016, 0.040)},
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
  // Deltoid with its three heads, running into the arm.
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
  // Balls of the thumb and of the little finger.
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
    // A knuckle's bulge on the back of the hand.
    if (&finger != &left_fingers().front()) {
      hand.add(Ellipsoid{finger.joints_m[0] + frame.outward * 0.005, Vec3(0.010, 0.008, 0.007),
                         axes_from(frame.along, frame.forward)},
               0.008);
    }
  }
  return hand;
}

}  // namespace nook_samples::mannequin
