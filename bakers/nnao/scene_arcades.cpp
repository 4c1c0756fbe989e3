#include <algorithm>

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

struct Order {
  float height, radius, spacing;
  int kind;  // 0: round, 1: fluted, 2: a square pier with cut edges
};

void add_pillar(TriangleSoup& soup, const Mat3x4& frame, const Order& order) {
  const float r = order.radius, foot = 1.2f * r, head = 1.1f * r, h = order.height;
  add_block(soup, frame, {-1.5f * r, 0, -1.5f * r}, {1.5f * r, 0.4f * foot, 1.5f * r});
  add_block(soup, frame, {-1.5f * r, h - 0.35f * head, -1.5f * r}, {1.5f * r, h, 1.5f * r});
  if (order.kind == 2) {
    const float half = 0.5f * (h - 0.4f * foot);
    add_bevelled_box(soup, moved(frame, {0, half + 0.4f * foot, 0}), {r, half, r}, 0.2f * r);
    return;
  }
  // Adds the base's two rolls, and the bell of the capital.
  add_torus(soup, moved(frame, {0, 0.6f * foot, 0}), 1.15f * r, 0.2f * foot, 28);
  add_torus(soup, moved(frame, {0, 0.95f * foot, 0}), 1.02f * r, 0.12f * foot, 28);
  add_lathe(soup, frame,
            {{{0.85f * r, h - 1.4f * head},
              {1.0f * r, h - 1.3f * head},
              {0.88f * r, h - 1.2f * head},
              {0.95f * r, h - 0.8f * head},
              {1.4f * r, h - 0.35f * head}}},
            24);
  const int flutes = 18, sides = order.kind == 1 ? 4 * flutes : 28;
  add_sheet(soup, sides, 12, [&](float u, float v) {
    const float angle = 6.2831853f * u;
    const float hollow =
        order.kind == 1 ? 0.09f * r * std::abs(std::sin(0.5f * float(flutes) * angle)) : 0.0f;
    // The shaft is thinner at the top.
    const float out = r * (1 - 0.15f * v * v) - hollow;
    return transform_point(
        frame, {out * std::cos(angle), foot + v * (h - foot - 1.2f * head), out * std::sin(angle)});
  });
}

// Adds a wall with an arched opening, from x = -half to half and from the springing line (`spring`) to `top`.
void add_arch(TriangleSoup& soup, const Mat3x4& frame, float half, float opening, float spring, float top,
              float thick, bool pointed) {
  const int parts = 18;
  const auto curve = [&](int i) -> std::array<float, 2> {
    const float t = float(i) / float(parts);
    if (!pointed) return {-opening * std::cos(3.1415927f * t), opening * std::sin(3.1415927f * t)};
    // A pointed arch: two arcs, each centred on the opposite end.
    const float angle = 1.0471976f * (t < 0.5f ? 2 * t : 2 - 2 * t);
    const float x = opening - 2 * opening * std::cos(angle);
    return {t < 0.5f ? x : -x, 2 * opening * std::sin(angle)};
  };
  const float crown = std::max(top, spring + (pointed ? 1.74f : 1.0f) * opening + 0.1f);
  for (const float z : {-thick, thick}) {
    for (int i = 0; i < parts; ++i) {
      const auto a = curve(i), b = curve(i + 1);
      add_quad(soup, transform_point(frame, {a[0], spring + a[1], z}),
               transform_point(frame, {b[0], spring + b[1], z}), transform_point(frame, {b[0], crown, z}),
               transform_point(frame, {a[0], crown, z}));
    }
    for (const float side : {-1.0f, 1.0f})
      add_quad(soup, transform_point(frame, {side * opening, spring, z}),
               transform_point(frame, {side * half, spring, z}),
               transform_point(frame, {side * half, crown, z}),
               transform_point(frame, {side * opening, crown, z}));
  }
  for (int i = 0; i < parts; ++i) {
    const auto a = curve(i), b = curve(i + 1);
    add_quad(soup, transform_point(frame, {a[0], spring + a[1], -thick}),
             transform_point(frame, {b[0], spring + b[1], -thick}),
             transform_point(frame, {b[0], spring + b[1], thick}),
             transform_point(frame, {a[0], spring + a[1], thick}));
  }
  for (const float side : {-1.0f, 1.0f})
    add_quad(soup, transform_point(frame, {side * opening, spring, -thick}),
             transform_point(frame, {side * half, spring, -thick}),
             transform_point(frame, {side * half, spring, thick}),
             transform_point(frame, {side * opening, spring, thick}));
  add_block(soup, frame, {-half, crown, -thick}, {half, crown + 0.15f, thick});
}

void add_cornice(TriangleSoup& soup, const Mat3x4& frame, float length, float size, Random& random) {
  add_moulding(soup, frame, length,
               {{{0, 0},
                 {0.3f * size, 0},
                 {0.35f * size, 0.25f * size},
                 {0.6f * size, 0.4f * size},
                 {0.65f * size, 0.65f * size},
                 {1.0f * size, 0.75f * size},
                 {1.05f * size, 1.0f * size},
                 {0, 1.05f * size}}});
  if (random.chance(0.5f))
    // Adds dentils below the overhang.
    for (float x = 0.1f * size; x < length - 0.3f * size; x += 0.5f * size)
      add_block(soup, frame, {x, 0.38f * size, 0}, {x + 0.3f * size, 0.62f * size, 0.85f * size});
}

void add_balustrade(TriangleSoup& soup, const Mat3x4& frame, float length, Random& random) {
  const float h = random.between(0.7f, 1.0f), r = random.between(0.04f, 0.07f);
  add_block(soup, frame, {0, 0, -1.8f * r}, {length, 0.1f, 1.8f * r});
  add_block(soup, frame, {0, h - 0.12f, -2 * r}, {length, h, 2 * r});
  for (float x = 2.5f * r; x < length; x += random.between(3, 3.3f) * r)
    add_lathe(
        soup, moved(frame, {x, 0.1f, 0}),
        {{{0.8f * r, 0}, {0.5f * r, 0.1f * h}, {r, 0.3f * h}, {0.35f * r, 0.6f * h}, {0.7f * r, h - 0.22f}}},
        12);
}

void add_coffers(TriangleSoup& soup, Vec3 low, Vec3 high, float spacing, float depth) {
  add_block(soup, {low.x, low.y + depth, low.z}, {high.x, low.y + depth + 0.2f, high.z});
  const float beam = 0.12f * spacing;
  for (float x = low.x; x <= high.x; x += spacing)
    add_block(soup, {x - beam, low.y, low.z}, {x + beam, low.y + depth, high.z});
  for (float z = low.z; z <= high.z; z += spacing)
    add_block(soup, {low.x, low.y + 0.1f * depth, z - beam}, {high.x, low.y + depth, z + beam});
}

}  // namespace

TrainingScene make_arcade(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const Order order{random.between(2, 4.2f), random.between(0.12f, 0.32f), random.between(1.5f, 3.2f),
                    random.whole(0, 2)};
  const int bays = random.whole(3, 6), rows = random.whole(1, 3);
  const float half = 0.5f * order.spacing, far = half * float(bays), depth = random.between(2, 3.5f);
  const bool pointed = random.chance(0.4f), arched = random.chance(0.7f);
  const float rise = (pointed ? 1.74f : 1.0f) * (half - 1.3f * order.radius);
  const float top = order.height + (arched ? rise + random.between(0.15f, 0.6f) : 0.5f);
  add_floor(soup, 2 * far + 6);
  // Adds slabs with open joints, or steps all round.
  const float platform = random.chance(0.5f) ? 0.0f : 0.45f;
  for (int step = 0; platform > 0 && step < 3; ++step) {
    const float out = 1.2f + 0.35f * float(2 - step), y = 0.15f * float(step);
    add_block(soup, {-far - out, y, -depth * float(rows - 1) - out}, {far + out, y + 0.15f, out});
  }
  for (int row = 0; row < rows; ++row) {
    const Mat3x4 line = standing_frame({0, platform, -depth * float(row)}, 0);
    for (int i = 0; i <= bays; ++i)
      add_pillar(soup, moved(line, {-far + order.spacing * float(i), 0, 0}), order);
    if (arched)
      for (int i = 0; i < bays; ++i)
        add_arch(soup, moved(line, {-far + half + order.spacing * float(i), 0, 0}), half,
                 half - 1.3f * order.radius, order.height, top, 0.9f * order.radius, pointed);
    else
      add_block(soup, line, {-far - 1.2f * order.radius, order.height, -1.2f * order.radius},
                {far + 1.2f * order.radius, top, 1.2f * order.radius});
    if (row == 0 && random.chance(0.4f)) add_balustrade(soup, moved(line, {-far, 0, 0}), 2 * far, random);
  }
  add_cornice(soup, standing_frame({-far - 0.3f, platform + top, order.radius}, 0), 2 * far + 0.6f,
              random.between(0.2f, 0.6f), random);
  const float back = -depth * float(rows);
  if (random.chance(0.8f)) {
    add_block(soup, {-far - 1, 0, back - 0.3f}, {far + 1, platform + top + 0.4f, back});
    // Adds blind windows: frames and mouldings on the wall.
    for (int i = 0; i < bays; ++i) {
      const Mat3x4 wall = standing_frame({-far + half + order.spacing * float(i), platform, back}, 0);
      add_block(soup, wall, {-0.4f * half, 0.9f, 0}, {0.4f * half, 0.98f, 0.12f});
      for (const float side : {-1.0f, 1.0f})
        add_block(soup, moved(wall, {side * 0.36f * half, 0, 0}), {-0.04f, 0.98f, 0}, {0.04f, 2, 0.06f});
      add_cornice(soup, moved(wall, {-0.45f * half, 2, 0}), 0.9f * half, 0.15f, random);
    }
  }
  if (random.chance(0.6f))
    add_coffers(soup, {-far, platform + top, back}, {far, platform + top, 0}, random.between(0.5f, 1.2f),
                random.between(0.1f, 0.4f));
  for (int i = 0; i < 8; ++i)
    add_crate_or_ball(soup, {random.between(-far, far), platform, random.between(back, 0)},
                      random.log_between(0.08f, 0.35f), random);
  scene.cameras = {{-far, platform + 0.4f, back + 0.4f}, {far, platform + 2.4f, 5}};
  scene.subject = {{-far, platform, back}, {far, platform + top, 0}};
  return scene;
}

}  // namespace nook::bake::nnao
