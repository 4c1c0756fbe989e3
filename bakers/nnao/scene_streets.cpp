#include <algorithm>

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

struct Style {
  float storey, bay, width, height, sill, reveal;
  bool shutters, balconies, bars;
};

Style any_style(Random& random) {
  const float storey = random.between(2.8f, 3.8f), bay = random.between(1.5f, 3);
  return {storey,
          bay,
          bay * random.between(0.35f, 0.7f),
          storey * random.between(0.4f, 0.65f),
          random.between(0.4f, 1),
          random.between(0.06f, 0.3f),
          random.chance(0.3f),
          random.chance(0.4f),
          random.chance(0.6f)};
}

// Adds one bay of one storey, from x = 0 to Style::bay, in front of the plane z = 0.
void add_bay(TriangleSoup& soup, const Mat3x4& frame, const Style& style, bool ground, bool door,
             Random& random) {
  const float x0 = 0.5f * (style.bay - style.width), x1 = x0 + style.width;
  const float y0 = door ? 0 : style.sill, y1 = std::min(y0 + style.height, style.storey - 0.2f);
  const float d = style.reveal;
  add_block(soup, frame, {0, 0, -d}, {x0, style.storey, 0});
  add_block(soup, frame, {x1, 0, -d}, {style.bay, style.storey, 0});
  add_block(soup, frame, {x0, y1, -d}, {x1, style.storey, 0});
  if (!door) add_block(soup, frame, {x0, 0, -d}, {x1, y0, 0});
  // The window's frame is set back in the wall, and the glass is behind the frame.
  const float bar = 0.035f;
  add_block(soup, frame, {x0, y0, -d}, {x0 + 2 * bar, y1, -d + bar});
  add_block(soup, frame, {x1 - 2 * bar, y0, -d}, {x1, y1, -d + bar});
  add_block(soup, frame, {x0, y1 - 2 * bar, -d}, {x1, y1, -d + bar});
  if (style.bars) {
    const float middle = 0.5f * (x0 + x1);
    add_block(soup, frame, {middle - bar, y0, -d}, {middle + bar, y1, -d + bar});
    add_block(soup, frame, {x0, 0.6f * y1 + 0.4f * y0, -d}, {x1, 0.6f * y1 + 0.4f * y0 + bar, -d + bar});
  }
  if (!door) add_block(soup, frame, {x0 - 0.1f, y0 - 0.08f, -d}, {x1 + 0.1f, y0, 0.08f});
  add_block(soup, frame, {x0 - 0.12f, y1, 0}, {x1 + 0.12f, y1 + 0.15f, 0.05f});
  if (door) {
    add_block(soup, frame, {x0 - 0.2f, 0, 0}, {x1 + 0.2f, 0.15f, 0.35f});
    if (random.chance(0.5f)) {
      // Adds an awning.
      const auto at = [&](float x, float y, float z) { return transform_point(frame, {x, y, z}); };
      add_quad(soup, at(x0 - 0.2f, y1 + 0.2f, 0), at(x1 + 0.2f, y1 + 0.2f, 0), at(x1 + 0.2f, y1 - 0.1f, 0.9f),
               at(x0 - 0.2f, y1 - 0.1f, 0.9f));
    }
  }
  if (style.shutters && !door)
    for (const float x : {x0 - 0.5f * style.width, x1})
      for (float y = y0; y < y1; y += 0.09f)
        add_block(soup, frame, {x + 0.02f, y, 0.01f}, {x + 0.5f * style.width - 0.02f, y + 0.06f, 0.05f});
  if (style.balconies && !ground && random.chance(0.4f)) {
    add_block(soup, frame, {x0 - 0.25f, -0.12f, 0}, {x1 + 0.25f, 0, 0.8f});
    const auto at = [&](float x, float z) { return transform_point(frame, {x, 0, z}); };
    const float gap = random.between(0.08f, 0.16f);
    add_fence(soup, at(x0 - 0.23f, 0.77f), at(x1 + 0.23f, 0.77f), 0.9f, gap, 0.009f);
    add_fence(soup, at(x0 - 0.23f, 0), at(x0 - 0.23f, 0.77f), 0.9f, gap, 0.009f);
    add_fence(soup, at(x1 + 0.23f, 0), at(x1 + 0.23f, 0.77f), 0.9f, gap, 0.009f);
  }
}

// Adds a house. It begins at x = 0 in the frame, and its front is at z = 0. Returns its width.
float add_house(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const Style style = any_style(random);
  const int storeys = random.whole(1, 5), bays = random.whole(2, 5);
  const float width = style.bay * float(bays), height = style.storey * float(storeys);
  const int door = random.whole(0, bays - 1);
  for (int s = 0; s < storeys; ++s)
    for (int b = 0; b < bays; ++b)
      add_bay(soup, moved(frame, {style.bay * float(b), style.storey * float(s), 0}), style, s == 0,
              s == 0 && b == door, random);
  add_block(soup, frame, {0, 0, -6}, {width, height, -style.reveal});
  const float out = random.between(0.15f, 0.5f);
  add_moulding(soup, moved(frame, {0, height, 0}), width,
               {{{0, -0.3f}, {0.3f * out, -0.25f}, {0.4f * out, -0.1f}, {out, 0}, {out, 0.1f}, {0, 0.12f}}});
  if (random.chance(0.5f))
    for (int s = 1; s < storeys; ++s)
      add_block(soup, frame, {0, style.storey * float(s) - 0.1f, 0}, {width, style.storey * float(s), 0.06f});
  if (random.chance(0.5f)) {
    // Adds a roof with chimneys.
    const auto at = [&](float x, float y, float z) { return transform_point(frame, {x, height + y, z}); };
    add_quad(soup, at(0, 0.1f, out), at(width, 0.1f, out), at(width, 2.2f, -3), at(0, 2.2f, -3));
    add_quad(soup, at(0, 0.1f, -6), at(width, 0.1f, -6), at(width, 2.2f, -3), at(0, 2.2f, -3));
    add_block(soup, frame, {0.2f * width, height + 1, -3}, {0.2f * width + 0.7f, height + 3, -2.5f});
  }
  if (random.chance(0.7f))  // a drainpipe
    add_rod(soup, transform_point(frame, {0.1f, 0, 0.08f}), transform_point(frame, {0.1f, height, 0.08f}),
            0.05f, 8);
  return width;
}

void add_lamp_post(TriangleSoup& soup, Vec3 foot, float side) {
  const float height = 4.5f;
  add_cylinder(soup, foot, foot + Vec3{0, 0.9f, 0}, 0.1f, 0.07f, 10);
  add_tube(soup,
           {foot, foot + Vec3{0, height - 0.4f, 0}, foot + Vec3{0, height, 0.3f * side},
            foot + Vec3{0, height + 0.1f, 0.9f * side}},
           0.045f);
  add_cushion(soup, standing_frame(foot + Vec3{0, height + 0.06f, 1.1f * side}, 0), {0.12f, 0.07f, 0.3f},
              0.5f, 16);
}

void add_bench(TriangleSoup& soup, const Mat3x4& frame) {
  for (int i = 0; i < 4; ++i)
    add_block(soup, frame, {-0.8f, 0.43f, 0.1f * float(i)}, {0.8f, 0.46f, 0.1f * float(i) + 0.075f});
  for (int i = 0; i < 3; ++i)
    add_block(soup, frame, {-0.8f, 0.55f + 0.12f * float(i), -0.06f},
              {0.8f, 0.63f + 0.12f * float(i), -0.03f});
  for (const float x : {-0.6f, 0.55f}) {
    add_block(soup, frame, {x, 0, -0.03f}, {x + 0.05f, 0.43f, 0.38f});
    add_block(soup, frame, {x, 0.43f, -0.03f}, {x + 0.05f, 0.9f, 0});
  }
}

}  // namespace

TrainingScene make_street(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float road = random.between(2.2f, 4.5f), walk = random.between(1.2f, 3), reach = 18, kerb = 0.13f;
  add_floor(soup, 60);
  const bool both = random.chance(0.7f);
  for (const float side : {-1.0f, 1.0f}) {
    const float front = side * road;
    add_block(soup, {-reach - 10, 0, std::min(front, side * (road + walk + 8))},
              {reach + 10, kerb, std::max(front, side * (road + walk + 8))});
    for (float x = -reach; x < reach; x += 1.0f)  // kerb stones
      add_bevelled_box(soup, standing_frame({x, 0.5f * kerb, front}, 0), {0.49f, 0.5f * kerb + 0.01f, 0.08f},
                       0.015f);
    if (side > 0 && !both) continue;
    // The fronts of the houses face the road.
    const float turned = side < 0 ? 0 : 3.1415927f;
    for (float x = -reach; x < reach;) {
      const Mat3x4 frame = standing_frame({-side * x, kerb, side * (road + walk)}, turned);
      x += add_house(soup, frame, random) + (random.chance(0.2f) ? random.between(0.5f, 3) : 0);
    }
    for (float x = -reach + random.between(0, 4); x < reach; x += random.between(3, 8)) {
      const Vec3 foot{x, kerb, front + side * 0.4f};
      switch (random.below(4)) {
        case 0:
          add_lamp_post(soup, foot, -side);
          break;
        case 1:
          for (int i = 0; i < 3; ++i)
            add_capsule(soup, foot + Vec3{0.8f * float(i), 0, 0}, foot + Vec3{0.8f * float(i), 0.85f, 0},
                        0.06f);
          break;
        case 2:
          add_bench(soup, standing_frame(foot + Vec3{0, 0, 0.3f * side}, side > 0 ? 0 : 3.1415927f));
          break;
        default:
          add_lathe(
              soup, standing_frame(foot, 0),
              {{{0, 0.02f}, {0.2f, 0.02f}, {0.26f, 0.75f}, {0.28f, 0.78f}, {0.24f, 0.78f}, {0.2f, 0.1f}}},
              20);
      }
    }
    for (float x = -reach + random.between(0, 6); x < reach; x += random.between(4.6f, 12))
      if (random.chance(0.8f))
        add_car(soup, standing_frame({x, 0, front - side * 1.05f}, 1.5707963f + (side > 0 ? 3.1415927f : 0)),
                random);
  }
  scene.cameras = {{-10, 1, -road - 0.8f * walk}, {10, 3.5f, road + (both ? 0.8f * walk : 12.0f)}};
  scene.subject = {{-12, 0, -road - walk}, {12, 6, both ? road + walk : -road}};
  return scene;
}

}  // namespace nook::bake::nnao
