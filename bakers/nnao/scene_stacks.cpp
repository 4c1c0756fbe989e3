#include <algorithm>

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// In its frame, each pile stands on y = 0 around the origin. Piles are at most about 1.2 m wide.

void add_pallet(TriangleSoup& soup, const Mat3x4& frame) {
  for (int i = 0; i < 7; ++i)
    add_block(soup, frame, {-0.6f, 0.12f, -0.4f + 0.12f * float(i)},
              {0.6f, 0.144f, -0.31f + 0.12f * float(i)});
  for (const float x : {-0.6f, -0.07f, 0.46f}) {
    for (const float z : {-0.4f, -0.05f, 0.3f})
      add_block(soup, frame, {x, 0.02f, z}, {x + 0.14f, 0.12f, z + 0.1f});
    add_block(soup, frame, {x, 0.1f, -0.4f}, {x + 0.14f, 0.122f, 0.4f});
  }
  for (const float z : {-0.4f, -0.05f, 0.3f}) add_block(soup, frame, {-0.6f, 0, z}, {0.6f, 0.022f, z + 0.1f});
}

void add_cartons(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  add_pallet(soup, frame);
  const Vec3 half{random.between(0.08f, 0.2f), random.between(0.06f, 0.2f), random.between(0.08f, 0.2f)};
  const float gap = random.between(0.001f, 0.012f), jitter = random.between(0, 0.02f);
  const int layers = random.whole(1, 6);
  for (int layer = 0; layer < layers; ++layer)
    for (float x = -0.6f + half.x; x + half.x < 0.61f; x += 2 * half.x + gap)
      for (float z = -0.4f + half.z; z + half.z < 0.41f; z += 2 * half.z + gap) {
        if (random.chance(layer + 1 == layers ? 0.35f : 0.02f)) continue;
        const Mat3x4 box =
            moved(frame, {x + random.between(-jitter, jitter), 0.145f + half.y * (2 * float(layer) + 1),
                          z + random.between(-jitter, jitter)}) *
            standing_frame({}, random.between(-jitter, jitter));
        add_bevelled_box(soup, box, half, 0.004f);
        // Adds the tape over the slit between the flaps.
        add_block(soup, box, {-0.02f, half.y, -half.z}, {0.02f, half.y + 0.001f, half.z});
      }
}

void add_sacks(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const Vec3 half{random.between(0.25f, 0.4f), random.between(0.06f, 0.12f), random.between(0.15f, 0.25f)};
  const int layers = random.whole(2, 7);
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < 2; ++i) {
      const bool across = layer % 2;
      const float aside = (float(i) - 0.5f) * 1.9f * (across ? half.x : half.z) * (across ? 0.62f : 1.0f);
      add_cushion(
          soup,
          moved(frame, {across ? aside : random.between(-0.03f, 0.03f), half.y * (1 + 1.75f * float(layer)),
                        across ? random.between(-0.03f, 0.03f) : aside}) *
              standing_frame({}, (across ? 1.5707963f : 0) + random.between(-0.15f, 0.15f)),
          half, random.between(0.35f, 0.6f), 24);
    }
}

void add_barrels(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float r = random.between(0.18f, 0.3f), h = r * random.between(2, 3);
  const bool steel = random.chance(0.5f);
  std::vector<std::array<float, 2>> profile{{0, 0.03f}, {0.94f * r, 0.03f}};
  for (int i = 0; i <= 24; ++i) {
    const float v = float(i) / 24;
    const float hoop = steel ? (i == 8 || i == 16 ? 0.03f * r : 0)
                             : (i % 6 == 2 ? 0.02f * r : 0) - 0.13f * r * (2 * v - 1) * (2 * v - 1);
    profile.push_back({r + hoop, h * v});
  }
  profile.push_back({0.94f * r, h});
  profile.push_back({0.92f * r, h - 0.03f});
  profile.push_back({0, h - 0.03f});
  const int layers = random.whole(1, 2);
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < 5 - 2 * layer; ++i) {
      const Vec3 place{2.04f * r * (float(i % 3) + 0.5f * float(i / 3) - 1 + 0.5f * float(layer)),
                       h * float(layer), 1.8f * r * float(i / 3)};
      add_lathe(soup, moved(frame, place), profile, 28);
    }
}

void add_tyres(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float r = random.between(0.22f, 0.32f), tube = random.between(0.07f, 0.1f);
  for (int i = random.whole(2, 8) - 1; i >= 0; --i)
    add_torus(soup,
              moved(frame, {random.between(-0.02f, 0.02f), tube * (1 + 1.9f * float(i)),
                            random.between(-0.02f, 0.02f)}),
              r, tube, 32);
}

void add_logs(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float r = random.between(0.04f, 0.14f), half = random.between(0.3f, 0.6f);
  const int wide = random.whole(4, 9);
  for (int row = 0; row < std::min(wide, 6); ++row)
    for (int i = 0; i < wide - row; ++i) {
      const Vec3 place{2.03f * r * (float(i) + 0.5f * float(row) - 0.5f * float(wide)),
                       r * (1 + 1.74f * float(row)), random.between(-0.06f, 0.06f)};
      const float thick = r * random.between(0.85f, 1);
      add_rod(soup, transform_point(frame, place - Vec3{0, 0, half}),
              transform_point(frame, place + Vec3{0, 0, half}), thick, random.whole(9, 20));
    }
}

// Adds rows of bottles, jars or cans, sometimes in a crate.
void add_bottles(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float r = random.between(0.03f, 0.06f), h = r * random.between(2, 8);
  const bool neck = random.chance(0.6f), crate = random.chance(0.5f);
  std::vector<std::array<float, 2>> profile{{0, 0}, {0.9f * r, 0}, {r, 0.1f * r}};
  if (neck)
    profile.insert(profile.end(), {{r, 0.55f * h},
                                   {0.85f * r, 0.65f * h},
                                   {0.35f * r, 0.75f * h},
                                   {0.32f * r, 0.95f * h},
                                   {0.38f * r, 0.96f * h},
                                   {0.38f * r, h},
                                   {0, h}});
  else
    profile.insert(profile.end(),
                   {{r, 0.9f * h}, {0.9f * r, 0.93f * h}, {1.02f * r, 0.94f * h}, {1.02f * r, h}, {0, h}});
  const int nx = random.whole(3, 8), nz = random.whole(2, 5);
  const float pitch = 2 * r + random.between(0.002f, 0.02f), wide = 0.5f * pitch * float(nx) + 0.005f,
              deep = 0.5f * pitch * float(nz) + 0.005f;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < nz; ++j)
      if (random.chance(0.85f))
        add_lathe(soup,
                  moved(frame, {pitch * (float(i) + 0.5f) - wide + 0.005f, 0.012f,
                                pitch * (float(j) + 0.5f) - deep + 0.005f}),
                  profile, 18);
  if (!crate) return;
  add_block(soup, frame, {-wide, 0, -deep}, {wide, 0.01f, deep});
  for (const float y : {0.01f, 0.4f * h, 0.65f * h}) {
    for (const float z : {-deep - 0.01f, deep})
      add_block(soup, frame, {-wide, y, z}, {wide, y + 0.15f * h, z + 0.01f});
    for (const float x : {-wide - 0.01f, wide})
      add_block(soup, frame, {x, y, -deep}, {x + 0.01f, y + 0.15f * h, deep});
  }
}

void add_fruit(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float r = random.between(0.025f, 0.07f), half = 0.3f, wall = 0.18f;
  for (const float x : {-half - 0.015f, half})
    add_block(soup, frame, {x, 0, -0.2f}, {x + 0.015f, wall, 0.2f});
  for (const float z : {-0.215f, 0.2f}) add_block(soup, frame, {-half, 0, z}, {half, wall, z + 0.015f});
  for (int layer = 0; layer < 4; ++layer)
    for (float x = -half + r; x < half - 0.5f * r; x += 2 * r)
      for (float z = -0.2f + r; z < 0.2f - 0.5f * r; z += 2 * r) {
        const float y = r * (1 + 1.5f * float(layer));
        if (y > wall + r || random.chance(0.1f)) continue;
        const float shift = layer % 2 ? 0.6f * r : 0.0f, size = r * random.between(0.85f, 1.02f);
        add_ellipsoid(
            soup,
            tumbled_frame(transform_point(frame, {x + shift + random.between(-0.1f, 0.1f) * r, y, z + shift}),
                          random),
            {size, 0.92f * size, size}, 16);
      }
}

void add_bricks(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const Vec3 half{0.11f, 0.035f, 0.053f};
  const int layers = random.whole(3, 14);
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 5; ++j) {
        if (random.chance(layer + 2 > layers ? 0.4f : 0.01f)) continue;
        const Vec3 place{0.225f * (float(i) - 1), half.y * (2.06f * float(layer) + 1),
                         0.11f * (float(j) - 2)};
        add_bevelled_box(soup, moved(frame, place) * standing_frame({}, random.between(-0.03f, 0.03f)), half,
                         0.004f);
      }
  for (int i = random.whole(0, 12); i > 0; --i)
    add_bevelled_box(soup,
                     moved(frame, {random.between(-0.8f, 0.8f), half.y, random.between(0.4f, 0.8f)}) *
                         standing_frame({}, random.between(0, 6)),
                     half, 0.004f);
}

void add_pile(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  using Add = void (*)(TriangleSoup&, const Mat3x4&, Random&);
  constexpr Add piles[] = {add_cartons, add_sacks,   add_barrels, add_tyres,
                           add_logs,    add_bottles, add_fruit,   add_bricks};
  piles[random.below(8)](soup, frame, random);
}

// Adds a rack of uprights and beams, with piles on each level.
void add_rack(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const int bays = random.whole(1, 3), levels = random.whole(2, 3);
  const float width = 1.5f, gap = random.between(1.2f, 1.6f), depth = 1;
  for (int b = 0; b <= bays; ++b)
    for (const float z : {-0.5f * depth, 0.5f * depth}) {
      const Vec3 foot{width * float(b), 0, z};
      add_block(soup, moved(frame, foot), {-0.04f, 0, -0.03f}, {0.04f, gap * float(levels), 0.03f});
      if (z < 0)
        for (float y = 0.2f; y + 0.5f < gap * float(levels); y += 0.5f)
          add_rod(soup, transform_point(frame, foot + Vec3{0, y, 0}),
                  transform_point(frame, foot + Vec3{0, y + 0.5f, depth}), 0.012f, 6);
    }
  for (int level = 0; level < levels; ++level)
    for (int b = 0; b < bays; ++b) {
      const Mat3x4 shelf = moved(frame, {width * (float(b) + 0.5f), gap * float(level), 0});
      if (level > 0)
        for (const float z : {-0.5f * depth, 0.5f * depth})
          add_block(soup, shelf, {-0.5f * width, -0.12f, z - 0.025f}, {0.5f * width, 0, z + 0.025f});
      if (level > 0)
        for (int i = 0; i < 6; ++i)
          add_block(soup, shelf, {-0.7f + 0.24f * float(i), -0.02f, -0.5f},
                    {-0.55f + 0.24f * float(i), 0, 0.5f});
      if (random.chance(0.8f)) add_pile(soup, shelf, random);
    }
}

}  // namespace

TrainingScene make_stacks(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 14);
  if (random.chance(0.6f)) add_block(soup, {-6, 0, -3.2f}, {6, 3.5f, -3});
  if (random.chance(0.5f)) add_rack(soup, standing_frame({random.between(-3, -0.5f), 0, -2.2f}, 0), random);
  const float pitch = random.between(0.9f, 1.6f);
  for (float x = -2.2f; x < 2.3f; x += pitch)
    for (float z = -1.4f; z < 2; z += pitch)
      if (random.chance(0.75f))
        add_pile(soup,
                 standing_frame({x + random.between(-0.1f, 0.1f), 0, z + random.between(-0.1f, 0.1f)},
                                random.chance(0.5f) ? 0 : random.between(-0.5f, 0.5f)),
                 random);
  scene.cameras = {{-3.2f, 0.5f, -1.5f}, {3.2f, 2.2f, 3.6f}};
  scene.subject = {{-2, 0, -1.8f}, {2, 0.9f, 1.5f}};
  return scene;
}

}  // namespace nook::bake::nnao
