#include <algorithm>

#include "bakers/nnao/level_set.h"
#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// The skin of a limb or a trunk. It has a radius for each height and angle about the frame's y axis.
struct Skin {
  float length, waist, swell, flat;
  std::uint64_t seed;

  Vec3 at(float angle, float v, float out) const {
    const float r = waist + swell * std::sin(3.1415927f * v) +
                    0.06f * waist * value_noise(seed, {2 * std::cos(angle), 3 * v, 2 * std::sin(angle)});
    return {(r + out) * std::cos(angle), length * v, flat * (r + out) * std::sin(angle)};
  }
};

// Adds a plate that is bent round the skin. It has a thickness, a raised rim and a keel.
void add_plate(TriangleSoup& soup, const Mat3x4& frame, const Skin& skin, float from, float to, float low,
               float high, float lift, float flare, float keel) {
  const int columns = 14, rows = 6;
  const auto outer = [&](float u, float v) {
    const float rim = std::min({u, 1 - u, v, 1 - v}) < 0.06f ? 0.004f : 0.0f;
    const float out = lift + flare * (1 - v) + rim + keel * std::max(0.0f, 1 - 8 * std::abs(u - 0.5f));
    return transform_point(frame, skin.at(from + u * (to - from), low + v * (high - low), out));
  };
  const auto inner = [&](float u, float v) {
    return transform_point(
        frame, skin.at(from + u * (to - from), low + v * (high - low), lift + flare * (1 - v) - 0.006f));
  };
  add_sheet(soup, columns, rows, outer);
  add_sheet(soup, columns, rows, inner);
  for (const float end : {0.0f, 1.0f}) {
    add_sheet(soup, columns, 1, [&](float u, float v) { return v < 0.5f ? outer(u, end) : inner(u, end); });
    add_sheet(soup, rows, 1, [&](float u, float v) { return v < 0.5f ? outer(end, u) : inner(end, u); });
  }
}

// Adds bands of plates. Each band covers the upper edge of the band below, like the skirt of a breastplate or
// the body of an insect.
void add_lames(TriangleSoup& soup, const Mat3x4& frame, const Skin& skin, Random& random) {
  const int bands = random.whole(3, 12), across = random.whole(1, 5);
  const float overlap = random.between(0.05f, 0.5f), flare = skin.waist * random.between(0.03f, 0.2f),
              keel = random.chance(0.4f) ? 0.015f : 0;
  const float gap = random.between(0.01f, 0.08f), lift = skin.waist * random.between(0.02f, 0.12f);
  for (int b = 0; b < bands; ++b)
    for (int a = 0; a < across; ++a) {
      if (random.chance(0.05f)) continue;
      const float turn = 6.2831853f / float(across), from = turn * (float(a) + 0.5f * float(b % 2)) + gap;
      const float low = float(b) / float(bands), high = std::min(1.0f, low + (1 + overlap) / float(bands));
      add_plate(soup, frame, skin, from, from + turn - 2 * gap, low, high, lift, flare, keel);
      if (random.chance(0.5f))
        for (const float angle : {from + 0.1f * turn, from + 0.9f * turn - 2 * gap}) {
          const Vec3 rivet = transform_point(frame, skin.at(angle, 0.5f * (low + high), lift + 0.5f * flare));
          add_ellipsoid(soup, standing_frame(rivet, 0), {0.008f, 0.008f, 0.008f}, 10);
        }
    }
}

// Adds small scales, as on a roof or a fish.
void add_scales(TriangleSoup& soup, const Mat3x4& frame, const Skin& skin, Random& random) {
  const int rows = random.whole(12, 30), across = random.whole(12, 28);
  const float lift = random.between(0.1f, 0.4f) / float(rows);
  for (int r = 0; r < rows; ++r)
    for (int a = 0; a < across; ++a) {
      const float angle = 6.2831853f * (float(a) + 0.5f * float(r % 2)) / float(across),
                  half = 3.3f / float(across);
      const float top = float(r + 1) / float(rows), low = top - 1.7f / float(rows);
      add_sheet(soup, 4, 3, [&](float u, float v) {
        const float narrow = std::sqrt(std::max(0.0f, 1 - 0.9f * v * v)), x = (2 * u - 1) * narrow;
        return transform_point(frame, skin.at(angle + half * x, top + v * (low - top),
                                              lift * skin.length * v * (1 - 0.4f * x * x) + 0.001f));
      });
    }
}

void add_spikes(TriangleSoup& soup, const Mat3x4& frame, const Skin& skin, Random& random) {
  const int rows = random.whole(3, 10);
  const float size = skin.waist * random.between(0.2f, 0.8f);
  for (int r = 0; r < rows; ++r)
    for (const float angle : {1.2f, 1.5707963f, 1.94f}) {
      const float v = (float(r) + 0.5f) / float(rows);
      const Vec3 foot = skin.at(angle, v, 0), tip = skin.at(angle, v - 0.05f, size);
      add_cylinder(soup, transform_point(frame, foot), transform_point(frame, tip), 0.22f * size,
                   0.01f * size, 10);
    }
}

void add_belts(TriangleSoup& soup, const Mat3x4& frame, const Skin& skin, Random& random) {
  for (int i = random.whole(1, 4); i > 0; --i) {
    const float v = random.between(0.1f, 0.9f), half = random.between(0.015f, 0.04f),
                slant = random.between(-0.2f, 0.2f);
    add_sheet(soup, 40, 3, [&](float u, float w) {
      const float angle = 6.2831853f * u, edge = w < 0.3f || w > 0.7f ? 0.0f : 0.012f;
      const float y =
          v + slant * std::cos(angle) * 0.3f + half * (2 * std::clamp(1.5f * w - 0.25f, 0.0f, 1.0f) - 1);
      return transform_point(frame, skin.at(angle, y, edge));
    });
    const Vec3 buckle = skin.at(1.5707963f, v, 0.014f);
    add_torus(soup, tilted(moved(frame, buckle), 1.5707963f), 0.03f, 0.006f, 12);
    const Vec3 pouch = skin.at(random.between(0, 6.28f), v - 0.03f, 0.02f);
    add_cushion(soup, moved(frame, pouch), {0.05f, 0.06f, 0.035f}, 0.35f, 16);
  }
}

void add_limb(TriangleSoup& soup, const Mat3x4& frame, const Skin& skin, Random& random) {
  add_sheet(soup, 40, 30,
            [&](float u, float v) { return transform_point(frame, skin.at(6.2831853f * u, v, 0)); });
  const int coats = random.whole(1, 2);
  for (int i = 0; i < coats; ++i) switch (random.below(4)) {
      case 0:
      case 1:
        add_lames(soup, frame, skin, random);
        break;
      case 2:
        add_scales(soup, frame, skin, random);
        break;
      default:
        add_spikes(soup, frame, skin, random);
    }
  if (random.chance(0.5f)) add_belts(soup, frame, skin, random);
}

}  // namespace

TrainingScene make_armour(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 6);
  if (random.chance(0.5f)) add_block(soup, {-3, 0, -1.2f}, {3, 2.6f, -1});
  // Adds a trunk with limbs.
  const Mat3x4 trunk = standing_frame({0, 0.7f, 0}, random.between(-0.5f, 0.5f));
  const Skin body{random.between(0.5f, 0.8f), random.between(0.16f, 0.25f), random.between(0, 0.1f),
                  random.between(0.6f, 1), random.bits()};
  add_limb(soup, trunk, body, random);
  for (const float side : {-1.0f, 1.0f}) {
    const Mat3x4 shoulder = moved(trunk, {side * (body.waist + 0.1f), body.length - 0.05f, 0});
    add_limb(soup,
             rolled(tilted(shoulder, random.between(0, 0.6f)), 3.1415927f + side * random.between(0, 0.7f)),
             {random.between(0.5f, 0.7f), random.between(0.05f, 0.08f), 0.03f, 1, random.bits()}, random);
    // The shoulder's plates lie inside each other like stacked cups.
    for (int i = random.whole(1, 5); i > 0; --i) {
      const float r = 0.12f + 0.012f * float(i);
      add_lathe(soup,
                rolled(moved(shoulder, {0, 0.02f - 0.035f * float(i), 0}), -side * (0.5f + 0.1f * float(i))),
                {{{0.01f, r},
                  {0.5f * r, 0.86f * r},
                  {0.85f * r, 0.5f * r},
                  {1.08f * r, 0.1f * r},
                  {1.1f * r, 0.06f * r}}},
                26);
    }
    add_limb(soup,
             rolled(moved(trunk, {side * 0.12f, 0.05f, 0}), 3.1415927f + side * random.between(0.05f, 0.2f)),
             {0.72f, random.between(0.07f, 0.11f), 0.03f, 1, random.bits()}, random);
  }
  // Adds a helmet: a bowl, a visor with slits, a crest.
  const Mat3x4 head = moved(trunk, {0, body.length + 0.12f, 0});
  add_ellipsoid(soup, head, {0.12f, 0.16f, 0.14f}, 32);
  const Skin skull{0.24f, 0.13f, 0.02f, 1.1f, random.bits()};
  const Mat3x4 face = moved(head, {0, -0.14f, 0});
  for (int i = random.whole(2, 7); i > 0; --i)
    add_plate(soup, face, skull, 0.6f, 2.5f, 0.11f * float(i), 0.11f * float(i) + 0.08f, 0.012f, 0.004f,
              0.02f);
  if (random.chance(0.5f))
    for (int i = 0; i < 12; ++i) {
      const float a = 0.25f * float(i) - 0.3f;
      add_block(soup, tilted(moved(head, {0, 0.16f * std::cos(a), -0.15f * std::sin(a)}), -a),
                {-0.006f, -0.02f, -0.02f}, {0.006f, 0.06f, 0.018f});
    }
  for (int i = random.whole(0, 5); i > 0; --i)
    add_crate_or_ball(soup, {random.between(-1.5f, 1.5f), 0, random.between(-0.8f, 1.2f)},
                      random.between(0.05f, 0.25f), random);
  scene.cameras = {{-1.1f, 0.4f, 0.3f}, {1.1f, 2.1f, 1.7f}};
  scene.subject = {{-0.35f, 0.3f, -0.2f}, {0.35f, 1.7f, 0.2f}};
  return scene;
}

}  // namespace nook::bake::nnao
