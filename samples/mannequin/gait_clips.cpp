#include <cmath>

#include "samples/mannequin/clips.h"
#include "samples/mannequin/limb_placement.h"
#include "samples/mannequin/phase_curves.h"
#include "samples/mannequin/ramp.h"

namespace nook_samples::mannequin {
namespace {

const Vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

/// A foot's cycle in place: it slides back while it stands and swings forward through the air.
struct Gait {
  double half_stride_m;
  double stance;  ///< Part of the cycle spent on the ground.
  double lift_m;
  double strike_deg;  ///< Toes up when the heel touches down.
  double push_deg;    ///< Heel up when the toes leave.
  double centre_m;    ///< Ahead of the bind pose.
  double narrow_m;    ///< Towards the middle, since walkers put their feet nearly in line.
};

void step(Pose& pose, Side side, const Gait& gait, double phase) {
  phase -= std::floor(phase);
  FootPlan plan;
  plan.ball_m = bind_ball_m(side);
  plan.ball_m.x -= gait.narrow_m * sign_of(side);
  plan.yaw_deg = -3.0;
  const double reach_m = gait.half_stride_m;
  if (phase < gait.stance) {
    const double t = phase / gait.stance;
    plan.ball_m.z += gait.centre_m + reach_m * (1.0 - 2.0 * t);
    plan.pitch_deg = -gait.strike_deg * (1.0 - ramp(t, 0.0, 0.22)) + gait.push_deg * ramp(t, 0.50, 1.06);
  } else {
    const double t = (phase - gait.stance) / (1.0 - gait.stance);
    // The foot leaves and lands at the ground's speed, so that the knee does not jerk.
    const double slip = gait.half_stride_m * 2.0 / gait.stance * (1.0 - gait.stance);
    const double eased = 3.0 * t * t - 2.0 * t * t * t;
    const double hermite = (t * t * t - 2.0 * t * t + t) + (t * t * t - t * t);
    plan.ball_m.z += gait.centre_m + reach_m * (2.0 * eased - 1.0) - slip * hermite * 0.6;
    plan.ball_m.y = gait.lift_m * std::pow(swing(0.5 * std::pow(t, 0.8)), 1.3);
    const double left_over = gait.push_deg * ramp(1.0, 0.50, 1.06);
    plan.pitch_deg = left_over + (gait.push_deg * 1.15 - left_over) * ramp(t, 0.0, 0.2) -
                     (gait.push_deg * 1.15 + gait.strike_deg) * ramp(t, 0.25, 0.92);
  }
  place_foot(pose, side, plan);
}

}  // namespace

Pose pose_idle(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  const double sway = swing(phase), breath = swing(2.0 * phase);
  pose.shift_pelvis({0.018 + 0.012 * sway, -0.008 + 0.002 * breath, -0.005});
  pose.turn("pelvis", kZ, 1.5 + 1.5 * sway);
  pose.turn("spine_01", kZ, -1.5 - 1.5 * sway);
  pose.turn("spine_02", kX, 1.5 - 1.0 * breath);
  pose.turn("spine_03", kX, -1.0 - 1.2 * breath);
  pose.turn("neck_01", kX, 2.0 + breath);
  pose.turn("head", kY, 7.0 * swing(phase, 0.1));
  place_foot(pose, Side::kLeft, {bind_ball_m(Side::kLeft), 2.0, 0.0, 0.15});
  place_foot(pose, Side::kRight, {bind_ball_m(Side::kRight) + Vec3(0.0, 0.0, 0.05), 8.0, 0.0, 0.25});
  for (Side side : {Side::kLeft, Side::kRight}) {
    place_arm(pose, side,
              {.upper = {0.23, -1.0, -0.02 + 0.015 * breath},
               .bends_to = {-0.15, 0.0, 1.0},
               .elbow_deg = 17.0 + 2.0 * breath,
               .roll_deg = 22.0,
               .wrist_deg = 4.0,
               .shrug_deg = -6.0 + breath});
    close_fingers(pose, side, 0.8);
    curl_fingers(pose, side, 15.0, 13.0);
  }
  return pose;
}

Pose pose_walk(const Skeleton& skeleton, double phase) {
  const Gait gait{0.27, 0.60, 0.055, 20.0, 38.0, -0.02, 0.055};
  Pose pose(skeleton);
  // The left heel strikes at phase 0, the right one half a cycle later. The body is lowest just after each
  // strike.
  pose.shift_pelvis({0.016 * swing(phase, -0.05), -0.026 + 0.014 * swing(2.0 * phase, -0.30), 0.0});
  const double lead = swing(phase, 0.25);  // +1 with the left leg ahead
  pose.turn("pelvis", kY, -6.0 * lead);
  pose.turn("pelvis", kZ, -2.5 * swing(phase, -0.05));
  pose.turn("pelvis", kX, 3.0);
  pose.turn("spine_01", kY, 3.0 * lead);
  pose.turn("spine_01", kZ, 2.0 * swing(phase, -0.05));
  pose.turn("spine_02", kY, 5.0 * lead);
  pose.turn("spine_03", kY, 4.0 * lead);
  pose.turn("neck_01", kY, -3.0 * lead);
  pose.turn("head", kY, -3.0 * lead);
  step(pose, Side::kLeft, gait, phase);
  step(pose, Side::kRight, gait, phase + 0.5);
  for (Side side : {Side::kLeft, Side::kRight}) {
    const double ahead = -sign_of(side) * swing(phase, 0.22);
    place_arm(pose, side,
              {.upper = {0.20, -1.0, 0.04 + 0.36 * ahead},
               .bends_to = {-0.08, 0.0, 1.0},
               .elbow_deg = 24.0 + 13.0 * ahead,
               .roll_deg = 15.0,
               .shrug_deg = -6.0,
               .reach_deg = 4.0 * ahead});
    close_fingers(pose, side, 0.8);
    curl_fingers(pose, side, 22.0, 14.0);
  }
  return pose;
}

Pose pose_run(const Skeleton& skeleton, double phase) {
  // Two strides a loop, since one alone is shorter than a clip should be.
  phase = 2.0 * phase - std::floor(2.0 * phase);
  const Gait gait{0.25, 0.34, 0.26, 4.0, 50.0, -0.10, 0.075};
  Pose pose(skeleton);
  // Lowest in the middle of each stance, highest in flight.
  pose.shift_pelvis({0.010 * swing(phase), -0.045 + 0.035 * swing(2.0 * phase, -0.59), 0.0});
  const double lead = swing(phase, 0.25);
  pose.turn("pelvis", kY, -9.0 * lead);
  pose.turn("pelvis", kX, 10.0);
  pose.turn("spine_01", kX, 3.0);
  pose.turn("spine_01", kY, 6.0 * lead);
  pose.turn("spine_02", kY, 9.0 * lead);
  pose.turn("spine_03", kY, 7.0 * lead);
  pose.turn("neck_01", kX, -5.0);
  pose.turn("neck_01", kY, -7.0 * lead);
  pose.turn("head", kX, -4.0);
  pose.turn("head", kY, -6.0 * lead);
  step(pose, Side::kLeft, gait, phase);
  step(pose, Side::kRight, gait, phase + 0.5);
  for (Side side : {Side::kLeft, Side::kRight}) {
    const double ahead = -sign_of(side) * swing(phase, 0.20);
    place_arm(pose, side,
              {.upper = {0.40, -1.0, -0.10 + 0.72 * ahead},
               .bends_to = {-0.14 - 0.14 * ahead, 0.1, 1.0},
               .elbow_deg = 88.0 + 14.0 * ahead,
               .roll_deg = 10.0,
               .reach_deg = 7.0 * ahead});
    close_fingers(pose, side, 1.0);
    curl_fingers(pose, side, 46.0, 18.0);
  }
  return pose;
}

}  // namespace nook_samples::mannequin
