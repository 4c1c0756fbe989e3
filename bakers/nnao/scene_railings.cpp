#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {

void add_fence(TriangleSoup& soup, Vec3 from, Vec3 to, float height, float spacing, float thickness) {
  const int bars = std::max(1, int(length(to - from) / spacing));
  const Vec3 up{0, height, 0};
  for (int i = 0; i <= bars; ++i) {
    const Vec3 foot = from + (float(i) / float(bars)) * (to - from);
    add_rod(soup, foot, foot + up, thickness, 6);
  }
  add_rod(soup, from + up, to + up, 1.6f * thickness);
  add_rod(soup, from + 0.12f * up, to + 0.12f * up, thickness);
}

namespace {

// Adds a lattice of flat bars in the plane spanned by u and v.
void add_grille(TriangleSoup& soup, Vec3 corner, Vec3 u, Vec3 v, int columns, int rows, float thickness) {
  for (int i = 0; i <= columns; ++i) {
    const Vec3 foot = corner + (float(i) / float(columns)) * u;
    add_rod(soup, foot, foot + v, thickness, 4);
  }
  for (int i = 0; i <= rows; ++i) {
    const Vec3 foot = corner + (float(i) / float(rows)) * v;
    add_rod(soup, foot, foot + u, thickness, 4);
  }
}

// Adds a fence of pointed boards.
void add_picket_fence(TriangleSoup& soup, Vec3 from, Vec3 to, float height, Random& random) {
  const Vec3 along = normalised(to - from), back = cross(along, {0, 1, 0});
  const float width = random.between(0.05f, 0.1f), gap = width * random.between(0.3f, 1.2f);
  for (float at = 0; at < length(to - from); at += width + gap) {
    const Vec3 a = from + at * along, b = a + width * along, up{0, height, 0};
    for (const Vec3 shift : {Vec3{}, 0.02f * back}) {
      add_quad(soup, a + shift, b + shift, b + up + shift, a + up + shift);
      add_triangle(soup, a + up + shift, b + up + shift, 0.5f * (a + b) + 1.1f * up + shift);
    }
    add_quad(soup, a, a + 0.02f * back, a + up + 0.02f * back, a + up);
    add_quad(soup, b, b + 0.02f * back, b + up + 0.02f * back, b + up);
  }
  for (const float share : {0.25f, 0.75f}) {
    const Vec3 up{0, height * share, 0};
    add_rod(soup, from + up + 0.04f * back, to + up + 0.04f * back, 0.025f, 4);
  }
}

}  // namespace

TrainingScene make_railings(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 8);
  const int walls = random.whole(1, 4);
  for (int i = 0; i < walls; ++i)
    add_box(
        soup,
        standing_frame({random.between(-3, 3), 0.8f, random.between(-3.0f, 0.0f)}, random.between(0, 3.14f)),
        {random.between(0.4f, 2.5f), random.between(0.3f, 1.2f), random.between(0.05f, 0.4f)});
  const int fences = random.whole(4, 9);
  for (int i = 0; i < fences; ++i) {
    const float angle = random.chance(0.5f) ? 0 : random.between(0, 6.28f),
                reach = random.between(0.8f, 2.5f);
    const Vec3 middle{random.between(-2.5f, 2.5f), random.chance(0.3f) ? random.between(0, 0.5f) : 0,
                      random.between(-2.5f, 2.5f)};
    const Vec3 along{std::cos(angle) * reach, 0, std::sin(angle) * reach};
    const float height = random.between(0.5f, 1.6f);
    switch (random.below(4)) {
      case 0:
      case 1:
        add_fence(soup, middle - along, middle + along, height, random.between(0.06f, 0.3f),
                  random.log_between(0.004f, 0.03f));
        break;
      case 2:
        add_picket_fence(soup, middle - along, middle + along, height, random);
        break;
      default:
        add_grille(soup, middle - along, 2 * along, {0, height, 0}, random.whole(6, 24), random.whole(3, 12),
                   random.log_between(0.004f, 0.02f));
    }
  }
  const int things = random.whole(5, 25);
  for (int i = 0; i < things; ++i)
    add_crate_or_ball(soup, {random.between(-3, 3), 0, random.between(-3, 3)},
                      random.log_between(0.05f, 0.35f), random);
  scene.cameras = {{-3.5f, 0.4f, -1}, {3.5f, 2.4f, 4}};
  scene.subject = {{-2, 0, -2}, {2, 1, 2}};
  return scene;
}

}  // namespace nook::bake::nnao
