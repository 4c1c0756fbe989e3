#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// Adds two bones with a joint between them. `bend` moves the joint away from the middle. Returns the
// direction of the second bone.
Vec3 add_limb(TriangleSoup& soup, Vec3 from, Vec3 to, Vec3 bend, float thick, float thin) {
  const Vec3 joint = 0.5f * (from + to) + bend;
  add_capsule(soup, from, joint, thick, 14);
  add_capsule(soup, joint, to, thin, 14);
  return normalised(to - joint);
}

void add_hand(TriangleSoup& soup, Vec3 wrist, Vec3 along, Random& random) {
  Vec3 u, v;
  axes_across(along, u, v);
  const float spread = random.between(0.1f, 0.7f), curl = random.between(-0.2f, 0.8f);
  const Vec3 palm = wrist + 0.09f * along;
  add_capsule(soup, wrist, palm, 0.03f, 10);
  for (int f = 0; f < 5; ++f) {
    const float side = (float(f) - 2) * 0.5f;
    const Vec3 foot = palm + 0.035f * side * u;
    const Vec3 way = normalised(along + spread * side * u + 0.3f * curl * v);
    const Vec3 knuckle = foot + 0.04f * way;
    add_capsule(soup, foot, knuckle, 0.009f, 8);
    add_capsule(soup, knuckle, knuckle + 0.045f * normalised(way + curl * v), 0.008f, 8);
  }
}

void add_person(TriangleSoup& soup, const Mat3x4& frame, bool sitting, Random& random) {
  const float tall = random.between(0.85f, 1.1f);
  const auto at = [&](float x, float y, float z) {
    return transform_point(frame, {tall * x, tall * y, tall * z});
  };
  const auto vary = [&](float reach) { return random.between(-reach, reach); };
  const float hip = sitting ? 0.5f : 0.92f, lean = vary(0.12f);
  const Vec3 pelvis = at(0, hip, 0), chest = at(vary(0.05f), hip + 0.42f, lean);
  add_capsule(soup, at(-0.09f, hip, 0), at(0.09f, hip, 0), 0.13f * tall, 16);
  add_capsule(soup, pelvis, chest, random.between(0.12f, 0.17f) * tall, 18);
  add_capsule(soup, chest + at(-0.14f, 0, 0) - at(0, 0, 0), chest + at(0.14f, 0, 0) - at(0, 0, 0),
              0.085f * tall, 14);
  Mat3x4 head = frame;
  const Vec3 skull = chest + at(vary(0.04f), 0.3f, 0.03f) - at(0, 0, 0);
  head.m[3] = skull.x;
  head.m[7] = skull.y;
  head.m[11] = skull.z;
  add_capsule(soup, chest, skull, 0.055f * tall, 12);
  add_ellipsoid(soup, head, {0.085f * tall, 0.12f * tall, 0.1f * tall}, 24);
  for (const float side : {-1.0f, 1.0f}) {
    const Vec3 shoulder = chest + at(0.2f * side, 0.05f, 0) - at(0, 0, 0);
    const Vec3 wrist =
        shoulder +
        at(side * random.between(0, 0.35f), random.between(-0.5f, 0.3f), random.between(-0.1f, 0.4f)) -
        at(0, 0, 0);
    add_hand(soup, wrist,
             add_limb(soup, shoulder, wrist, at(0.08f * side, -0.05f, -0.08f) - at(0, 0, 0), 0.05f * tall,
                      0.04f * tall),
             random);
    const float stride = vary(0.3f);
    const Vec3 ankle =
        sitting ? at(0.12f * side, 0.08f, 0.45f) : at(0.1f * side + vary(0.08f), 0.08f, stride);
    add_limb(soup, at(0.09f * side, hip, 0), ankle,
             sitting ? at(0, 0.22f, 0.2f) - at(0, 0, 0) : at(0, 0.05f, 0.06f) - at(0, 0, 0), 0.08f * tall,
             0.055f * tall);
    add_capsule(soup, ankle - at(0, 0.03f, 0.03f) + at(0, 0, 0), ankle + at(0, -0.03f, 0.15f) - at(0, 0, 0),
                0.045f * tall, 10);
  }
}

}  // namespace

TrainingScene make_people(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 6);
  if (random.chance(0.6f)) add_block(soup, {-3, 0, -1.6f}, {3, 2.6f, -1.4f});
  const int people = random.whole(2, 7);
  for (int i = 0; i < people; ++i) {
    const Mat3x4 frame = standing_frame({random.between(-1.4f, 1.4f), 0, random.between(-1.2f, 1.2f)},
                                        random.between(0, 6.28f));
    const bool sitting = random.chance(0.3f);
    if (sitting) add_chair(soup, frame, random);
    add_person(soup, frame, sitting, random);
  }
  for (int i = 0; i < 10; ++i)
    add_crate_or_ball(soup, {random.between(-2, 2), 0, random.between(-1.5f, 2)},
                      random.log_between(0.04f, 0.3f), random);
  if (random.chance(0.5f))
    add_table(soup, standing_frame({random.between(-1, 1), 0, random.between(-1, 1)}, random.between(0, 3)),
              random);
  scene.cameras = {{-2.4f, 0.4f, -1}, {2.4f, 2.2f, 2.8f}};
  scene.subject = {{-1, 0, -1}, {1, 1.6f, 1}};
  return scene;
}

}  // namespace nook::bake::nnao
