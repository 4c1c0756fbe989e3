#include <algorithm>

#include "bakers/nnao/level_set.h"
#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// An area for a surface. In the frame, it covers x = 0 to `width` and y = 0 to `height`. The surface is at
// about z = 0, and its relief stands out along +z.
struct Wall {
  Mat3x4 frame;
  float width, height;
};

void add_courses(TriangleSoup& soup, const Wall& wall, Random& random) {
  const float long_side = random.log_between(0.12f, 0.6f), course = long_side * random.between(0.25f, 0.6f);
  const float joint = random.between(0.006f, 0.02f), depth = random.between(0.006f, 0.03f),
              bevel = random.chance(0.5f) ? random.between(0.003f, 0.02f) : 0.001f,
              jitter = random.chance(0.5f) ? 0.4f : 0.05f;
  const bool bonded = random.chance(0.8f);
  int row = 0;
  for (float y = 0; y + course < wall.height; y += course + joint, ++row)
    for (float x = bonded && row % 2 ? -0.5f * long_side : 0; x < wall.width; x += long_side + joint) {
      if (random.chance(0.01f)) continue;  // a missing stone
      const float low = std::max(x, 0.0f), high = std::min(x + long_side, wall.width);
      if (high - low < 0.02f) continue;
      const Vec3 half{0.5f * (high - low), 0.5f * course, depth + 0.02f};
      const float out = depth * (1 + jitter * random.between(-1, 1)) - half.z;
      Mat3x4 stone = moved(wall.frame, {0.5f * (low + high), y + half.y, out});
      if (jitter > 0.1f)
        stone = rolled(tilted(stone, random.between(-0.03f, 0.03f)), random.between(-0.02f, 0.02f));
      add_bevelled_box(soup, stone, half, bevel);
    }
}

void add_rubble(TriangleSoup& soup, const Wall& wall, Random& random) {
  const float size = random.log_between(0.06f, 0.25f);
  for (float y = 0; y < wall.height; y += 1.3f * size)
    for (float x = 0; x < wall.width; x += 1.6f * size) {
      const Vec3 half{size * random.between(0.6f, 1.1f), size * random.between(0.5f, 0.8f),
                      size * random.between(0.3f, 0.7f)};
      const Vec3 place{x + size * random.between(-0.3f, 0.3f), y + size * random.between(-0.2f, 0.2f), 0};
      add_cushion(soup, rolled(moved(wall.frame, place), random.between(-0.4f, 0.4f)), half,
                  random.between(0.4f, 0.9f), 14);
    }
}

void add_planks(TriangleSoup& soup, const Wall& wall, Random& random) {
  const float board = random.between(0.07f, 0.25f), gap = random.between(0.002f, 0.02f),
              lap = random.chance(0.3f) ? 0.1f : 0;
  for (float y = 0; y + board < wall.height; y += board + gap)
    for (float x = 0; x < wall.width;) {
      const float length = std::min(random.between(0.6f, 2.5f), wall.width - x);
      if (length > 0.05f)
        add_bevelled_box(
            soup,
            tilted(moved(wall.frame, {x + 0.5f * length, y + 0.5f * board, random.between(-0.003f, 0.004f)}),
                   lap),
            {0.5f * length - 0.5f * gap, 0.5f * board * (1 + lap), 0.015f}, 0.004f);
      x += length;
    }
}

// Adds rows of tiles, which are half pipes or flat. Each row overlaps the row below.
void add_tiles(TriangleSoup& soup, const Wall& wall, Random& random) {
  const float tile = random.between(0.12f, 0.3f), row = tile * random.between(0.8f, 1.4f),
              bend = random.chance(0.6f) ? 0.5f : 0.03f;
  for (float y = 0; y < wall.height; y += row)
    for (float x = 0; x + tile <= wall.width; x += tile) {
      const float lift = random.between(0, 0.01f);
      add_sheet(soup, bend > 0.1f ? 8 : 2, 1, [&](float u, float v) {
        const float across = bend * tile * std::sin(3.1415927f * u);
        return transform_point(wall.frame,
                               {x + u * 0.97f * tile, y + v * 1.15f * row, across + 0.03f * (1 - v) + lift});
      });
    }
}

void add_corrugation(TriangleSoup& soup, const Wall& wall, Random& random) {
  const float wave = random.log_between(0.03f, 0.25f), depth = wave * random.between(0.15f, 0.5f);
  const bool square = random.chance(0.4f);
  const int columns = std::min(900, int(wall.width / wave * 12));
  add_sheet(soup, columns, 1, [&](float u, float v) {
    float out = std::sin(6.2831853f * u * wall.width / wave);
    if (square) out = std::min(std::max(2.5f * out, -1.0f), 1.0f);
    return transform_point(wall.frame, {u * wall.width, v * wall.height, depth * out});
  });
}

// Adds rosettes, waves and rings in low relief, or rough plaster.
void add_carving(TriangleSoup& soup, const Wall& wall, Random& random) {
  const float cell = random.log_between(0.15f, 0.8f), depth = cell * random.between(0.05f, 0.25f);
  const int petals = random.whole(3, 12), kind = random.whole(0, 2);
  const std::uint64_t seed = random.bits();
  const auto quads = [](float length) { return std::min(260, std::max(8, int(length / 0.012f))); };
  add_sheet(soup, quads(wall.width), quads(wall.height), [&](float u, float v) {
    const float x = u * wall.width, y = v * wall.height;
    const float cx = x / cell - std::floor(x / cell) - 0.5f, cy = y / cell - std::floor(y / cell) - 0.5f;
    const float r = std::sqrt(cx * cx + cy * cy), angle = std::atan2(cy, cx);
    float out = 0;
    if (kind == 0)
      out = r < 0.4f ? std::abs(std::cos(0.5f * float(petals) * angle)) * std::sin(7 * r)
                     : (r < 0.45f ? 0.6f : 0);
    if (kind == 1) out = 0.5f + 0.5f * std::cos(25 * r + float(petals) * std::floor(x / cell));
    if (kind == 2) out = fractal_noise(seed, {3 * x / cell, 3 * y / cell, 0}, 5);
    return transform_point(wall.frame, {x, y, depth * out});
  });
}

void add_panels(TriangleSoup& soup, const Wall& wall, Random& random) {
  const float width = random.between(0.3f, 0.9f), height = random.between(0.4f, 1.2f),
              rail = random.between(0.04f, 0.1f), depth = random.between(0.01f, 0.05f);
  add_block(soup, wall.frame, {0, 0, -0.05f}, {wall.width, wall.height, 0});
  for (float x = 0; x + width <= wall.width; x += width)
    for (float y = 0; y + height <= wall.height; y += height) {
      const Mat3x4 panel = moved(wall.frame, {x, y, 0});
      add_block(soup, panel, {0, 0, 0}, {rail, height, depth});
      add_block(soup, panel, {width - rail, 0, 0}, {width, height, depth});
      add_block(soup, panel, {rail, 0, 0}, {width - rail, rail, depth});
      add_block(soup, panel, {rail, height - rail, 0}, {width - rail, height, depth});
      add_bevelled_box(soup, moved(panel, {0.5f * width, 0.5f * height, 0}),
                       {0.5f * width - 1.6f * rail, 0.5f * height - 1.6f * rail, 0.9f * depth}, 0.8f * depth);
    }
}

void add_surface(TriangleSoup& soup, const Wall& wall, Random& random) {
  using Add = void (*)(TriangleSoup&, const Wall&, Random&);
  constexpr Add kinds[] = {add_courses, add_courses,     add_rubble,  add_planks,
                           add_tiles,   add_corrugation, add_carving, add_panels};
  const auto corner = [&](float x, float y) { return transform_point(wall.frame, {x, y, -0.002f}); };
  add_quad(soup, corner(0, 0), corner(wall.width, 0), corner(wall.width, wall.height),
           corner(0, wall.height));
  kinds[random.below(8)](soup, wall, random);
}

}  // namespace

TrainingScene make_relief(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float half = random.between(1.2f, 2.8f), height = random.between(1.5f, 3);
  const Mat3x4 back = standing_frame({-half, 0, -half}, 0),
               left = standing_frame({-half, 0, half}, 1.5707963f);
  // The floor lies along x and -z.
  const Mat3x4 floor{{1, 0, 0, -half, 0, 0, 1, 0, 0, -1, 0, half}};
  add_floor(soup, 3 * half);
  add_surface(soup, {moved(floor, {0, 0, 0.004f}), 2 * half, 2 * half}, random);
  add_surface(soup, {back, 2 * half, height}, random);
  if (random.chance(0.7f)) add_surface(soup, {left, 2 * half, height}, random);
  if (random.chance(0.4f))  // a lean-to of another surface
    add_surface(soup, {tilted(moved(back, {0.3f * half, 0.2f, 0.9f}), -random.between(0.4f, 1)), half, 1},
                random);
  if (random.chance(0.5f)) {  // a buttress
    const float x = random.between(0.4f, 1.4f) * half, w = random.between(0.15f, 0.4f),
                out = random.between(0.1f, 0.5f);
    add_block(soup, back, {x, 0, 0}, {x + w, 0.8f * height, out});
    add_surface(soup, {moved(back, {x, 0, out}), w, 0.8f * height}, random);
  }
  const int things = random.whole(0, 10);
  for (int i = 0; i < things; ++i)
    add_crate_or_ball(soup, {random.between(-0.7f, 0.9f) * half, 0, random.between(-0.7f, 0.9f) * half},
                      random.log_between(0.04f, 0.3f), random);
  scene.cameras = {{-0.7f * half, 0.3f, -0.7f * half}, {1.5f * half, 1.9f, 1.5f * half}};
  scene.subject = {{-half, 0, -half}, {0.5f * half, 0.7f * height, 0.3f * half}};
  return scene;
}

}  // namespace nook::bake::nnao
