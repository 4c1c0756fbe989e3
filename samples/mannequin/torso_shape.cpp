#include "samples/mannequin/body_sdf.h"

namespace nook_samples::mannequin {
namespace {

/// A section of the torso: half width, reach to the front and to the back of a centre at depth `z_m`.
LoftSection slice(double y_m, double half_width_m, double front_m, double back_m, double z_m = 0.0) {
  return {y_m, 0.0, z_m, half_width_m, half_width_m, front_m, back_m};
}

const Vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

}  // namespace

Part make_torso() {
  Part torso(0.03);
  torso.add(Loft(Vec3(0.0), kX, kZ, kY,
                 {slice(0.845, 0.100, 0.060, 0.070), slice(0.885, 0.150, 0.086, 0.085),
                  slice(0.930, 0.164, 0.095, 0.096), slice(0.980, 0.157, 0.098, 0.090),
                  slice(1.030, 0.147, 0.100, 0.080), slice(1.085, 0.132, 0.094, 0.074),
                  slice(1.140, 0.129, 0.094, 0.079), slice(1.200, 0.138, 0.101, 0.091),
                  slice(1.270, 0.153, 0.107, 0.107), slice(1.330, 0.160, 0.103, 0.116),
                  slice(1.385, 0.153, 0.086, 0.114), slice(1.430, 0.122, 0.056, 0.104),
                  slice(1.465, 0.085, 0.030, 0.086)},
                 0.020, 2.3),
            0.03);
  // Pectorals, and the chest's side under the arm.
  torso.add(
      Ellipsoid{Vec3(0.078, 1.338, 0.072), Vec3(0.086, 0.060, 0.040), axes_from(Vec3(0.95, 0.20, -0.32), kY)},
      0.030);
  torso.add(RoundCone{Vec3(0.100, 1.355, 0.062), Vec3(0.186, 1.396, 0.010), 0.034, 0.034}, 0.045);
  // Latissimus, serratus and shoulder blade.
  torso.add(RoundCone{Vec3(0.154, 1.345, -0.045), Vec3(0.108, 1.140, -0.040), 0.044, 0.026}, 0.050);
  torso.add(
      Ellipsoid{Vec3(0.088, 1.370, -0.093), Vec3(0.060, 0.078, 0.030), axes_from(Vec3(0.95, 0.0, 0.30), kY)},
      0.040);
  // Trapezius down to the shoulder, and the shoulder girdle under it.
  torso.add(RoundCone{Vec3(0.016, 1.510, -0.046), Vec3(0.148, 1.452, -0.034), 0.031, 0.030}, 0.045);
  torso.add(RoundCone{Vec3(0.060, 1.425, -0.020), Vec3(0.182, 1.424, -0.020), 0.045, 0.046}, 0.045);
  // Collar bone.
  torso.add(RoundCone{Vec3(0.022, 1.430, 0.040), Vec3(0.158, 1.462, 0.002), 0.010, 0.010}, 0.026);
  // Flank over the hip bone, belly, glutes.
  torso.add(Ellipsoid{Vec3(0.090, 1.010, -0.005), Vec3(0.054, 0.065, 0.070)}, 0.050);
  torso.add(Ellipsoid{Vec3(0.0, 1.010, 0.055), Vec3(0.085, 0.100, 0.045)}, 0.050);
  torso.add(
      Ellipsoid{Vec3(0.076, 0.897, -0.060), Vec3(0.078, 0.084, 0.064), axes_from(Vec3(0.97, 0.12, -0.2), kY)},
      0.030);
  // Straight belly muscles, under the arch of the ribs.
  torso.add(RoundCone{Vec3(0.036, 1.225, 0.074), Vec3(0.030, 0.960, 0.072), 0.031, 0.024}, 0.026);
  torso.carve(RoundCone{Vec3(0.062, 1.190, 0.118), Vec3(0.128, 1.105, 0.082), 0.012, 0.014}, 0.040);
  // Furrows of the spine and between the belly muscles.
  torso.carve(RoundCone{Vec3(0.0, 1.380, -0.142), Vec3(0.0, 1.090, -0.098), 0.012, 0.014}, 0.035);
  torso.carve(RoundCone{Vec3(0.0, 1.300, 0.122), Vec3(0.0, 1.080, 0.112), 0.007, 0.006}, 0.024);
  return torso;
}

Part make_head() {
  Part head(0.022);
  // Neck, leaning forward, with the muscle that runs from behind the ear to the collar bone.
  head.add(RoundCone{Vec3(0.0, 1.420, -0.040), Vec3(0.0, 1.590, -0.010), 0.059, 0.053}, 0.02);
  head.add(RoundCone{Vec3(0.056, 1.595, -0.022), Vec3(0.016, 1.440, 0.034), 0.013, 0.009}, 0.022);
  head.add(RoundCone{Vec3(0.0, 1.552, 0.036), Vec3(0.0, 1.520, 0.026), 0.012, 0.010}, 0.020);
  // Skull and face; the face's front profile is the loft's forward reach.
  head.add(Ellipsoid{Vec3(0.0, 1.662, -0.008), Vec3(0.0765, 0.088, 0.097)}, 0.03);
  head.add(Loft(Vec3(0.0), kX, kZ, kY,
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

}  // namespace nook_samples::mannequin
