#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {

void add_table(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float height = random.between(0.4f, 1.0f), x = random.between(0.35f, 1.1f),
              z = random.between(0.3f, 0.6f);
  const float leg = random.between(0.015f, 0.05f);
  const auto at = [&](float px, float py, float pz) { return transform_point(frame, {px, py, pz}); };
  Mat3x4 top = frame;
  top.m[7] += height;
  add_box(soup, top, {x, random.between(0.012f, 0.04f), z});
  for (const float sx : {-1.0f, 1.0f})
    for (const float sz : {-1.0f, 1.0f}) {
      const float px = sx * (x - leg), pz = sz * (z - leg);
      add_cylinder(soup, at(px, 0, pz), at(px, height, pz), leg * 0.7f, leg, 8);
    }
  const int things = random.whole(0, 6);
  for (int i = 0; i < things; ++i) {
    const Vec3 foot = at(random.between(-x, x) * 0.85f, height + 0.02f, random.between(-z, z) * 0.85f);
    add_crate_or_ball(soup, foot, random.between(0.04f, 0.14f), random);
  }
}

void add_chair(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float seat = random.between(0.4f, 0.5f), half = random.between(0.18f, 0.24f);
  const float leg = random.between(0.01f, 0.025f), back = seat + random.between(0.35f, 0.6f);
  const auto at = [&](float x, float y, float z) { return transform_point(frame, {x, y, z}); };
  Mat3x4 board = frame;
  board.m[7] += seat;
  add_box(soup, board, {half, 0.02f, half});
  for (const float x : {-half, half}) {
    add_rod(soup, at(x, 0, half), at(x, seat, half), leg);
    add_rod(soup, at(x, 0, -half), at(x, back, -half), leg);
  }
  const int slats = random.whole(2, 5);
  for (int i = 0; i < slats; ++i) {
    const float y = seat + (back - seat) * (float(i) + 1) / float(slats);
    add_box(soup, standing_frame({0, 0, 0}, 0) * frame * Mat3x4{{1, 0, 0, 0, 0, 1, 0, y, 0, 0, 1, -half}},
            {half, 0.03f, 0.01f});
  }
}

namespace {

// Adds a shelf of boards, uprights and books against the frame's wall z = 0.
void add_shelf(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float width = random.between(0.4f, 0.9f), depth = random.between(0.12f, 0.22f);
  const int boards = random.whole(2, 6);
  const auto box = [&](Vec3 low, Vec3 high) {
    const Vec3 middle = 0.5f * (low + high);
    add_box(soup, frame * Mat3x4{{1, 0, 0, middle.x, 0, 1, 0, middle.y, 0, 0, 1, middle.z}}, high - middle);
  };
  const float gap = random.between(0.28f, 0.4f);
  for (const float side : {-width, width})
    box({side - 0.015f, 0, 0}, {side + 0.015f, gap * float(boards), 2 * depth});
  for (int i = 0; i <= boards; ++i) {
    const float y = gap * float(i);
    box({-width, y, 0}, {width, y + 0.02f, 2 * depth});
    for (float x = -width + 0.05f; i < boards && x < width - 0.08f;) {
      const float thick = random.between(0.015f, 0.06f);
      if (random.chance(0.75f))
        box({x, y + 0.02f, 0.03f},
            {x + thick, y + gap * random.between(0.5f, 0.85f), depth * random.between(1, 1.8f)});
      x += thick + (random.chance(0.2f) ? random.between(0.02f, 0.2f) : 0.002f);
    }
  }
}

void add_wall_with_opening(TriangleSoup& soup, const Mat3x4& frame, float half, float height,
                           Random& random) {
  const auto box = [&](float x0, float x1, float y0, float y1) {
    if (x1 - x0 < 1e-3f || y1 - y0 < 1e-3f) return;
    add_box(soup, frame * Mat3x4{{1, 0, 0, (x0 + x1) / 2, 0, 1, 0, (y0 + y1) / 2, 0, 0, 1, -0.1f}},
            {(x1 - x0) / 2, (y1 - y0) / 2, 0.1f});
  };
  const float middle = random.between(-half, half) * 0.6f, wide = random.between(0.4f, 0.8f);
  const bool door = random.chance(0.4f);
  const float sill = door ? 0 : random.between(0.6f, 1.2f),
              lintel = std::min(height, sill + random.between(0.8f, 2.1f));
  box(-half, middle - wide, 0, height);
  box(middle + wide, half, 0, height);
  box(middle - wide, middle + wide, 0, sill);
  box(middle - wide, middle + wide, lintel, height);
}

}  // namespace

TrainingScene make_room(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float half = random.between(1.6f, 4.0f), height = random.between(2.2f, 3.6f);
  add_floor(soup, half);
  if (random.chance(0.6f))
    add_quad(soup, {-half, height, -half}, {half, height, -half}, {half, height, half},
             {-half, height, half});
  for (int wall = 0; wall < 4; ++wall) {
    const float angle = 1.5707963f * float(wall);
    const Mat3x4 frame = standing_frame({-half * std::sin(angle), 0, -half * std::cos(angle)}, angle);
    if (random.chance(0.5f))
      add_wall_with_opening(soup, frame, half, height, random);
    else
      add_box(soup, frame * Mat3x4{{1, 0, 0, 0, 0, 1, 0, height / 2, 0, 0, 1, -0.1f}},
              {half, height / 2, 0.1f});
    if (random.chance(0.6f))
      add_shelf(soup,
                frame * Mat3x4{{1, 0, 0, random.between(-half, half) * 0.6f, 0, 1, 0,
                                random.chance(0.5f) ? 0 : 0.9f, 0, 0, 1, 0}},
                random);
    // Adds skirting boards and mouldings.
    add_box(soup, frame * Mat3x4{{1, 0, 0, 0, 0, 1, 0, 0.05f, 0, 0, 1, 0.01f}}, {half, 0.05f, 0.012f});
  }
  const int pieces = random.whole(4, 10);
  for (int i = 0; i < pieces; ++i) {
    const Mat3x4 frame =
        standing_frame({random.between(-half, half) * 0.75f, 0, random.between(-half, half) * 0.75f},
                       random.chance(0.5f) ? 0 : random.between(0, 6.28f));
    switch (random.below(5)) {
      case 0:
      case 1:
        add_table(soup, frame, random);
        break;
      case 2:
        add_chair(soup, frame, random);
        break;
      case 3:  // an armchair or a bed: fat boxes
        add_box(soup, frame * Mat3x4{{1, 0, 0, 0, 0, 1, 0, 0.25f, 0, 0, 1, 0}},
                {random.between(0.4f, 0.9f), 0.17f, 0.4f});
        add_box(soup, frame * Mat3x4{{1, 0, 0, 0, 0, 1, 0, 0.5f, 0, 0, 1, -0.36f}},
                {random.between(0.4f, 0.9f), 0.3f, 0.08f});
        break;
      default:
        add_cylinder(soup, transform_point(frame, {}), transform_point(frame, {0, height, 0}), 0.15f, 0.13f,
                     20);
    }
  }
  scene.cameras = {{-half * 0.8f, 0.5f, -half * 0.8f}, {half * 0.8f, height * 0.85f, half * 0.8f}};
  scene.subject = {{-half, 0, -half}, {half, height * 0.6f, half}};
  return scene;
}

}  // namespace nook::bake::nnao
