#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// Adds a leaf or a blade of grass: two triangles, bent in the middle.
void add_leaf(TriangleSoup& soup, Vec3 foot, Vec3 along, Vec3 across, float bend) {
  const Vec3 middle = foot + 0.5f * along, tip = foot + along - Vec3{0, bend, 0};
  add_triangle(soup, foot, middle + across, middle - across);
  add_triangle(soup, tip, middle - across, middle + across);
}

void add_grass(TriangleSoup& soup, float half, int blades, Random& random) {
  const float tall = random.between(0.05f, 0.35f), wide = random.between(0.003f, 0.012f);
  for (int i = 0; i < blades; ++i) {
    const Vec3 foot{random.between(-half, half), 0, random.between(-half, half)};
    const float angle = random.between(0, 6.2831853f), lean = tall * random.between(0, 0.6f);
    const Vec3 away{std::cos(angle), 0, std::sin(angle)};
    add_leaf(soup, foot, Vec3{0, tall * random.between(0.5f, 1), 0} + lean * away,
             wide * cross(away, {0, 1, 0}), lean * 0.5f);
  }
}

void add_leaves(TriangleSoup& soup, Vec3 middle, Vec3 half, int leaves, float size, Random& random) {
  for (int i = 0; i < leaves; ++i) {
    const Vec3 d = any_direction(random) * std::cbrt(random.between(0.1f, 1));
    const Vec3 foot = middle + Vec3{d.x * half.x, d.y * half.y, d.z * half.z};
    const Vec3 along = normalised(d + 0.8f * any_direction(random)) * (size * random.between(0.6f, 1.2f));
    add_leaf(soup, foot, along, 0.3f * length(along) * normalised(cross(along, any_direction(random))),
             0.2f * size);
  }
}

void add_tree(TriangleSoup& soup, Vec3 foot, Random& random) {
  const float tall = random.between(1, 2.5f), thick = random.between(0.04f, 0.15f);
  const Vec3 top = foot + Vec3{random.between(-0.2f, 0.2f), tall, random.between(-0.2f, 0.2f)};
  add_cylinder(soup, foot, top, thick, 0.6f * thick, 12);
  const int branches = random.whole(3, 9);
  for (int i = 0; i < branches; ++i) {
    const Vec3 from = foot + random.between(0.4f, 1.0f) * (top - foot);
    Vec3 away = any_direction(random);
    away.y = std::abs(away.y);
    const Vec3 to = from + random.between(0.3f, 0.9f) * away;
    add_cylinder(soup, from, to, 0.4f * thick, 0.15f * thick, 7);
    add_leaves(soup, to, {0.35f, 0.3f, 0.35f}, random.whole(60, 250), random.between(0.05f, 0.14f), random);
  }
}

}  // namespace

TrainingScene make_foliage(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 8);
  const float half = random.between(1.2f, 2.5f);
  if (random.chance(0.75f)) add_grass(soup, half, random.whole(1500, 9000), random);
  const int trees = random.whole(1, 4);
  for (int i = 0; i < trees; ++i)
    add_tree(soup, {random.between(-half, half), 0, random.between(-half, half)}, random);
  const int bushes = random.whole(2, 7);
  for (int i = 0; i < bushes; ++i) {
    const float size = random.between(0.2f, 0.6f);
    const Vec3 foot{random.between(-half, half), size * 0.8f, random.between(-half, half)};
    add_leaves(soup, foot, {size, size * 0.8f, size}, random.whole(200, 1500), random.between(0.03f, 0.12f),
               random);
    for (int s = 0; s < 6; ++s)
      add_rod(soup, {foot.x, 0, foot.z}, foot + 0.7f * size * any_direction(random), 0.008f, 5);
  }
  if (random.chance(0.6f)) add_block(soup, {-4, 0, -half - 0.3f}, {4, random.between(0.5f, 2.5f), -half});
  for (int i = 0; i < 8; ++i)
    add_crate_or_ball(soup, {random.between(-half, half), 0, random.between(-half, half)},
                      random.between(0.05f, 0.25f), random);
  scene.cameras = {{-half - 1, 0.3f, -half}, {half + 1, 2, half + 1.5f}};
  scene.subject = {{-half * 0.7f, 0, -half * 0.7f}, {half * 0.7f, 1.2f, half * 0.7f}};
  return scene;
}

}  // namespace nook::bake::nnao
