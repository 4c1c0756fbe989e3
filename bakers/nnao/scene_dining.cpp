#include <array>
#include <vector>

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// Adds a thin cup on a saucer, a bowl or a jug.
void add_crockery(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float size = random.between(0.03f, 0.06f);
  switch (random.below(4)) {
    case 0:
      add_lathe(soup, frame,
                {{{0, 0}, {1.8f * size, 0.1f * size}, {2.4f * size, random.between(0.2f, 0.9f) * size}}});
      break;
    case 1: {
      const float height = random.between(3, 5) * size, waist = random.between(0.5f, 1) * size;
      add_lathe(soup, frame,
                {{{0, 0},
                  {size, 0},
                  {1.6f * size, 0.35f * height},
                  {waist, 0.8f * height},
                  {1.2f * waist, height}}});
      add_torus(soup,
                moved(frame, {1.5f * size, 0.55f * height, 0}) * Mat3x4{{1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0}},
                0.9f * size, 0.16f * size, 16);
      break;
    }
    default:
      add_lathe(soup, frame, {{{0, 0}, {size, 0}, {2 * size, 0.3f * size}}});
      add_lathe(soup, moved(frame, {0, 0.06f * size, 0}),
                {{{0, 0}, {0.6f * size, 0}, {0.95f * size, 0.6f * size}, {1.1f * size, 1.5f * size}}});
  }
}

void add_dining_table(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, Random& random) {
  add_box(soup, moved(frame, {0, half.y, 0}), {half.x, 0.02f, half.z});
  for (const float side : {-1.0f, 1.0f}) {
    add_box(soup, moved(frame, {0, half.y - 0.08f, side * (half.z - 0.05f)}),
            {half.x - 0.05f, 0.06f, 0.012f});
    add_box(soup, moved(frame, {side * (half.x - 0.05f), half.y - 0.08f, 0}),
            {0.012f, 0.06f, half.z - 0.05f});
  }
  // The legs are solids of revolution, as made on a lathe.
  const float thick = random.between(0.025f, 0.055f);
  std::vector<std::array<float, 2>> profile;
  for (int i = 0; i <= 12; ++i) profile.push_back({thick * random.between(0.55f, 1), half.y * float(i) / 12});
  for (const float x : {-1.0f, 1.0f})
    for (const float z : {-1.0f, 1.0f})
      add_lathe(soup, moved(frame, {x * (half.x - 0.08f), 0, z * (half.z - 0.08f)}), profile);
  const int things = random.whole(2, 10);
  for (int i = 0; i < things; ++i)
    add_crockery(soup,
                 moved(frame, {random.between(-0.85f, 0.85f) * half.x, half.y + 0.02f,
                               random.between(-0.8f, 0.8f) * half.z}) *
                     standing_frame({}, random.between(0, 6.28f)),
                 random);
}

// Adds a chair on four thin legs with struts. Its seat and back are one bent sheet.
void add_shell_chair(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float half = random.between(0.19f, 0.25f), seat = random.between(0.4f, 0.48f);
  const float back = random.between(0.28f, 0.5f), bend = random.between(0, 0.09f);
  const std::array<std::array<float, 2>, 6> profile{{{half, seat - 0.02f},
                                                     {0.1f, seat},
                                                     {-0.12f, seat - 0.01f},
                                                     {-half, seat + 0.07f},
                                                     {-half - 0.04f, seat + 0.5f * back},
                                                     {-half - 0.07f, seat + back}}};
  const auto at = [&](int u, std::size_t v) {
    const float across = float(u) / 4, lift = bend * across * across;
    const bool upright = v >= 4;
    return transform_point(frame, {half * across, profile[v][1] + (upright ? 0 : lift),
                                   profile[v][0] + (upright ? 1.3f * lift : 0)});
  };
  for (std::size_t v = 0; v + 1 < profile.size(); ++v)
    for (int u = -4; u < 4; ++u) add_quad(soup, at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1));
  const float leg = random.between(0.006f, 0.014f), spread = random.between(0.75f, 1.05f) * half;
  const auto foot = [&](float x, float z) { return transform_point(frame, {x * spread, 0, z * spread}); };
  const auto top = [&](float x, float z) {
    return transform_point(frame, {0.4f * x * spread, seat - 0.02f, 0.4f * z * spread});
  };
  for (const float x : {-1.0f, 1.0f})
    for (const float z : {-1.0f, 1.0f}) {
      add_rod(soup, foot(x, z), top(x, z), leg, 6);
      add_rod(soup, 0.35f * foot(x, z) + 0.65f * top(x, z), top(-x, z), 0.6f * leg, 5);
    }
}

void add_pendant_lamp(TriangleSoup& soup, Vec3 from, Random& random) {
  const float radius = random.between(0.12f, 0.3f), height = random.between(0.08f, 0.25f);
  const Vec3 hub = from - Vec3{0, random.between(0.4f, 1.2f), 0};
  add_rod(soup, hub, from, 0.006f, 5);
  add_lathe(soup, standing_frame(hub, 0),
            {{{0.02f, 0}, {0.6f * radius, -0.25f * height}, {radius, -height}}});
}

}  // namespace

TrainingScene make_dining_room(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float half = random.between(2.2f, 4.5f), height = random.between(2.4f, 3.6f);
  add_floor(soup, half);
  add_quad(soup, {-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half});
  for (int wall = 0; wall < 4; ++wall) {
    const float angle = 1.5707963f * float(wall);
    const Mat3x4 frame = standing_frame({-half * std::sin(angle), 0, -half * std::cos(angle)}, angle);
    add_box(soup, moved(frame, {0, 0.5f * height, -0.1f}), {half, 0.5f * height, 0.1f});
    add_box(soup, moved(frame, {0, 0.06f, 0.01f}), {half, 0.06f, 0.012f});
    // Adds pictures, and sometimes a sideboard.
    const int pictures = random.whole(0, 2);
    for (int i = 0; i < pictures; ++i)
      add_box(soup, moved(frame, {random.between(-0.7f, 0.7f) * half, random.between(1.3f, 1.8f), 0.015f}),
              {random.between(0.15f, 0.6f), random.between(0.15f, 0.5f), random.between(0.01f, 0.03f)});
    if (random.chance(0.3f))
      add_box(soup, moved(frame, {random.between(-0.5f, 0.5f) * half, 0.45f, 0.24f}),
              {random.between(0.4f, 1), 0.45f, 0.22f});
  }
  const Vec3 table{random.between(0.6f, 1.4f), random.between(0.68f, 0.78f), random.between(0.4f, 0.6f)};
  const Vec3 middle{random.between(-0.4f, 0.4f) * half, 0, random.between(-0.4f, 0.4f) * half};
  const Mat3x4 frame = standing_frame(middle, random.chance(0.5f) ? 0 : random.between(0, 6.28f));
  add_dining_table(soup, frame, table, random);
  const int chairs = random.whole(3, 8);
  for (int i = 0; i < chairs; ++i) {
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    const Vec3 seat{random.between(-0.9f, 0.9f) * table.x, 0, side * (table.z + random.between(0, 0.5f))};
    const float turned = (side > 0 ? 3.1415927f : 0) + random.between(-0.5f, 0.5f);
    add_shell_chair(soup, moved(frame, seat) * standing_frame({}, turned), random);
  }
  const int lamps = random.whole(0, 3);
  for (int i = 0; i < lamps; ++i)
    add_pendant_lamp(
        soup, middle + Vec3{random.between(-1, 1) * table.x, height, random.between(-0.5f, 0.5f)}, random);
  scene.cameras = {{-half * 0.9f, 0.8f, -half * 0.9f}, {half * 0.9f, height * 0.9f, half * 0.9f}};
  scene.subject = {middle - Vec3{table.x + 0.4f, 0, table.z + 0.6f},
                   middle + Vec3{table.x + 0.4f, 1.3f, table.z + 0.6f}};
  return scene;
}

}  // namespace nook::bake::nnao
