#include <algorithm>

#include "bakers/nnao/level_set.h"
#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

std::vector<Vec3> hanging(Vec3 from, Vec3 to, float sag, int parts) {
  std::vector<Vec3> path;
  for (int i = 0; i <= parts; ++i) {
    const float t = float(i) / float(parts);
    path.push_back(from + t * (to - from) - Vec3{0, 4 * sag * t * (1 - t), 0});
  }
  return path;
}

// Adds woven wire in the frame's x-y plane: zigzags that meet at their bends.
void add_chain_link(TriangleSoup& soup, const Mat3x4& frame, float width, float height, Random& random) {
  const float mesh = random.between(0.05f, 0.14f), wire = mesh * random.between(0.02f, 0.07f);
  for (float x = 0; x < width; x += mesh) {
    std::vector<Vec3> path;
    int i = 0;
    for (float y = 0; y <= height; y += 0.5f * mesh, ++i)
      path.push_back(
          transform_point(frame, {x + (i % 2 ? 0.52f * mesh : -0.02f * mesh), y, i % 2 ? wire : -wire}));
    if (path.size() > 1) add_tube(soup, path, wire, 4);
  }
  for (float x = 0; x <= width + 0.1f; x += 0.5f * width)
    add_rod(soup, transform_point(frame, {x, 0, 0}), transform_point(frame, {x, height + 0.1f, 0}), 0.025f,
            10);
  add_rod(soup, transform_point(frame, {0, height, 0}), transform_point(frame, {width, height, 0}), 0.02f, 8);
}

// Adds a net that hangs between poles or lies over something. Its strands run in both directions of a bent
// sheet.
void add_net_of_rope(TriangleSoup& soup, const Mat3x4& frame, float width, float height, Random& random) {
  const std::uint64_t seed = random.bits();
  const int columns = random.whole(8, 26), rows = std::max(4, int(float(columns) * height / width));
  const float rope = random.between(0.002f, 0.012f), belly = random.between(0, 0.6f);
  const auto at = [&](float u, float v) {
    const float out = belly * std::sin(3.14159f * u) * std::sin(3.14159f * v) +
                      0.08f * value_noise(seed, {4 * u, 4 * v, 0});
    return transform_point(frame, {width * u, height * v - 0.15f * std::sin(3.14159f * u) * v, out});
  };
  const auto strand = [&](int parts, const auto& point) {
    std::vector<Vec3> path;
    for (int i = 0; i <= parts; ++i) path.push_back(point(float(i) / float(parts)));
    add_tube(soup, path, rope, 4);
  };
  for (int c = 0; c <= columns; ++c)
    strand(2 * rows, [&](float t) { return at(float(c) / float(columns), t); });
  for (int r = 0; r <= rows; ++r) strand(2 * columns, [&](float t) { return at(t, float(r) / float(rows)); });
  for (const float x : {0.0f, width})
    add_rod(soup, transform_point(frame, {x, -0.2f, 0}), transform_point(frame, {x, height + 0.2f, 0}), 0.03f,
            10);
}

// Adds a bundle of cables along a wall or over the ground, with ties.
void add_bundle(TriangleSoup& soup, const Mat3x4& frame, float length, Random& random) {
  const int cables = random.whole(3, 14);
  const float r = random.log_between(0.004f, 0.025f),
              spread = r * std::sqrt(float(cables)) * random.between(0.8f, 2);
  const std::uint64_t seed = random.bits();
  for (int c = 0; c < cables; ++c) {
    const float y = random.between(0, 1.2f) * spread, z = random.between(-1, 1) * spread;
    std::vector<Vec3> path;
    for (int i = 0; i <= 30; ++i) {
      const float x = length * float(i) / 30, n = float(c) * 7;
      path.push_back(
          transform_point(frame, {x, r + y + 0.4f * spread * (1 + value_noise(seed, {3 * x, n, 0})),
                                  z + 0.8f * spread * value_noise(seed, {2 * x, n, 5})}));
    }
    add_tube(soup, path, r * random.between(0.6f, 1), 7);
  }
}

void add_coil(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float radius = random.between(0.12f, 0.35f), wire = random.log_between(0.004f, 0.02f);
  const int turns = random.whole(4, 14);
  std::vector<Vec3> path;
  for (int i = 0; i <= 24 * turns; ++i) {
    const float a = 6.2831853f * float(i) / 24, r = radius * (1 + 0.08f * std::sin(0.37f * a));
    path.push_back(transform_point(
        frame,
        {r * std::cos(a), wire * (1 + 1.1f * float(i) / 24 * (0.8f + 0.2f * std::sin(a))), r * std::sin(a)}));
  }
  add_tube(soup, path, wire, 6);
}

// Adds a scaffold of poles, ledgers, braces and boards.
void add_scaffold(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const int bays = random.whole(2, 3), levels = random.whole(1, 3);
  const float bay = random.between(1.4f, 2), lift = random.between(1.6f, 2), deep = 0.9f, pole = 0.024f;
  const auto at = [&](int b, int l, float z) {
    return transform_point(frame, {bay * float(b), lift * float(l), z});
  };
  for (int b = 0; b <= bays; ++b)
    for (const float z : {0.0f, deep})
      add_rod(soup, at(b, 0, z), at(b, levels, z) + Vec3{0, 0.6f, 0}, pole, 10);
  for (int l = 1; l <= levels; ++l) {
    for (const float z : {0.0f, deep}) add_rod(soup, at(0, l, z), at(bays, l, z), pole, 8);
    for (int b = 0; b <= bays; ++b) add_rod(soup, at(b, l, 0), at(b, l, deep), pole, 8);
    for (int i = 0; i < 3; ++i)
      add_block(soup, moved(frame, {0, lift * float(l) + 0.03f, 0.08f + 0.26f * float(i)}), {0, 0, 0},
                {bay * float(bays), 0.035f, 0.23f});
    for (int b = 0; b < bays; ++b) add_rod(soup, at(b, l - 1, deep), at(b + 1, l, deep), 0.8f * pole, 8);
    add_rod(soup, at(0, l, deep) + Vec3{0, 0.5f, 0}, at(bays, l, deep) + Vec3{0, 0.5f, 0}, pole, 8);
  }
}

void add_aerial(TriangleSoup& soup, Vec3 foot, Random& random) {
  const float height = random.between(0.8f, 2);
  add_rod(soup, foot, foot + Vec3{0, height, 0}, 0.015f, 8);
  for (int i = random.whole(4, 14); i > 0; --i) {
    const Vec3 at = foot + Vec3{0, height * random.between(0.5f, 1), 0},
               way = random.between(0.1f, 0.4f) *
                     normalised(Vec3{random.between(-1, 1), 0, random.between(-1, 1)});
    add_rod(soup, at - way, at + way, random.between(0.002f, 0.006f), 5);
  }
}

}  // namespace

TrainingScene make_wires(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 12);
  const bool wall = random.chance(0.7f);
  if (wall) add_block(soup, {-4, 0, -1.9f}, {4, 3, -1.7f});
  const auto place = [&] { return Vec3{random.between(-2, 2), 0, random.between(-1.3f, 1.3f)}; };
  const auto upright = [&] {
    return standing_frame(place(), random.chance(0.5f) ? 0 : random.between(-1, 1));
  };
  for (int i = random.whole(0, 2); i > 0; --i)
    add_chain_link(soup, upright(), random.between(1.2f, 2.4f), random.between(0.8f, 1.6f), random);
  for (int i = random.whole(1, 3); i > 0; --i)
    add_net_of_rope(soup, upright(), random.between(0.8f, 2), random.between(0.7f, 1.6f), random);
  if (random.chance(0.4f))  // a net close over boxes
    add_net_of_rope(soup, tilted(moved(upright(), {-0.5f, 0.35f, 0}), -1.45f), 1.2f, 1.2f, random);
  for (int i = random.whole(1, 4); i > 0; --i)
    add_bundle(soup, standing_frame(place(), random.between(0, 6.28f)), random.between(1, 3), random);
  if (wall) add_bundle(soup, standing_frame({-2, random.between(0.3f, 2), -1.67f}, 0), 4, random);
  for (int i = random.whole(0, 4); i > 0; --i) add_coil(soup, standing_frame(place(), 0), random);
  if (random.chance(0.5f)) add_scaffold(soup, standing_frame({-2, 0, -1.6f}, 0), random);
  for (int i = random.whole(0, 3); i > 0; --i) add_aerial(soup, place(), random);
  for (int i = random.whole(4, 20); i > 0; --i)
    add_tube(soup,
             hanging(place() + Vec3{0, random.between(1, 2.8f), 0},
                     place() + Vec3{0, random.between(1, 2.8f), 0}, random.between(0, 0.6f), 14),
             random.log_between(0.002f, 0.02f), 6);
  for (int i = random.whole(4, 16); i > 0; --i)
    add_crate_or_ball(soup, place(), random.log_between(0.06f, 0.4f), random);
  scene.cameras = {{-2.8f, 0.3f, -1.2f}, {2.8f, 2.2f, 3.2f}};
  scene.subject = {{-1.8f, 0, -1.6f}, {1.8f, 1.7f, 1.2f}};
  return scene;
}

}  // namespace nook::bake::nnao
