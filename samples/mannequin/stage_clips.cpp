#include <cmath>

#include "samples/mannequin/clips.h"
#include "samples/mannequin/limb_placement.h"
#include "samples/mannequin/phase_curves.h"

namespace nook_samples::mannequin {
namespace {

const Vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

void lean_forward(Pose& pose, double spine_deg) {
  pose.turn("spine_01", kX, spine_deg * 0.35);
  pose.turn("spine_02", kX, spine_deg * 0.35);
  pose.turn("spine_03", kX, spine_deg * 0.30);
}

void look_up(Pose& pose, double degrees) {
  pose.turn("neck_01", kX, -0.5 * degrees);
  pose.turn("head", kX, -0.5 * degrees);
}

}  // namespace

Pose pose_crouch(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  const double deep = 0.5 - 0.5 * swing(phase, 0.25);
  const double look = swing(phase);
  pose.shift_pelvis({0.0, -0.20 - 0.22 * deep, -0.06 - 0.03 * deep});
  pose.turn("pelvis", kX, 16.0 + 4.0 * deep);
  lean_forward(pose, 22.0 + 10.0 * deep);
  look_up(pose, 30.0 + 10.0 * deep);
  pose.turn("spine_02", kY, 6.0 * look);
  pose.turn("head", kY, 14.0 * look);
  place_foot(pose, Side::kLeft,
             {bind_ball_m(Side::kLeft) + Vec3(0.06, 0.0, 0.07), 12.0, 6.0 + 16.0 * deep, 0.45});
  place_foot(pose, Side::kRight,
             {bind_ball_m(Side::kRight) + Vec3(-0.06, 0.0, -0.05), 14.0, 10.0 + 22.0 * deep, 0.45});
  const int chest = skeleton.find("spine_03");
  for (Side side : {Side::kLeft, Side::kRight}) {
    // Hands at the ready, between the knees and the chin.
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
  // On a seat 0.45 m high; the body rocks forward over the knees and back.
  const double forward = 0.5 - 0.5 * swing(phase, 0.25);
  pose.shift_pelvis({0.0, -0.390, -0.30});
  pose.turn("pelvis", kX, -10.0 + 12.0 * forward);
  lean_forward(pose, 12.0 + 20.0 * forward);
  look_up(pose, 6.0 + 16.0 * forward);
  pose.turn("head", kY, 10.0 * swing(phase, 0.3));
  place_foot(pose, Side::kLeft, {bind_ball_m(Side::kLeft) + Vec3(0.03, 0.0, 0.10), 6.0, 0.0, 0.22});
  place_foot(pose, Side::kRight, {bind_ball_m(Side::kRight) + Vec3(-0.03, 0.0, 0.03), 6.0, 4.0, 0.22});
  for (Side side : {Side::kLeft, Side::kRight}) {
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
  pose.turn("pelvis", kZ, 2.0 + sway);
  lean_forward(pose, -3.0);
  pose.turn("spine_02", kZ, -3.0 - sway);
  pose.turn("spine_03", kZ, -3.0);
  pose.turn("head", kZ, 5.0 + 2.0 * sway);
  pose.turn("head", kY, -6.0);
  place_foot(pose, Side::kLeft, {bind_ball_m(Side::kLeft), 3.0, 0.0, 0.15});
  place_foot(pose, Side::kRight, {bind_ball_m(Side::kRight) + Vec3(-0.02, 0.0, 0.04), 8.0, 0.0, 0.25});
  place_arm(pose, Side::kRight,
            {.upper = {0.92, 0.28 + 0.06 * sway, 0.28},
             .bends_to = {-0.15, 1.0, 0.10},
             .elbow_deg = 82.0 + 24.0 * shake,
             .roll_deg = 6.0,
             .wrist_deg = 0.0,
             .shrug_deg = 20.0});
  curl_fingers(pose, Side::kRight, 4.0, 0.0);
  place_arm(pose, Side::kLeft,
            {.upper = {0.24, -1.0, 0.0},
             .bends_to = {-0.15, 0.0, 1.0},
             .elbow_deg = 20.0,
             .roll_deg = 20.0,
             .shrug_deg = -5.0});
  close_fingers(pose, Side::kLeft, 0.8);
  curl_fingers(pose, Side::kLeft, 18.0, 13.0);
  return pose;
}

Pose pose_punch(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  // A jab with the left, then a cross with the right that turns the whole body.
  const double jab = pulse(phase, 0.06, 0.40, 0.15), cross = pulse(phase, 0.46, 0.90, 0.15);
  const double bounce = swing(2.0 * phase, 0.25);
  const double turn_deg = -30.0 - 14.0 * jab + 58.0 * cross;
  pose.shift_pelvis({0.0, -0.090 + 0.010 * bounce - 0.02 * cross, 0.02 + 0.04 * jab + 0.07 * cross});
  pose.turn("pelvis", kX, 5.0);
  pose.turn("pelvis", kY, 0.50 * turn_deg);
  lean_forward(pose, 12.0 + 5.0 * cross);
  pose.turn("spine_01", kY, 0.15 * turn_deg);
  pose.turn("spine_02", kY, 0.20 * turn_deg);
  pose.turn("spine_03", kY, 0.15 * turn_deg);
  pose.turn("neck_01", kY, -0.45 * turn_deg);
  pose.turn("head", kY, -0.45 * turn_deg);
  look_up(pose, 10.0);
  place_foot(pose, Side::kLeft, {bind_ball_m(Side::kLeft) + Vec3(0.02, 0.0, 0.20), -8.0, 0.0, 0.1});
  place_foot(
      pose, Side::kRight,
      {bind_ball_m(Side::kRight) + Vec3(-0.04, 0.0, -0.20), 30.0 - 30.0 * cross, 14.0 + 24.0 * cross, 0.3});
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
  guard(Side::kLeft, jab);
  guard(Side::kRight, cross);
  return pose;
}

Pose pose_dance(const Skeleton& skeleton, double phase) {
  Pose pose(skeleton);
  // The weight goes from foot to foot while the arms trade places overhead.
  const double side_step = swing(phase), beat = swing(2.0 * phase, 0.25);
  pose.shift_pelvis({0.075 * side_step, -0.070 - 0.030 * beat, 0.0});
  pose.turn("pelvis", kZ, 8.0 * side_step);
  pose.turn("pelvis", kY, 14.0 * swing(phase, 0.20));
  pose.turn("pelvis", kX, 4.0 + 4.0 * beat);
  pose.turn("spine_01", kZ, -7.0 * side_step);
  pose.turn("spine_02", kZ, -7.0 * side_step);
  pose.turn("spine_02", kY, -10.0 * swing(phase, 0.20));
  pose.turn("spine_03", kY, -10.0 * swing(phase, 0.20));
  pose.turn("spine_03", kX, -5.0 * beat);
  pose.turn("neck_01", kZ, 5.0 * side_step);
  pose.turn("head", kX, 6.0 * beat);
  pose.turn("head", kZ, 5.0 * side_step);
  for (Side side : {Side::kLeft, Side::kRight}) {
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

}  // namespace nook_samples::mannequin
