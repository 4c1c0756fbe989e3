#include <algorithm>

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// In its frame, each piece stands on y = 0, has its back at z = 0, faces +z, and starts at x = 0.

void add_handle(TriangleSoup& soup, const Mat3x4& frame, float width, int kind) {
  if (kind == 0) {
    add_ellipsoid(soup, moved(frame, {0, 0, 0.02f}), {0.014f, 0.014f, 0.012f}, 12);
    add_rod(soup, transform_point(frame, {}), transform_point(frame, {0, 0, 0.015f}), 0.006f, 8);
    return;
  }
  const auto at = [&](float x, float z) { return transform_point(frame, {x, 0, z}); };
  add_tube(soup,
           {at(-width, 0), at(-width, 0.022f), at(-0.8f * width, 0.03f), at(0.8f * width, 0.03f),
            at(width, 0.022f), at(width, 0)},
           0.005f, 8);
}

// Adds fronts of drawers or doors, with gaps between them. Some are open.
void add_fronts(TriangleSoup& soup, const Mat3x4& frame, float width, float height, int columns, int rows,
                Random& random) {
  const float gap = random.between(0.0015f, 0.008f), proud = random.chance(0.5f) ? 0.0f : 0.018f;
  const int handle = random.whole(0, 2);
  const float w = width / float(columns), h = height / float(rows);
  for (int c = 0; c < columns; ++c)
    for (int r = 0; r < rows; ++r) {
      const float open = random.chance(0.1f) ? random.between(0.02f, 0.25f) : 0;
      const Mat3x4 front =
          moved(frame, {w * (float(c) + 0.5f), h * (float(r) + 0.5f), proud - 0.009f + open});
      add_bevelled_box(soup, front, {0.5f * w - gap, 0.5f * h - gap, 0.009f}, 0.002f);
      if (open > 0) {  // the drawer's sides and bottom
        for (const float x : {-0.5f * w + 0.02f, 0.5f * w - 0.02f})
          add_block(soup, moved(front, {x, 0, 0}), {-0.006f, -0.3f * h, -0.3f}, {0.006f, 0.3f * h, 0});
        add_block(soup, front, {-0.5f * w + 0.02f, -0.3f * h, -0.3f}, {0.5f * w - 0.02f, -0.28f * h, 0});
      }
      if (handle < 2)
        add_handle(soup, moved(front, {0, 0.2f * h, 0.009f}), std::min(0.07f, 0.3f * w), handle);
    }
}

void add_cabinet(TriangleSoup& soup, const Mat3x4& frame, float width, float height, float depth,
                 Random& random) {
  const float board = 0.018f, plinth = random.chance(0.6f) ? random.between(0.05f, 0.12f) : 0.0f;
  const float leg = plinth > 0 ? 0.0f : random.between(0.08f, 0.2f), low = std::max(plinth, leg);
  if (plinth > 0) add_block(soup, frame, {0.01f, 0, 0.02f}, {width - 0.01f, plinth, depth - 0.05f});
  for (const float x : {0.03f, width - 0.03f})
    for (const float z : {0.03f, depth - 0.03f})
      if (leg > 0)
        add_cylinder(soup, transform_point(frame, {x, 0, z}), transform_point(frame, {x, leg, z}), 0.012f,
                     0.02f, 10);
  add_block(soup, frame, {0, low, 0}, {board, height, depth});
  add_block(soup, frame, {width - board, low, 0}, {width, height, depth});
  add_block(soup, frame, {board, low, 0}, {width - board, low + board, depth});
  add_block(soup, frame, {board, low, 0}, {width - board, height, board});
  const float over = random.between(0, 0.025f);
  add_bevelled_box(soup, moved(frame, {0.5f * width, height, 0.5f * depth}),
                   {0.5f * width + over, 0.015f, 0.5f * depth + over}, 0.004f);
  add_fronts(soup, moved(frame, {board, low + board, depth}), width - 2 * board,
             height - low - board - 0.015f, random.whole(1, 3), random.whole(1, 5), random);
}

void add_books(TriangleSoup& soup, const Mat3x4& frame, float width, float height, float depth,
               Random& random) {
  float x = 0.01f;
  while (x < width - 0.07f) {
    const float thick = random.between(0.008f, 0.05f), tall = height * random.between(0.55f, 0.95f),
                deep = depth * random.between(0.55f, 0.9f);
    if (random.chance(0.08f)) {  // a pile of lying books
      float y = 0;
      for (int i = random.whole(2, 5); i > 0; --i) {
        const float t = random.between(0.015f, 0.04f);
        add_box(soup,
                moved(frame, {x + 0.09f, y + 0.5f * t, 0.5f * depth}) *
                    standing_frame({}, random.between(-0.1f, 0.1f)),
                {0.07f, 0.5f * t, 0.4f * depth});
        y += t;
      }
      x += 0.2f;
      continue;
    }
    if (random.chance(0.05f)) {
      x += random.between(0.03f, 0.2f);
      continue;
    }
    const Mat3x4 book = rolled(moved(frame, {x + 0.5f * thick, 0, 0.02f}), random.chance(0.1f) ? -0.12f : 0);
    // The covers are taller than the pages.
    add_block(soup, book, {-0.5f * thick, 0, 0}, {-0.5f * thick + 0.002f, tall, deep});
    add_block(soup, book, {0.5f * thick - 0.002f, 0, 0}, {0.5f * thick, tall, deep});
    add_block(soup, book, {-0.5f * thick, 0, deep - 0.003f}, {0.5f * thick, tall, deep});
    add_block(soup, book, {-0.45f * thick, 0.003f, 0.004f}, {0.45f * thick, tall - 0.004f, deep - 0.004f});
    x += thick + (random.chance(0.15f) ? 0.012f : 0.001f);
  }
}

void add_bookcase(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float width = random.between(0.6f, 1.2f), height = random.between(0.8f, 2.2f),
              depth = random.between(0.2f, 0.35f);
  for (const float x : {0.0f, width - 0.02f}) add_block(soup, frame, {x, 0, 0}, {x + 0.02f, height, depth});
  add_block(soup, frame, {0, 0, 0}, {width, height, 0.008f});
  const int shelves = random.whole(2, 6);
  const float gap = (height - 0.08f) / float(shelves);
  for (int i = 0; i <= shelves; ++i) {
    const float y = 0.05f + gap * float(i);
    add_block(soup, frame, {0.02f, y, 0}, {width - 0.02f, y + 0.02f, depth - 0.004f});
    if (i < shelves && random.chance(0.8f))
      add_books(soup, moved(frame, {0.02f, y + 0.02f, 0.01f}), width - 0.04f, gap - 0.03f, depth - 0.03f,
                random);
  }
}

void add_sofa(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const int seats = random.whole(1, 3);
  const float seat = random.between(0.55f, 0.75f), arm = random.between(0.1f, 0.22f),
              width = seat * float(seats) + 2 * arm;
  const float soft = random.between(0.25f, 0.5f);
  add_cushion(soup, moved(frame, {0.5f * width, 0.18f, 0.45f}), {0.5f * width, 0.12f, 0.43f}, 0.15f);
  for (const float x : {0.5f * arm, width - 0.5f * arm})
    add_cushion(soup, moved(frame, {x, 0.36f, 0.45f}), {0.5f * arm, 0.24f, 0.43f}, soft);
  for (int i = 0; i < seats; ++i) {
    const float x = arm + seat * (float(i) + 0.5f);
    add_cushion(soup, moved(frame, {x, 0.38f, 0.52f}), {0.495f * seat, 0.1f, 0.36f}, soft);
    add_cushion(soup, tilted(moved(frame, {x, 0.62f, 0.2f}), -0.2f), {0.49f * seat, 0.26f, 0.1f}, soft);
    if (random.chance(0.4f))
      add_cushion(soup, rolled(tilted(moved(frame, {x, 0.62f, 0.38f}), -0.5f), random.between(-0.3f, 0.3f)),
                  {0.2f, 0.2f, 0.07f}, 0.6f);
  }
  add_cushion(soup, tilted(moved(frame, {0.5f * width, 0.5f, 0.08f}), -0.1f), {0.5f * width, 0.34f, 0.08f},
              0.3f);
  for (const float x : {0.06f, width - 0.06f})
    for (const float z : {0.08f, 0.82f})
      add_cylinder(soup, transform_point(frame, {x, 0, z}), transform_point(frame, {x, 0.1f, z}), 0.015f,
                   0.025f, 8);
}

void add_bed(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float width = random.between(0.9f, 1.8f), length = 2;
  add_block(soup, frame, {0, 0.12f, 0}, {width, 0.3f, length});
  add_bevelled_box(soup, moved(frame, {0.5f * width, 0.45f, 0.03f}), {0.5f * width + 0.03f, 0.45f, 0.03f},
                   0.015f);
  add_cushion(soup, moved(frame, {0.5f * width, 0.4f, 0.53f * length}),
              {0.49f * width, 0.12f, 0.47f * length}, 0.12f, 32);
  for (int i = 0; i < (width > 1.3f ? 2 : 1); ++i)
    add_cushion(soup,
                tilted(moved(frame, {(width > 1.3f ? 0.27f + 0.46f * float(i) : 0.5f) * width, 0.58f, 0.3f}),
                       random.between(-0.3f, 0)),
                {0.2f * std::min(width, 1.7f), 0.08f, 0.2f}, 0.6f);
  // Adds a blanket that hangs over the sides in folds.
  const float fold = random.between(4, 14), hang = random.between(0.15f, 0.35f);
  add_sheet(soup, 80, 60, [&](float u, float v) {
    const float across = (2 * u - 1) * (0.52f * width + hang),
                over = std::max(0.0f, std::abs(across) - 0.52f * width);
    const float wave = std::sin(fold * 6.28f * v + 2 * std::sin(9 * v));
    const float x =
        0.5f * width +
        std::copysign(std::min(std::abs(across), 0.52f * width) + 0.02f * over / hang * wave + 0.01f, across);
    return transform_point(frame, {x, 0.545f - over + 0.008f * std::sin(11 * u + 7 * v) * std::sin(13 * v),
                                   0.6f + v * (length - 0.58f)});
  });
  for (const float x : {0.05f, width - 0.05f})
    for (const float z : {0.1f, length - 0.1f})
      add_rod(soup, transform_point(frame, {x, 0, z}), transform_point(frame, {x, 0.12f, z}), 0.03f);
}

void add_radiator(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const int ribs = random.whole(6, 20);
  const float pitch = random.between(0.04f, 0.07f);
  for (int i = 0; i < ribs; ++i)
    add_cushion(soup, moved(frame, {pitch * (float(i) + 0.5f), 0.42f, 0.1f}), {0.4f * pitch, 0.3f, 0.06f},
                0.3f, 12);
  for (const float y : {0.18f, 0.66f})
    add_rod(soup, transform_point(frame, {0, y, 0.1f}),
            transform_point(frame, {pitch * float(ribs), y, 0.1f}), 0.018f);
}

// Adds a wall of the room with its opening. It runs along x from 0 to `width`, and its surface is at z = 0.
void add_room_wall(TriangleSoup& soup, const Mat3x4& frame, float width, float height, bool door, bool window,
                   Random& random) {
  const float middle = random.between(0.3f, 0.7f) * width, half = door ? 0.45f : random.between(0.4f, 0.9f);
  const float low = door ? 0 : random.between(0.7f, 1), high = door ? 2.05f : random.between(1.9f, 2.3f),
              thick = 0.2f;
  const float x0 = middle - half, x1 = middle + half;
  const auto skirting = [&](float from, float to) {
    add_moulding(soup, moved(frame, {from, 0, 0}), to - from,
                 {{{0, 0}, {0.016f, 0}, {0.016f, 0.07f}, {0.006f, 0.095f}, {0, 0.1f}}});
  };
  if (!door && !window) {
    add_block(soup, frame, {0, 0, -thick}, {width, height, 0});
    skirting(0, width);
    return;
  }
  add_block(soup, frame, {0, 0, -thick}, {x0, height, 0});
  add_block(soup, frame, {x1, 0, -thick}, {width, height, 0});
  add_block(soup, frame, {x0, high, -thick}, {x1, height, 0});
  if (!door) add_block(soup, frame, {x0, 0, -thick}, {x1, low, 0});
  const float trim = random.between(0.05f, 0.11f);
  for (const float x : {x0 - trim, x1}) add_block(soup, frame, {x, low, 0}, {x + trim, high + trim, 0.018f});
  add_block(soup, frame, {x0, high, 0}, {x1, high + trim, 0.018f});
  if (door) {
    skirting(0, x0 - trim);
    skirting(x1 + trim, width);
    const float ajar = random.chance(0.5f) ? 0 : random.between(0.1f, 1.4f);
    const Mat3x4 leaf = moved(frame, {x0 + 0.01f, 0.006f, -0.06f}) * standing_frame({}, -ajar);
    add_block(soup, leaf, {0, 0, -0.02f}, {2 * half - 0.02f, high - 0.015f, 0.02f});
    for (const float y : {0.15f, 1.0f})
      add_bevelled_box(soup, moved(leaf, {half - 0.01f, y + 0.4f, 0}), {half - 0.13f, 0.35f, 0.028f}, 0.012f);
    add_tube(soup,
             {transform_point(leaf, {2 * half - 0.08f, 1, 0.02f}),
              transform_point(leaf, {2 * half - 0.08f, 1, 0.06f}),
              transform_point(leaf, {2 * half - 0.2f, 1, 0.065f})},
             0.009f);
  } else {
    skirting(0, width);
    add_block(soup, frame, {x0 - trim, low - 0.03f, -0.1f}, {x1 + trim, low, 0.05f});
    for (const float x : {x0, middle - 0.025f, x1 - 0.05f})
      add_block(soup, frame, {x, low, -0.14f}, {x + 0.05f, high, -0.1f});
    for (const float y : {low, high - 0.05f}) add_block(soup, frame, {x0, y, -0.14f}, {x1, y + 0.05f, -0.1f});
    const auto at = [&](float x, float y) { return transform_point(frame, {x, y, -0.12f}); };
    add_quad(soup, at(x0, low), at(x1, low), at(x1, high), at(x0, high));
    if (random.chance(0.5f)) add_radiator(soup, moved(frame, {x0 + 0.05f, 0, 0.01f}), random);
  }
}

}  // namespace

TrainingScene make_furniture(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float half = random.between(1.5f, 2.8f), height = random.between(2.3f, 2.9f);
  add_floor(soup, half + 1);
  add_quad(soup, {-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half});
  const int doors = random.whole(0, 3);
  for (int wall = 0; wall < 4; ++wall) {
    // x runs along the wall, z into the room.
    const float angle = 1.5707963f * float(wall);
    const Mat3x4 frame = moved(standing_frame({}, angle), {-half, 0, -half});
    const bool door = wall == doors, window = random.chance(0.5f);
    add_room_wall(soup, frame, 2 * half, height, door, window, random);
    if (random.chance(0.5f))
      add_moulding(soup, moved(frame, {0, height, 0}), 2 * half,
                   {{{0, -0.08f}, {0.02f, -0.07f}, {0.06f, -0.02f}, {0.07f, 0}}});
    float x = random.between(0.05f, 0.4f);
    while (!door && x < 2 * half - 1.3f) {
      const Mat3x4 place = moved(frame, {x, 0, random.between(0.02f, 0.05f)});
      switch (random.below(6)) {
        case 0: {
          const float width = random.between(0.5f, 1.4f), tall = random.between(0.4f, 1.1f);
          add_cabinet(soup, place, width, tall, random.between(0.35f, 0.6f), random);
          for (int i = random.whole(0, 3); i > 0; --i)
            add_crate_or_ball(
                soup, transform_point(place, {random.between(0.1f, 0.9f) * width, tall + 0.015f, 0.2f}),
                random.between(0.03f, 0.1f), random);
          x += width;
          break;
        }
        case 1:  // a wardrobe
          add_cabinet(soup, place, 1, random.between(1.8f, 2.2f), 0.58f, random);
          x += 1;
          break;
        case 2:
          add_bookcase(soup, place, random);
          x += 1.2f;
          break;
        case 3:
          if (x + 2.6f < 2 * half) add_sofa(soup, place, random);
          x += 2.6f;
          break;
        case 4:
          if (x + 1.8f < 2 * half) add_bed(soup, place, random);
          x += 1.85f;
          break;
        default:  // a worktop with cupboards above
          add_cabinet(soup, place, 1.2f, 0.88f, 0.58f, random);
          add_cabinet(soup, moved(place, {0, 1.45f, 0}), 1.2f, 0.7f, 0.33f, random);
          x += 1.2f;
      }
      x += random.chance(0.5f) ? 0.01f : random.between(0.05f, 0.6f);
    }
  }
  for (int i = random.whole(0, 3); i > 0; --i)
    add_table(soup,
              standing_frame({random.between(-0.4f, 0.4f) * half, 0, random.between(-0.4f, 0.4f) * half},
                             random.between(0, 3)),
              random);
  for (int i = random.whole(0, 3); i > 0; --i)
    add_chair(soup,
              standing_frame({random.between(-0.6f, 0.6f) * half, 0, random.between(-0.6f, 0.6f) * half},
                             random.between(0, 6)),
              random);
  scene.cameras = {{-half * 0.6f, 0.6f, -half * 0.6f}, {half * 0.6f, 1.9f, half * 0.6f}};
  scene.subject = {{-half, 0, -half}, {half, height * 0.7f, half}};
  return scene;
}

}  // namespace nook::bake::nnao
