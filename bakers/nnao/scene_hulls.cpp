#include <algorithm>

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

Mat3x4 at(Vec3 place) {
  return {{1, 0, 0, place.x, 0, 1, 0, place.y, 0, 0, 1, place.z}};
}

// Adds plates and boxes of all sizes to one side of a section. `axis` is 1 (y) or 2 (z), and `out` is the
// direction along it, +1 or -1.
void add_plating(TriangleSoup& soup, Vec3 middle, Vec3 half, int axis, float out, int pieces,
                 Random& random) {
  for (int i = 0; i < pieces; ++i) {
    const float size = random.log_between(0.008f, 0.12f), rise = random.log_between(0.003f, 0.05f);
    Vec3 piece{size * random.between(0.5f, 2), size, size}, place = middle;
    place.x += random.between(-1, 1) * (half.x - 0.5f * size);
    if (axis == 1) {
      piece.y = rise;
      place.y += out * half.y;
      place.z += random.between(-0.9f, 0.9f) * half.z;
    } else {
      piece.z = rise;
      place.z += out * half.z;
      place.y += random.between(-0.9f, 0.9f) * half.y;
    }
    // The hull is mirrored in z.
    for (const float mirror : {1.0f, -1.0f}) add_box(soup, at({place.x, place.y, mirror * place.z}), piece);
  }
}

void add_engine(TriangleSoup& soup, Vec3 place, float radius, float length, Random& random) {
  const Vec3 tail = place - Vec3{length, 0, 0};
  add_cylinder(soup, place, tail, random.between(0.6f, 1) * radius, radius, 20);
  const int rings = random.whole(1, 4);
  for (int i = 0; i < rings; ++i) {
    const Vec3 hub = place - Vec3{length * (float(i) + 0.5f) / float(rings), 0, 0};
    add_cylinder(soup, hub, hub + Vec3{0.04f, 0, 0}, 1.1f * radius, 1.1f * radius, 20);
  }
  // Adds the nozzle: an open bell that points along -x.
  const Mat3x4 backwards{{0, -1, 0, tail.x, 1, 0, 0, tail.y, 0, 0, 1, tail.z}};
  add_lathe(
      soup, backwards,
      {{{0.5f * radius, 0}, {0.8f * radius, 0.4f * radius}, {radius, random.between(0.6f, 1.2f) * radius}}});
}

void add_wing(TriangleSoup& soup, Vec3 root, float span, float chord, float lift, Random& random) {
  const float thick = random.between(0.008f, 0.03f), sweep = random.between(-0.6f, 0.2f) * span;
  const float tip = random.between(0.3f, 0.8f) * chord;
  for (const float side : {1.0f, -1.0f}) {
    const auto corner = [&](float along, float out, float up) {
      const float c = chord + (tip - chord) * out;
      return Vec3{root.x + sweep * out + along * c, root.y + lift * out + up * thick,
                  side * (root.z + span * out)};
    };
    for (const float up : {-1.0f, 1.0f})
      add_quad(soup, corner(-1, 0, up), corner(1, 0, up), corner(1, 1, up), corner(-1, 1, up));
    for (const float along : {-1.0f, 1.0f})
      add_quad(soup, corner(along, 0, -1), corner(along, 1, -1), corner(along, 1, 1), corner(along, 0, 1));
    add_quad(soup, corner(-1, 1, -1), corner(1, 1, -1), corner(1, 1, 1), corner(-1, 1, 1));
    if (random.chance(0.5f))
      add_rod(soup, corner(1.5f, 1, 0), corner(-1.2f, 1, 0), random.between(0.01f, 0.04f));
  }
}

}  // namespace

TrainingScene make_hull(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float lift = random.between(0.4f, 0.7f);
  if (random.chance(0.4f)) add_floor(soup, 6);
  float x = 1;
  const int sections = random.whole(3, 6);
  for (int i = 0; i < sections; ++i) {
    const Vec3 half{random.between(0.12f, 0.35f), random.between(0.06f, 0.2f), random.between(0.08f, 0.3f)};
    const Vec3 middle{x - half.x, lift + random.between(-0.05f, 0.05f), 0};
    if (random.chance(0.25f))
      add_capsule(soup, middle - Vec3{half.x, 0, 0}, middle + Vec3{half.x, 0, 0}, half.y, 24);
    else
      add_box(soup, at(middle), half);
    for (const int axis : {1, 2})
      for (const float out : {-1.0f, 1.0f})
        add_plating(soup, middle, half, axis, out, random.whole(3, 16), random);
    x -= 2 * half.x - random.between(0, 0.06f);
  }
  const int wings = random.whole(1, 3);
  for (int i = 0; i < wings; ++i)
    add_wing(soup, {random.between(x, 0.8f), lift + random.between(-0.08f, 0.12f), 0.05f},
             random.between(0.3f, 0.9f), random.between(0.08f, 0.3f), random.between(-0.2f, 0.3f), random);
  const int engines = random.whole(1, 3);
  for (int i = 0; i < engines; ++i) {
    const float radius = random.between(0.05f, 0.14f), aside = random.between(0.05f, 0.35f);
    const Vec3 place{random.between(x, x + 0.5f), lift + random.between(-0.1f, 0.15f), aside};
    const float length = random.between(0.15f, 0.5f);
    for (const float side : {1.0f, -1.0f})
      add_engine(soup, {place.x, place.y, side * place.z}, radius, length, random);
  }
  for (int i = 0; i < 10; ++i) {
    const Vec3 foot{random.between(x, 1), lift + 0.1f, random.between(-0.2f, 0.2f)};
    add_rod(soup, foot, foot + Vec3{random.between(-0.2f, 0.2f), random.between(0.02f, 0.25f), 0},
            random.log_between(0.003f, 0.02f), 6);
  }
  scene.cameras = {{-2.2f, lift - 0.3f, -2.0f}, {2.4f, lift + 1.2f, 2.0f}};
  scene.subject = {{std::max(x, -0.9f), lift - 0.15f, -0.3f}, {0.9f, lift + 0.2f, 0.3f}};
  return scene;
}

}  // namespace nook::bake::nnao
