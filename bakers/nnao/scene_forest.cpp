#include <algorithm>

#include "bakers/nnao/level_set.h"
#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

struct Leaves {
  float size;
  int count;   // at the end of a twig
  bool cards;  // crossed rectangles instead of single leaves
};

void add_card(TriangleSoup& soup, Vec3 foot, Vec3 along, Vec3 across) {
  add_quad(soup, foot - across, foot + across, foot + along + across, foot + along - across);
}

void add_tuft(TriangleSoup& soup, Vec3 at, const Leaves& leaves, Random& random) {
  for (int i = 0; i < leaves.count; ++i) {
    const Vec3 along = leaves.size * random.between(0.6f, 1.2f) * any_direction(random);
    const Vec3 across = normalised(cross(along, any_direction(random)));
    const Vec3 foot = at + 0.7f * leaves.size * any_direction(random);
    if (leaves.cards)
      add_card(soup, foot, along, 0.45f * leaves.size * across);
    else {
      add_triangle(soup, foot, foot + 0.5f * along + 0.22f * leaves.size * across,
                   foot + 0.5f * along - 0.22f * leaves.size * across);
      add_triangle(soup, foot + along, foot + 0.5f * along - 0.22f * leaves.size * across,
                   foot + 0.5f * along + 0.22f * leaves.size * across);
    }
  }
}

// Adds a branch that bends, tapers and forks, down to twigs with leaves.
void add_branch(TriangleSoup& soup, Vec3 from, Vec3 way, float length, float radius, int depth,
                const Leaves& leaves, Random& random) {
  std::vector<Vec3> path{from};
  std::vector<float> thick{radius};
  const int parts = 4;
  for (int i = 1; i <= parts; ++i) {
    way = normalised(way + 0.18f * any_direction(random) + Vec3{0, 0.05f, 0});
    path.push_back(path.back() + length / parts * way);
    thick.push_back(radius * (1 - 0.45f * float(i) / parts));
  }
  add_tube(soup, path, thick, depth > 1 ? 9 : 5);
  if (depth == 0) {
    add_tuft(soup, path.back(), leaves, random);
    add_tuft(soup, path[2], leaves, random);
    return;
  }
  const int forks = random.whole(2, 4);
  for (int i = 0; i < forks; ++i) {
    const std::size_t at = std::size_t(i == 0 ? parts : random.whole(2, parts));
    add_branch(soup, path[at], normalised(way + random.between(0.6f, 1.1f) * any_direction(random)),
               length * random.between(0.55f, 0.8f), 0.6f * thick[at], depth - 1, leaves, random);
  }
}

// Adds a trunk with furrowed bark and spreading roots.
void add_trunk(TriangleSoup& soup, Vec3 foot, float height, float radius, Random& random) {
  const std::uint64_t seed = random.bits();
  const int ridges = random.whole(8, 22), roots = random.whole(3, 7);
  const float furrow = random.between(0.03f, 0.12f);
  const float lean = random.between(-0.1f, 0.1f);
  add_sheet(soup, 120, 60, [&](float u, float v) {
    const float angle = 6.2831853f * u, c = std::cos(angle), s = std::sin(angle), y = v * v * height;
    const float bark = std::abs(std::sin(0.5f * float(ridges) * angle +
                                         3 * value_noise(seed, {3 * c, 2 * y / radius * 0.3f, 3 * s}))) +
                       0.5f * value_noise(seed + 1, {8 * c, 1.2f * y / radius, 8 * s});
    const float flare = 0.8f * std::exp(-y / radius) * (1 + 0.6f * std::cos(float(roots) * angle));
    const float r = radius * (1 - 0.35f * v * v + flare + furrow * bark);
    return foot + Vec3{r * c + lean * y, y - 0.05f, r * s};
  });
}

void add_grown_tree(TriangleSoup& soup, Vec3 foot, float height, const Leaves& leaves, Random& random) {
  const float radius = height * random.between(0.025f, 0.06f);
  add_trunk(soup, foot, 0.5f * height, radius, random);
  for (int i = random.whole(4, 8); i > 0; --i) {
    Vec3 way = any_direction(random);
    way.y = std::abs(way.y) * 0.7f + 0.2f;
    add_branch(soup, foot + Vec3{0, height * random.between(0.25f, 0.48f), 0}, normalised(way),
               height * random.between(0.15f, 0.28f), 0.4f * radius, 2, leaves, random);
  }
}

// Adds a distant tree in low detail: tiers of ragged cones, or a heap of rough balls.
void add_far_tree(TriangleSoup& soup, Vec3 foot, float height, bool conifer, Random& random) {
  const std::uint64_t seed = random.bits();
  add_cylinder(soup, foot - Vec3{0, 0.5f, 0}, foot + Vec3{0, 0.5f * height, 0}, 0.03f * height,
               0.02f * height, 6);
  if (conifer) {
    const int tiers = random.whole(5, 9);
    for (int t = 0; t < tiers; ++t) {
      const float low = height * (0.12f + 0.88f * float(t) / float(tiers)),
                  high = std::min(height, low + 0.24f * height);
      const float r = 0.24f * height * (1 - float(t) / float(tiers)) + 0.02f * height;
      add_sheet(soup, 16, 2, [&](float u, float v) {
        const float ragged = (1 - v) * (int(16 * u + 0.5f) % 2 ? 0.7f : 1.0f), angle = 6.2831853f * u;
        return foot + Vec3{r * ragged * std::cos(angle), low + v * (high - low) - 0.03f * height * ragged,
                           r * ragged * std::sin(angle)};
      });
    }
    return;
  }
  for (int i = random.whole(3, 6); i > 0; --i) {
    const Vec3 middle =
        foot + Vec3{0.16f * height * random.between(-1, 1), height * random.between(0.5f, 0.85f),
                    0.16f * height * random.between(-1, 1)};
    const float r = height * random.between(0.13f, 0.24f);
    add_sheet(soup, 20, 12, [&](float u, float v) {
      const float a = 6.2831853f * u, b = 3.1415927f * (v - 0.5f);
      const Vec3 d{std::cos(b) * std::cos(a), std::sin(b), std::cos(b) * std::sin(a)};
      return middle + r * (1 + 0.3f * value_noise(seed, 4.0f * d + middle)) * d;
    });
  }
}

// Adds a patch of ivy on a wall: leaves over stems.
void add_ivy(TriangleSoup& soup, float half, float height, float z, Random& random) {
  const std::uint64_t seed = random.bits();
  const float size = random.between(0.05f, 0.11f);
  for (int i = random.whole(2000, 9000); i > 0; --i) {
    const float x = random.between(-half, half), y = random.between(0, height);
    if (value_noise(seed, {1.5f * x, 1.5f * y, 0}) + 0.5f * (1 - y / height) < 0.15f) continue;
    const Vec3 out = normalised(Vec3{0, -0.4f, 1} + 0.5f * any_direction(random)),
               side = normalised(cross(out, any_direction(random)));
    const Vec3 foot{x, y, z + random.between(0.01f, 0.12f)}, down = cross(out, side);
    add_triangle(soup, foot, foot + size * (0.5f * down + 0.45f * side),
                 foot + size * (0.5f * down - 0.45f * side));
    add_triangle(soup, foot + size * down, foot + size * (0.5f * down - 0.45f * side),
                 foot + size * (0.5f * down + 0.45f * side));
  }
  for (int i = 0; i < 12; ++i) {
    std::vector<Vec3> path{{random.between(-half, half), 0, z + 0.02f}};
    for (int j = 0; j < 10; ++j)
      path.push_back(path.back() + Vec3{random.between(-0.15f, 0.15f), 0.1f * height, 0});
    add_tube(soup, path, random.between(0.006f, 0.02f), 6);
  }
}

void add_fern(TriangleSoup& soup, Vec3 foot, float size, Random& random) {
  for (int f = random.whole(5, 11); f > 0; --f) {
    const float angle = random.between(0, 6.28f), rise = random.between(0.5f, 1);
    const Vec3 away{std::cos(angle), 0, std::sin(angle)}, across = cross(away, {0, 1, 0});
    const auto spine = [&](float t) {
      return foot + size * (t * away + Vec3{0, rise * (1.3f * t - 1.1f * t * t), 0});
    };
    for (int i = 1; i < 16; ++i) {
      const float t = float(i) / 16, reach = size * 0.28f * (1 - t) * std::min(1.0f, 5 * t);
      for (const float side : {-1.0f, 1.0f})
        add_triangle(soup, spine(t - 0.025f), spine(t + 0.025f), spine(t + 0.03f) + side * reach * across);
    }
  }
}

}  // namespace

TrainingScene make_forest(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const std::uint64_t seed = random.bits();
  const bool afar = random.chance(0.35f);
  const float reach = afar ? 40.0f : 9.0f, hill = afar ? 4.0f : 0.35f;
  const auto ground = [&](float x, float z) {
    return hill * value_noise(seed, {x * 1.2f / (0.3f * reach), 0, z * 1.2f / (0.3f * reach)}) +
           0.02f * fractal_noise(seed + 5, {2 * x, 0, 2 * z}, 3);
  };
  const auto on_ground = [&](float half) {
    const float x = random.between(-half, half), z = random.between(-half, half);
    return Vec3{x, ground(x, z), z};
  };
  const int cells = afar ? 120 : 160;
  add_sheet(soup, cells, cells, [&](float u, float v) {
    const float x = reach * (2 * u - 1), z = reach * (2 * v - 1);
    return Vec3{x, ground(x, z), z};
  });
  if (afar) {
    const bool conifers = random.chance(0.5f);
    for (int i = random.whole(60, 400); i > 0; --i)
      add_far_tree(soup, on_ground(0.9f * reach), random.between(5, 13), conifers != random.chance(0.1f),
                   random);
    scene.cameras = {{-35, 6, -35}, {35, 18, 35}};
    scene.subject = {{-20, 0, -20}, {20, 6, 20}};
    return scene;
  }
  const Leaves leaves{random.between(0.06f, 0.2f), random.whole(4, 14), random.chance(0.4f)};
  for (int i = random.whole(1, 3); i > 0; --i)
    add_grown_tree(soup, on_ground(3), random.between(3, 8), leaves, random);
  for (int i = random.whole(2, 14); i > 0; --i)
    add_trunk(soup, on_ground(8), random.between(2.5f, 5), random.log_between(0.06f, 0.35f), random);
  for (int i = random.whole(0, 40); i > 0; --i)
    add_fern(soup, on_ground(4), random.between(0.2f, 0.6f), random);
  for (int i = random.whole(0, 3000); i > 0; --i) {  // fallen leaves
    const Vec3 at = on_ground(4) + Vec3{0, random.between(0.005f, 0.03f), 0}, d = any_direction(random);
    add_card(soup, at, 0.08f * normalised(Vec3{d.x, 0.15f * d.y, d.z}),
             0.025f * normalised(cross(d, {0, 1, 0})));
  }
  for (int i = random.whole(0, 4); i > 0; --i) {  // fallen logs and branches
    const Vec3 from = on_ground(4), to = on_ground(4);
    add_tube(soup, {from + Vec3{0, 0.1f, 0}, 0.5f * (from + to) + Vec3{0, 0.12f, 0}, to + Vec3{0, 0.1f, 0}},
             random.log_between(0.02f, 0.2f), 12);
  }
  if (random.chance(0.4f)) {
    add_block(soup, {-5, -1, -4.5f}, {5, 3, -4});
    add_ivy(soup, 4, 2.9f, -4, random);
  }
  scene.cameras = {{-4, 0.7f, -3}, {4, 2.4f, 4.5f}};
  scene.subject = {{-2.5f, 0.1f, -3}, {2.5f, 2.4f, 2.5f}};
  return scene;
}

}  // namespace nook::bake::nnao
