#include "bakers/mannequin/motions.h"

#include <cmath>
#include <numbers>

#include "bakers/mannequin/pose.h"
#include "bakers/mannequin/shape_primitives.h"

namespace nook::mannequin {
namespace {

/// Returns a sine wave with one period per loop, shifted so that it comes `lead` loops earlier.
double swing(double phase, double lead = 0.0) {
  return std::sin(2.0 * std::numbers::pi * (phase + lead));
}

/// Rises from 0 to 1 and falls back to 0 between the phases `from` and `to`. It stays at 1 for a share of
/// `hold` of this time.
double pulse(double phase, double from, double to, double hold = 0.2) {
  const double edge = 0.5 * (1.0 - hold) * (to - from);
  return ramp(phase, from, from + edge) * (1.0 - ramp(phase, to - edge, to));
}

/// A foot's cycle when walking in place: the foot slides backwards while it is on the ground, then it swings
/// forwards through the air.
struct Gait {
  double half_stride_m;
  double stance;  ///< Share of the cycle in which the foot is on the ground.
  double lift_m;
  double strike_deg;  ///< How far the toes are raised when the heel touches down.
  double push_deg;    ///< How far the heel is raised when the toes leave the ground.
  double centre_m;    ///< How far the middle of the cycle is ahead of the bind pose.
  double narrow_m;    ///< How far the foot is moved inwards: people walk with their feet nearly in line.
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
    // The foot leaves and reaches the ground with the speed of the ground, so that the knee does not jerk.
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
  pose.turn("pelvis", z_axis, 1.5 + 1.5 * sway);
  pose.turn("spine_01", z_axis, -1.5 - 1.5 * sway);
  pose.turn("spine_02", x_axis, 1.5 - 1.0 * breath);
  pose.turn("spine_03", x_axis, -1.0 - 1.2 * breath);
  pose.turn("neck_01", x_axis, 2.0 + breath);
  pose.turn("head", y_axis, 7.0 * swing(phase, 0.1));
  place_foot(pose, Side::left, {bind_ball_m(Side::left), 2.0, 0.0, 0.15});
  place_foot(pose, Side::right, {bind_ball_m(Side::right) + Vec3(0.0, 0.0, 0.05), 8.0, 0.0, 0.25});
  for (Side side : {Side::left, Side::right}) {
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
  // The left heel touches down at phase 0, and the right heel half a cycle later. The body is lowest just
  // after each of these moments.
  pose.shift_pelvis({0.016 * swing(phase, -0.05), -0.026 + 0.014 * swing(2.0 * phase, -0.30), 0.0});
  const double lead = swing(phase, 0.25);  // +1 when the left leg is ahead
  pose.turn("pelvis", y_axis, -6.0 * lead);
  pose.turn("pelvis", z_axis, -2.5 * swing(phase, -0.05));
  pose.turn("pelvis", x_axis, 3.0);
  pose.turn("spine_01", y_axis, 3.0 * lead);
  pose.turn("spine_01", z_axis, 2.0 * swing(phase, -0.05));
  pose.turn("spine_02", y_axis, 5.0 * lead);
  pose.turn("spine_03", y_axis, 4.0 * lead);
  pose.turn("neck_01", y_axis, -3.0 * lead);
  pose.turn("head", y_axis, -3.0 * lead);
  step(pose, Side::left, gait, phase);
  step(pose, Side::right, gait, phase + 0.5);
  for (Side side : {Side::left, Side::right}) {
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
  // Two strides per loop, because a clip with a single stride would be too short.
  phase = 2.0 * phase - std::floor(2.0 * phase);
  const Gait gait{0.25, 0.34, 0.26, 4.0, 50.0, -0.10, 0.075};
  Pose pose(skeleton);
  // The body is lowest in the middle of each stance, and highest while both feet are in the air.
  pose.shift_pelvis({0.010 * swing(phase), -0.045 + 0.035 * swing(2.0 * phase, -0.59), 0.0});
  const double lead = swing(phase, 0.25);
  pose.turn("pelvis", y_axis, -9.0 * lead);
  pose.turn("pelvis", x_axis, 10.0);
  pose.turn("spine_01", x_axis, 3.0);
  pose.turn("spine_01", y_axis, 6.0 * lead);
  pose.turn("spine_02", y_axis, 9.0 * lead);
  pose.turn("spine_03", y_axis, 7.0 * lead);
  pose.turn("neck_01", x_axis, -5.0);
  pose.turn("neck_01", y_axis, -7.0 * lead);
  pose.turn("head", x_axis, -4.0);
  pose.turn("head", y_axis, -6.0 * lead);
  step(pose, Side::left, gait, phase);
  step(pose, Side::right, gait, phase + 0.5);
  for (Side side : {Side::left, Side::right}) {
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

namespace {

void lean_forward(Pose& pose, double spine_deg) {
  pose.turn("spine_01", x_axis, spine_deg * 0.35);
  pose.turn("spine_02", x_axis, spine_deg * 0.35);
  pose.turn("spine_03", x_axis, spine_deg * 0.30);
}

void look_up(Pose& pose, double degrees) {
  pose.turn("neck_01", x_axis, -0.5 * degrees);
  pose.turn("head", x_axis, -0.5 * degrees);
}

}  // namespace

Pose pose_crouch(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  const double deep = 0.5 - 0.5 * swing(phase, 0.25);
  const double look = swing(phase);
  pose.shift_pelvis({0.0, -0.20 - 0.22 * deep, -0.06 - 0.03 * deep});
  pose.turn("pelvis", x_axis, 16.0 + 4.0 * deep);
  lean_forward(pose, 22.0 + 10.0 * deep);
  look_up(pose, 30.0 + 10.0 * deep);
  pose.turn("spine_02", y_axis, 6.0 * look);
  pose.turn("head", y_axis, 14.0 * look);
  place_foot(pose, Side::left,
             {bind_ball_m(Side::left) + Vec3(0.06, 0.0, 0.07), 12.0, 6.0 + 16.0 * deep, 0.45});
  place_foot(pose, Side::right,
             {bind_ball_m(Side::right) + Vec3(-0.06, 0.0, -0.05), 14.0, 10.0 + 22.0 * deep, 0.45});
  const int chest = skeleton.find("spine_03");
  for (Side side : {Side::left, Side::right}) {
    // The hands are ready to act, between the knees and the chin.
    const double s = sign_of(side);
    const Vec3 wrist(s * 0.13, 1.27 + 0.04 * deep, 0.42 + 0.02 * s * look);
    place_hand(pose, side,
               {.wrist_m = pose.carried_m(chest, wrist),
                .elbow_to = {s * 0.9, -0.6, -0.2},
                .fingers_to = {-s * 0.25, 0.25, 1.0},
                .back_of_hand = {s * 0.9, 0.5, 0.0},
                .reach_deg = 8.0});
    close_fingers(pose, side, 0.6);
    curl_fingers(pose, side, 24.0, 8.0);
  }
  return pose;
}

Pose pose_sit(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  // Sits on a seat 0.45 m high. The body rocks forwards over the knees and backwards again.
  const double forward = 0.5 - 0.5 * swing(phase, 0.25);
  pose.shift_pelvis({0.0, -0.390, -0.30});
  pose.turn("pelvis", x_axis, -10.0 + 12.0 * forward);
  lean_forward(pose, 12.0 + 20.0 * forward);
  look_up(pose, 6.0 + 16.0 * forward);
  pose.turn("head", y_axis, 10.0 * swing(phase, 0.3));
  place_foot(pose, Side::left, {bind_ball_m(Side::left) + Vec3(0.03, 0.0, 0.10), 6.0, 0.0, 0.22});
  place_foot(pose, Side::right, {bind_ball_m(Side::right) + Vec3(-0.03, 0.0, 0.03), 6.0, 4.0, 0.22});
  for (Side side : {Side::left, Side::right}) {
    // The hands lie on the thighs and slide towards the knees as the body leans.
    const double s = sign_of(side);
    const int thigh = skeleton.find(sided("thigh", side));
    const Quat facing = pose.facing(thigh);
    place_hand(
        pose, side,
        {.wrist_m = pose.carried_m(thigh, Vec3(s * 0.112, 0.735 - 0.075 * forward, 0.128 - 0.008 * forward)),
         .elbow_to = {s * 0.8, -0.3, -0.6},
         .fingers_to = facing * Vec3(-s * 0.22, -1.0, -0.02),
         .back_of_hand = facing * Vec3(s * 0.22, 0.06, 1.0),
         .reach_deg = 4.0 + 4.0 * forward});
    close_fingers(pose, side, 0.3);
    curl_fingers(pose, side, 6.0, 0.0);
  }
  return pose;
}

Pose pose_wave(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  const double sway = swing(phase), shake = swing(3.0 * phase);
  pose.shift_pelvis({0.020 + 0.008 * sway, -0.012, 0.0});
  pose.turn("pelvis", z_axis, 2.0 + sway);
  lean_forward(pose, -3.0);
  pose.turn("spine_02", z_axis, -3.0 - sway);
  pose.turn("spine_03", z_axis, -3.0);
  pose.turn("head", z_axis, 5.0 + 2.0 * sway);
  pose.turn("head", y_axis, -6.0);
  place_foot(pose, Side::left, {bind_ball_m(Side::left), 3.0, 0.0, 0.15});
  place_foot(pose, Side::right, {bind_ball_m(Side::right) + Vec3(-0.02, 0.0, 0.04), 8.0, 0.0, 0.25});
  place_arm(pose, Side::right,
            {.upper = {0.92, 0.28 + 0.06 * sway, 0.28},
             .bends_to = {-0.15, 1.0, 0.10},
             .elbow_deg = 82.0 + 24.0 * shake,
             .roll_deg = 6.0,
             .wrist_deg = 0.0,
             .shrug_deg = 20.0});
  curl_fingers(pose, Side::right, 4.0, 0.0);
  place_arm(pose, Side::left,
            {.upper = {0.24, -1.0, 0.0},
             .bends_to = {-0.15, 0.0, 1.0},
             .elbow_deg = 20.0,
             .roll_deg = 20.0,
             .shrug_deg = -5.0});
  close_fingers(pose, Side::left, 0.8);
  curl_fingers(pose, Side::left, 18.0, 13.0);
  return pose;
}

Pose pose_punch(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  // A jab with the left hand, then a cross with the right hand, which turns the whole body.
  const double jab = pulse(phase, 0.06, 0.40, 0.15), cross = pulse(phase, 0.46, 0.90, 0.15);
  const double bounce = swing(2.0 * phase, 0.25);
  const double turn_deg = -30.0 - 14.0 * jab + 58.0 * cross;
  pose.shift_pelvis({0.0, -0.090 + 0.010 * bounce - 0.02 * cross, 0.02 + 0.04 * jab + 0.07 * cross});
  pose.turn("pelvis", x_axis, 5.0);
  pose.turn("pelvis", y_axis, 0.50 * turn_deg);
  lean_forward(pose, 12.0 + 5.0 * cross);
  pose.turn("spine_01", y_axis, 0.15 * turn_deg);
  pose.turn("spine_02", y_axis, 0.20 * turn_deg);
  pose.turn("spine_03", y_axis, 0.15 * turn_deg);
  pose.turn("neck_01", y_axis, -0.45 * turn_deg);
  pose.turn("head", y_axis, -0.45 * turn_deg);
  look_up(pose, 10.0);
  place_foot(pose, Side::left, {bind_ball_m(Side::left) + Vec3(0.02, 0.0, 0.20), -8.0, 0.0, 0.1});
  place_foot(
      pose, Side::right,
      {bind_ball_m(Side::right) + Vec3(-0.04, 0.0, -0.20), 30.0 - 30.0 * cross, 14.0 + 24.0 * cross, 0.3});
  const auto guard = [&](Side side, double punch) {
    const Vec3 upper = glm::mix(Vec3(0.26, -0.85, 0.50), Vec3(-0.06, 0.12, 1.0), punch);
    place_arm(pose, side,
              {.upper = upper,
               .bends_to = glm::mix(Vec3(-0.22, 1.0, 0.45), Vec3(-0.25, 0.9, 0.3), punch),
               .elbow_deg = 126.0 - 120.0 * punch,
               .roll_deg = 15.0 + 60.0 * punch,
               .shrug_deg = 4.0 + 8.0 * punch,
               .reach_deg = 6.0 + 22.0 * punch});
    make_fist(pose, side);
  };
  guard(Side::left, jab);
  guard(Side::right, cross);
  return pose;
}

Pose pose_dance(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  // The weight shifts from foot to foot, while the arms move alternately above the head.
  const double side_step = swing(phase), beat = swing(2.0 * phase, 0.25);
  pose.shift_pelvis({0.075 * side_step, -0.070 - 0.030 * beat, 0.0});
  pose.turn("pelvis", z_axis, 8.0 * side_step);
  pose.turn("pelvis", y_axis, 14.0 * swing(phase, 0.20));
  pose.turn("pelvis", x_axis, 4.0 + 4.0 * beat);
  pose.turn("spine_01", z_axis, -7.0 * side_step);
  pose.turn("spine_02", z_axis, -7.0 * side_step);
  pose.turn("spine_02", y_axis, -10.0 * swing(phase, 0.20));
  pose.turn("spine_03", y_axis, -10.0 * swing(phase, 0.20));
  pose.turn("spine_03", x_axis, -5.0 * beat);
  pose.turn("neck_01", z_axis, 5.0 * side_step);
  pose.turn("head", x_axis, 6.0 * beat);
  pose.turn("head", z_axis, 5.0 * side_step);
  for (Side side : {Side::left, Side::right}) {
    const double s = sign_of(side);
    const double free = std::max(0.0, -s * side_step);
    FootPlan plan;
    plan.ball_m = bind_ball_m(side) + Vec3(s * 0.06, 0.06 * free * free, 0.05 * free);
    plan.yaw_deg = 8.0;
    plan.pitch_deg = 30.0 * free;
    plan.knee_out = 0.25 + 0.25 * free;
    place_foot(pose, side, plan);
    const double up = 0.5 + 0.5 * s * swing(phase, 0.08);
    place_arm(pose, side,
              {.upper = glm::mix(Vec3(0.70, -0.62, 0.30), Vec3(0.72, 0.72, 0.22), up),
               .bends_to = glm::mix(Vec3(-0.3, 0.25, 1.0), Vec3(-0.8, 0.7, 0.35), up),
               .elbow_deg = 78.0 - 22.0 * up + 8.0 * beat,
               .roll_deg = 25.0 - 20.0 * up,
               .wrist_deg = 12.0 * beat,
               .shrug_deg = 22.0 * up,
               .reach_deg = 4.0});
    close_fingers(pose, side, 0.4);
    curl_fingers(pose, side, 18.0 + 8.0 * beat, 6.0);
  }
  return pose;
}

const std::vector<Clip>& all_clips() {
  static const std::vector<Clip> clips = {
      {"Idle", 4.0, pose_idle},     {"Walk", 1.1, pose_walk},   {"Run", 1.4, pose_run},
      {"Crouch", 3.0, pose_crouch}, {"Sit", 4.0, pose_sit},     {"Wave", 2.4, pose_wave},
      {"Punch", 1.6, pose_punch},   {"Dance", 2.0, pose_dance},
  };
  return clips;
}

}  // namespace nook::mannequin
