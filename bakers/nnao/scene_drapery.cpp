#include <algorithm>

#include "bakers/nnao/level_set.h"
#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// Adds a curtain along x from 0 to `width`. It hangs down from the frame's origin, and its folds get deeper
// downwards.
void add_curtain(TriangleSoup& soup, const Mat3x4& frame, float width, float drop, Random& random) {
  const std::uint64_t seed = random.bits();
  const float folds = width / random.log_between(0.06f, 0.4f), depth = random.between(0.02f, 0.12f);
  const float gather =
      random.chance(0.3f) ? random.between(0.3f, 0.7f) : 0;  // tied at two thirds of its height
  add_sheet(soup, std::min(400, int(folds * 10) + 10), 40, [&](float u, float v) {
    const float phase = 6.2831853f * folds * u + 1.5f * value_noise(seed, {4 * u, 1.5f * v, 0});
    const float tie = gather * std::exp(-30 * (v - 0.6f) * (v - 0.6f));
    const float x = width * (u * (1 - tie) + 0.02f * value_noise(seed + 1, {9 * u, 3 * v, 0}));
    const float z = depth * (0.35f + 0.65f * v) * (std::sin(phase) + 0.35f * std::sin(2.1f * phase + 1)) +
                    0.05f * value_noise(seed + 2, {2 * u, 2 * v, 1});
    return transform_point(frame, {x, -drop * v, z});
  });
  add_rod(soup, transform_point(frame, {-0.1f, 0.03f, 0}), transform_point(frame, {width + 0.1f, 0.03f, 0}),
          0.015f);
}

// Adds a cloth on a table. It is flat on top, and its hanging part has folds that are deepest at the corners.
void add_tablecloth(TriangleSoup& soup, const Mat3x4& frame, bool round, Random& random) {
  const float radius = random.between(0.4f, 0.8f), height = random.between(0.5f, 0.8f),
              drop = random.between(0.15f, 0.98f) * height;
  const int folds = random.whole(6, 18);
  const std::uint64_t seed = random.bits();
  add_sheet(soup, 200, 50, [&](float u, float v) {
    const float angle = 6.2831853f * u, c = std::cos(angle), s = std::sin(angle);
    const float edge = round ? 1.0f : 1 / std::max({std::abs(c), std::abs(s), 0.75f});
    const float reach = v * (radius + drop);  // distance along the cloth
    const float hang = std::max(0.0f, reach - radius);
    const float wave =
        0.28f * hang * (std::sin(float(folds) * angle + 2 * value_noise(seed, {2 * c, 2 * s, 0})) + 0.4f);
    const float out = (std::min(reach, radius) + wave + 0.01f) * edge;
    return transform_point(frame, {out * c, height - hang, out * s});
  });
  add_cylinder(soup, transform_point(frame, {}), transform_point(frame, {0, height - 0.03f, 0}), 0.05f, 0.04f,
               12);
  for (int i = random.whole(0, 4); i > 0; --i)
    add_crate_or_ball(soup,
                      transform_point(frame, {random.between(-0.4f, 0.4f) * radius, height + 0.002f,
                                              random.between(-0.4f, 0.4f) * radius}),
                      random.between(0.03f, 0.1f), random);
}

// Adds a sheet thrown over some boxes. Its height is the maximum of their smoothed tops, plus crumples.
void add_dust_sheet(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  struct Bump {
    float x, z, half_x, half_z, height;
  };
  std::vector<Bump> bumps;
  for (int i = random.whole(1, 5); i > 0; --i)
    bumps.push_back({random.between(-0.6f, 0.6f), random.between(-0.6f, 0.6f), random.between(0.1f, 0.4f),
                     random.between(0.1f, 0.4f), random.between(0.15f, 0.9f)});
  const std::uint64_t seed = random.bits();
  const float crumple = random.between(0.005f, 0.05f), scale = random.between(3, 12),
              slope = random.between(1.5f, 5);
  const int cells = random.whole(60, 180);
  add_sheet(soup, cells, cells, [&](float u, float v) {
    const float x = 1.3f * (2 * u - 1), z = 1.3f * (2 * v - 1);
    float y = 0.005f;
    for (const Bump& b : bumps) {
      const float dx = std::max(0.0f, std::abs(x - b.x) - b.half_x),
                  dz = std::max(0.0f, std::abs(z - b.z) - b.half_z);
      y = std::max(y, b.height - slope * std::sqrt(dx * dx + dz * dz));
    }
    const float ridge = 1 - std::abs(value_noise(seed, {scale * x, scale * z, 2 * y})) * 2;
    return transform_point(
        frame, {x + crumple * value_noise(seed + 3, {scale * x, scale * z, 0}), y + crumple * (ridge + 1),
                z + crumple * value_noise(seed + 4, {scale * x, scale * z, 0})});
  });
}

// Adds folded towels or clothes: stacks of layers with round front edges.
void add_folded_stack(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  float y = 0;
  const float half = random.between(0.12f, 0.25f);
  for (int i = random.whole(2, 9); i > 0; --i) {
    const float thick = random.between(0.008f, 0.03f);
    add_cushion(soup,
                moved(frame, {random.between(-0.01f, 0.01f), y + thick, random.between(-0.01f, 0.01f)}) *
                    standing_frame({}, random.between(-0.06f, 0.06f)),
                {half, thick, 0.7f * half}, 0.2f, 28);
    y += 1.95f * thick;
  }
}

// Adds a hanging banner, or washing on a line. Both are blown by the wind.
void add_banner(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float width = random.between(0.3f, 1.2f), drop = random.between(0.4f, 1.4f),
              blow = random.between(-0.4f, 0.4f);
  const std::uint64_t seed = random.bits();
  add_sheet(soup, 40, 40, [&](float u, float v) {
    return transform_point(frame, {width * u, -drop * v - 0.1f * std::sin(3.1415927f * u),
                                   blow * v * v + 0.15f * v * value_noise(seed, {3 * u, 2 * v, 0})});
  });
}

}  // namespace

TrainingScene make_drapery(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float half = random.between(1.6f, 3), height = random.between(2.2f, 3);
  add_floor(soup, half + 1.5f);
  add_block(soup, {-half, 0, -half - 0.2f}, {half, height, -half});
  if (random.chance(0.6f)) add_block(soup, {-half - 0.2f, 0, -half}, {-half, height, half});
  for (float x = -half + 0.1f; x < half - 0.5f;) {
    const float width = random.between(0.4f, 1.6f);
    if (random.chance(0.8f) && x + width < half)
      add_curtain(
          soup,
          standing_frame({x, height - random.between(0.05f, 0.4f), -half + random.between(0.1f, 0.2f)}, 0),
          width, height - random.between(0.45f, 1), random);
    x += width + random.between(0, 0.6f);
  }
  const auto place = [&] {
    return Vec3{random.between(-0.7f, 0.7f) * half, 0, random.between(-0.5f, 0.8f) * half};
  };
  for (int i = random.whole(1, 3); i > 0; --i)
    add_tablecloth(soup, standing_frame(place(), random.between(0, 6.28f)), random.chance(0.5f), random);
  for (int i = random.whole(0, 2); i > 0; --i)
    add_dust_sheet(soup, standing_frame(place(), random.between(0, 6.28f)), random);
  for (int i = random.whole(1, 5); i > 0; --i) {
    const Vec3 foot = place();
    const float stool = random.between(0.2f, 0.5f);
    add_block(soup, foot - Vec3{0.3f, 0, 0.25f}, foot + Vec3{0.3f, stool, 0.25f});
    add_folded_stack(soup, standing_frame(foot + Vec3{0, stool, 0}, random.between(0, 6.28f)), random);
  }
  if (random.chance(0.5f)) {
    const float y = random.between(1.6f, 2.2f);
    add_rod(soup, {-half, y, 0.3f}, {half, y, 0.3f}, 0.006f);
    for (float x = -half + 0.2f; x < half - 0.8f; x += random.between(0.6f, 1.6f))
      add_banner(soup, standing_frame({x, y, 0.3f}, 0), random);
  }
  for (int i = random.whole(0, 6); i > 0; --i)
    add_cushion(soup, standing_frame(place() + Vec3{0, 0.1f, 0}, random.between(0, 6.28f)),
                {random.between(0.15f, 0.35f), 0.1f, random.between(0.15f, 0.35f)},
                random.between(0.4f, 0.8f));
  scene.cameras = {{-half * 0.8f, 0.4f, -half * 0.5f}, {half * 0.9f, 2, half * 1.3f}};
  scene.subject = {{-half * 0.9f, 0, -half}, {half * 0.9f, height * 0.8f, half * 0.6f}};
  return scene;
}

}  // namespace nook::bake::nnao
