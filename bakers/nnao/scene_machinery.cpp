#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// Adds a pipe with right-angle bends, and flanges at the bends.
void add_pipe(TriangleSoup& soup, Vec3 from, float radius, Random& random) {
  const int bends = random.whole(2, 6);
  int axis = random.whole(0, 2);
  for (int i = 0; i < bends; ++i) {
    Vec3 to = from;
    float* const coordinate = axis == 0 ? &to.x : axis == 1 ? &to.y : &to.z;
    const float step = random.between(0.3f, 1.5f);
    *coordinate += (axis == 1 ? *coordinate > 1.2f : *coordinate > 0) ? -step : step;
    add_capsule(soup, from, to, radius, 12);
    const Vec3 along = normalised(to - from);
    if (random.chance(0.6f))
      add_rod(soup, from + 2 * radius * along, from + 2.4f * radius * along, 1.5f * radius, 14);
    from = to;
    axis = (axis + random.whole(1, 2)) % 3;
  }
}

void add_wheel(TriangleSoup& soup, const Mat3x4& frame, float radius, Random& random) {
  const Vec3 hub = transform_point(frame, {}), axle = transform_vector(frame, {0, 0.3f * radius, 0});
  add_torus(soup, frame, radius, radius * random.between(0.05f, 0.15f), 28);
  add_rod(soup, hub - axle, hub + axle, 0.15f * radius, 10);
  const int spokes = random.whole(3, 10);
  for (int i = 0; i < spokes; ++i) {
    const float angle = 6.2831853f * float(i) / float(spokes);
    add_rod(soup, hub, transform_point(frame, {radius * std::cos(angle), 0, radius * std::sin(angle)}),
            0.05f * radius, 6);
  }
  if (random.chance(0.5f))
    for (int i = 0; i < 24; ++i) {
      const float angle = 6.2831853f * float(i) / 24, out = 1.1f * radius;
      add_box(soup,
              frame * Mat3x4{{std::cos(angle), 0, -std::sin(angle), out * std::cos(angle), 0, 1, 0, 0,
                              std::sin(angle), 0, std::cos(angle), out * std::sin(angle)}},
              {0.06f * radius, 0.1f * radius, 0.05f * radius});
    }
}

// Adds a cable that hangs between two points.
void add_cable(TriangleSoup& soup, Vec3 from, Vec3 to, float sag, float radius) {
  constexpr int parts = 10;
  Vec3 before = from;
  for (int i = 1; i <= parts; ++i) {
    const float t = float(i) / parts;
    const Vec3 at = from + t * (to - from) - Vec3{0, 4 * sag * t * (1 - t), 0};
    add_rod(soup, before, at, radius, 6);
    before = at;
  }
}

// Adds a housing with ribs, bolts and a recess.
void add_housing(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const Vec3 half{random.between(0.2f, 0.7f), random.between(0.2f, 0.7f), random.between(0.2f, 0.5f)};
  const Mat3x4 lifted = frame * Mat3x4{{1, 0, 0, 0, 0, 1, 0, half.y, 0, 0, 1, 0}};
  add_box(soup, lifted, half);
  const int ribs = random.whole(0, 9);
  for (int i = 0; i < ribs; ++i) {
    const float x = half.x * (2 * (float(i) + 0.5f) / float(ribs) - 1);
    add_box(soup, lifted * Mat3x4{{1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, half.z}},
            {0.015f, half.y * 0.85f, random.between(0.02f, 0.08f)});
  }
  for (const float x : {-0.85f, 0.85f})
    for (const float z : {-0.85f, 0.85f}) {
      const Vec3 bolt = transform_point(lifted, {x * half.x, half.y, z * half.z});
      add_rod(soup, bolt, bolt + Vec3{0, 0.03f, 0}, 0.03f, 6);
    }
}

}  // namespace

TrainingScene make_machinery(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 6);
  if (random.chance(0.7f)) add_block(soup, {-4, 0, -2.2f}, {4, 3, -2});
  if (random.chance(0.3f)) add_block(soup, {-4, 2.6f, -2}, {4, 2.8f, 3});
  const auto place = [&](float y) {
    return Vec3{random.between(-1.8f, 1.8f), y, random.between(-1.8f, 1.8f)};
  };
  const int housings = random.whole(2, 7), pipes = random.whole(4, 14), wheels = random.whole(1, 6);
  for (int i = 0; i < housings; ++i)
    add_housing(soup, standing_frame(place(0), random.between(0, 6.28f)), random);
  for (int i = 0; i < pipes; ++i)
    add_pipe(soup, place(random.between(0.2f, 2)), random.log_between(0.015f, 0.15f), random);
  for (int i = 0; i < wheels; ++i)
    add_wheel(soup, tumbled_frame(place(random.between(0.3f, 1.2f)), random), random.between(0.15f, 0.5f),
              random);
  const int tanks = random.whole(0, 3);
  for (int i = 0; i < tanks; ++i) {
    const Vec3 foot = place(0.4f);
    add_capsule(soup, foot, foot + Vec3{0, random.between(0.5f, 1.3f), 0}, random.between(0.2f, 0.45f), 24);
  }
  for (int i = 0; i < 8; ++i)
    add_cable(soup, place(random.between(0.8f, 2.4f)), place(random.between(0.8f, 2.4f)),
              random.between(0.1f, 0.6f), random.log_between(0.006f, 0.03f));
  scene.cameras = {{-3.2f, 0.3f, -1.5f}, {3.2f, 2.4f, 3.2f}};
  scene.subject = {{-1.5f, 0, -1.5f}, {1.5f, 1.5f, 1.5f}};
  return scene;
}

}  // namespace nook::bake::nnao
