#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {

void add_crate_or_ball(TriangleSoup& soup, Vec3 foot, float size, Random& random) {
  const Vec3 middle = foot + Vec3{0, size, 0};
  const auto stretch = [&] { return size * random.between(0.4f, 1.0f); };
  switch (random.below(6)) {
    case 0:
    case 1: {
      const Vec3 half{stretch(), size, stretch()};
      add_box(soup, standing_frame(middle, random.between(0, 6.28f)), half);
      break;
    }
    case 2:
      add_ellipsoid(soup, standing_frame(middle, 0), {size, size, size}, 24);
      break;
    case 3:
      add_cylinder(soup, foot, foot + Vec3{0, 2 * size, 0}, stretch(), stretch(), 18);
      break;
    case 4:
      add_box(soup, tumbled_frame(middle, random), {stretch(), stretch(), stretch()});
      break;
    default: {
      const Mat3x4 frame = tumbled_frame(middle, random);
      add_torus(soup, frame, 0.7f * size, 0.2f * size);
    }
  }
}

TrainingScene make_clutter(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float half = random.between(1.5f, 3.5f);
  add_floor(soup, 3 * half);
  if (random.chance(0.7f))
    add_block(soup, {-half - 0.2f, 0, -half - 0.2f}, {half, random.between(0.5f, 3), -half});
  if (random.chance(0.5f)) add_block(soup, {-half - 0.2f, 0, -half}, {-half, random.between(0.5f, 3), half});
  const int things = random.whole(40, 220);
  const float largest = random.between(0.15f, 0.6f);
  for (int i = 0; i < things; ++i) {
    // Objects are denser near the middle. Where they are crowded, they are stacked.
    const float reach = half * random.unit();
    const float angle = random.between(0, 6.2831853f);
    const float size = largest * random.log_between(0.12f, 1);
    const float lift = random.chance(0.3f) ? random.between(0, 2 * largest) : 0;
    add_crate_or_ball(soup, {reach * std::cos(angle), lift, reach * std::sin(angle)}, size, random);
  }
  const int planks = random.whole(0, 12);
  for (int i = 0; i < planks; ++i) {
    const Mat3x4 frame = tumbled_frame(
        {random.between(-half, half) * 0.7f, random.between(0.2f, 0.9f), random.between(-half, half) * 0.7f},
        random);
    add_box(soup, frame, {random.between(0.3f, 1.0f), 0.012f, random.between(0.03f, 0.12f)});
  }
  scene.cameras = {{-1.6f * half, 0.4f, -0.9f * half}, {1.6f * half, 2.5f, 1.8f * half}};
  scene.subject = {{-half * 0.7f, 0, -half * 0.7f}, {half * 0.7f, 0.8f, half * 0.7f}};
  return scene;
}

}  // namespace nook::bake::nnao
