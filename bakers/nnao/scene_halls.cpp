#include <algorithm>

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// Adds an I-beam along the frame's x axis, from 0 to `length`. Its middle is at y = 0.
void add_beam(TriangleSoup& soup, const Mat3x4& frame, float length, float height) {
  const float flange = 0.3f * height, thick = 0.05f * height;
  add_block(soup, frame, {0, -0.5f * height, -thick}, {length, 0.5f * height, thick});
  for (const float y : {-0.5f * height, 0.5f * height - 2 * thick})
    add_block(soup, frame, {0, y, -flange}, {length, y + 2 * thick, flange});
}

void add_truss(TriangleSoup& soup, Vec3 from, Vec3 to, float height, float rod, Random& random) {
  const int bays = std::max(2, int(length(to - from) / (1.1f * height)));
  const Vec3 up{0, height, 0};
  const float thick = rod * random.between(0.4f, 0.8f);
  add_rod(soup, from, to, rod);
  add_rod(soup, from + up, to + up, rod);
  for (int i = 0; i < bays; ++i) {
    const Vec3 a = from + float(i) / float(bays) * (to - from),
               b = from + float(i + 1) / float(bays) * (to - from);
    add_rod(soup, a, a + up, thick, 6);
    add_rod(soup, i % 2 ? a + up : a, i % 2 ? b : b + up, thick, 6);
  }
}

// Adds a pipe along x with flanges, valves, bends and hangers. `ceiling` is the height of the hangers' upper
// ends above the pipe.
void add_pipe_run(TriangleSoup& soup, const Mat3x4& frame, float length, float radius, float ceiling,
                  Random& random) {
  const auto at = [&](float x, float y, float z) { return transform_point(frame, {x, y, z}); };
  add_rod(soup, at(0, 0, 0), at(length, 0, 0), radius, 16);
  for (float x = random.between(0.2f, 1); x < length; x += random.between(0.8f, 3)) {
    switch (random.below(4)) {
      case 0:
        for (const float dx : {-0.02f, 0.025f})
          add_rod(soup, at(x + dx, 0, 0), at(x + dx + 0.018f, 0, 0), 1.6f * radius, 18);
        break;
      case 1:  // a valve with its wheel
        add_cushion(soup, moved(frame, {x, 0, 0}), {1.6f * radius, 1.3f * radius, 1.3f * radius}, 0.6f, 16);
        add_rod(soup, at(x, 0, 0), at(x, 0, 3.2f * radius), 0.25f * radius);
        add_torus(soup, tilted(moved(frame, {x, 0, 3.2f * radius}), 1.5707963f), 1.3f * radius,
                  0.18f * radius, 20);
        break;
      case 2:  // a bend down
        add_tube(soup, {at(x, 0, 0), at(x, -2 * radius, 0), at(x, -1.5f, 0)}, 0.8f * radius, 12);
        break;
      default:
        add_rod(soup, at(x, 0, 0), at(x, ceiling, 0), 0.006f, 5);
        add_torus(soup, rolled(moved(frame, {x, 0, 0}), 1.5707963f), 1.05f * radius, 0.008f, 16);
    }
  }
}

// Adds a sheet-metal duct with seams.
void add_duct(TriangleSoup& soup, const Mat3x4& frame, float length, float size, Random& random) {
  const float tall = size * random.between(0.5f, 1), part = random.between(0.6f, 1.4f);
  for (float x = 0; x < length; x += part) {
    add_block(soup, frame, {x, -tall, -size}, {std::min(x + part - 0.004f, length), tall, size});
    add_block(soup, frame, {x - 0.015f, -tall - 0.03f, -size - 0.03f},
              {x + 0.015f, tall + 0.03f, size + 0.03f});
    if (random.chance(0.3f))
      for (int i = 0; i < 6; ++i)
        add_block(
            soup,
            tilted(moved(frame, {x + 0.5f * part, tall * (0.25f * float(i) - 0.6f), size + 0.01f}), 0.6f),
            {-0.15f, -0.004f, -0.03f}, {0.15f, 0.004f, 0.03f});
  }
}

void add_cable_tray(TriangleSoup& soup, const Mat3x4& frame, float length, Random& random) {
  for (const float z : {-0.15f, 0.15f})
    add_block(soup, moved(frame, {0, 0, z}), {0, 0, -0.004f}, {length, 0.06f, 0.004f});
  for (float x = 0; x < length; x += 0.25f)
    add_block(soup, frame, {x, 0, -0.15f}, {x + 0.03f, 0.006f, 0.15f});
  for (int i = random.whole(2, 9); i > 0; --i) {
    const float z = random.between(-0.12f, 0.12f), r = random.between(0.008f, 0.022f);
    std::vector<Vec3> path;
    for (float x = 0; x <= length; x += 0.3f)
      path.push_back(transform_point(frame, {x, 0.006f + r, z + random.between(-0.01f, 0.01f)}));
    if (path.size() > 1) add_tube(soup, path, r, 7);
  }
}

// Adds the wall panels of a corridor: ribs, recessed plates, vents, boxes with lids and bolts.
void add_panel_wall(TriangleSoup& soup, const Mat3x4& frame, float length, float height, float bay,
                    Random& random) {
  add_block(soup, frame, {0, 0, -0.2f}, {length, height, 0});
  const float rib = random.between(0.04f, 0.2f), out = random.between(0.03f, 0.25f),
              slope = random.chance(0.5f) ? random.between(0.1f, 0.4f) : 0.0f;
  for (float x = 0; x + bay <= length + 0.01f; x += bay) {
    const Mat3x4 place = moved(frame, {x, 0, 0});
    add_moulding(soup, standing_frame({}, 0) * place, rib,
                 {{{0, 0},
                   {out + slope, 0},
                   {out, 0.3f * height},
                   {out, 0.7f * height},
                   {out + slope, height},
                   {0, height}}});
    const float w = bay - rib;
    switch (random.below(5)) {
      case 0:
        for (float y = 0.3f; y < 0.6f * height; y += 0.07f)
          add_block(soup, tilted(moved(place, {rib + 0.5f * w, y, 0.03f}), 0.7f),
                    {-0.35f * w, -0.004f, -0.035f}, {0.35f * w, 0.004f, 0.035f});
        break;
      case 1:
        for (int i = 0; i < 3; ++i)
          add_bevelled_box(soup, moved(place, {rib + 0.5f * w, height * (0.17f + 0.33f * float(i)), 0}),
                           {0.47f * w, 0.155f * height, random.between(0.01f, 0.05f)}, 0.012f);
        break;
      case 2: {
        const Mat3x4 box = moved(place, {rib + 0.5f * w, random.between(0.9f, 1.5f), 0});
        add_bevelled_box(soup, moved(box, {0, 0, 0.08f}), {0.25f * w, 0.3f, 0.08f}, 0.01f);
        add_bevelled_box(soup, moved(box, {0, 0, 0.165f}), {0.23f * w, 0.28f, 0.012f}, 0.006f);
        for (const float u : {-0.2f * w, 0.2f * w})
          for (const float v : {-0.25f, 0.25f})
            add_rod(soup, transform_point(box, {u, v, 0.17f}), transform_point(box, {u, v, 0.19f}), 0.012f,
                    6);
        add_rod(soup, transform_point(box, {0, 0.3f, 0.08f}), transform_point(box, {0, height - 1, 0.08f}),
                0.02f);
        break;
      }
      case 3:
        for (int i = 0; i < 4; ++i)
          add_rod(soup, transform_point(place, {rib, height * (0.3f + 0.09f * float(i)), 0.06f}),
                  transform_point(place, {bay, height * (0.3f + 0.09f * float(i)), 0.06f}), 0.03f, 10);
        break;
      default:;
    }
  }
}

void add_grating(TriangleSoup& soup, Vec3 low, Vec3 high, float pitch) {
  for (float x = low.x; x < high.x; x += pitch)
    add_block(soup, {x, low.y, low.z}, {x + 0.005f, high.y, high.z});
  for (float z = low.z; z < high.z; z += 4 * pitch)
    add_block(soup, {low.x, high.y - 0.01f, z}, {high.x, high.y, z + 0.008f});
}

}  // namespace

TrainingScene make_hall(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const bool corridor = random.chance(0.45f);
  const float half = corridor ? random.between(0.9f, 1.8f) : random.between(4, 8),
              reach = corridor ? 9.0f : 16.0f;
  const float height = corridor ? random.between(2.3f, 3.2f) : random.between(5, 8),
              bay = corridor ? random.between(0.8f, 2) : random.between(3, 5);
  add_floor(soup, 2 * reach);
  const Mat3x4 along = standing_frame({-reach, 0, 0}, 0);
  const Mat3x4 left = moved(along, {0, 0, -half}), right = standing_frame({reach, 0, half}, 3.1415927f);
  add_panel_wall(soup, left, 2 * reach, height, bay, random);
  add_panel_wall(soup, right, 2 * reach, height, bay, random);
  add_block(soup, {-reach, height, -half}, {reach, height + 0.2f, half});
  const bool trusses = random.chance(0.5f);
  const float beam = corridor ? 0.16f : 0.4f;
  for (float x = -reach; x <= reach; x += bay) {
    if (corridor || !trusses)
      add_beam(soup, standing_frame({x, height - 0.5f * beam, half}, 1.5707963f), 2 * half, beam);
    else
      add_truss(soup, {x, height - 0.9f, -half}, {x, height - 0.9f, half}, 0.8f, 0.05f, random);
    if (!corridor)
      for (const float z : {-half + 0.25f, half - 0.25f})
        add_beam(soup, rolled(standing_frame({x, 0, z}, 0), 1.5707963f), height, 0.4f);
  }
  for (int i = random.whole(1, 6); i > 0; --i)
    add_pipe_run(
        soup,
        moved(along, {0, height - beam - random.between(0.1f, 0.5f), random.between(-0.9f, 0.9f) * half}),
        2 * reach, random.log_between(0.02f, corridor ? 0.12f : 0.25f), 0.5f, random);
  if (random.chance(0.5f))
    add_duct(soup, moved(along, {0, height - beam - 0.35f, random.between(-0.7f, 0.7f) * half}), 2 * reach,
             random.between(0.15f, 0.4f), random);
  if (random.chance(0.5f))
    add_cable_tray(soup, moved(along, {0, height - beam - 0.2f, random.between(-0.8f, 0.8f) * half}),
                   2 * reach, random);
  if (corridor && random.chance(0.4f))
    add_grating(soup, {-4, 0.12f, -0.7f * half}, {4, 0.16f, 0.7f * half}, 0.035f);
  if (!corridor && random.chance(0.6f)) {  // a gallery with a railing
    const float y = random.between(2.2f, 3);
    add_block(soup, {-reach, y - 0.1f, -half}, {reach, y, -half + 1.5f});
    add_fence(soup, {-reach, y, -half + 1.45f}, {reach, y, -half + 1.45f}, 1.05f, 0.35f, 0.014f);
    for (float x = -reach; x < reach; x += bay)
      add_rod(soup, {x, 0, -half + 1.4f}, {x, y, -half + 1.4f}, 0.07f, 12);
  }
  for (int i = random.whole(3, corridor ? 8 : 30); i > 0; --i)
    add_crate_or_ball(soup, {random.between(-0.6f, 0.6f) * reach, 0, random.between(-0.85f, 0.85f) * half},
                      random.log_between(0.1f, corridor ? 0.3f : 0.8f), random);
  scene.cameras = {{-0.5f * reach, 0.6f, -0.7f * half},
                   {0.5f * reach, corridor ? 0.75f * height : 3.0f, 0.7f * half}};
  scene.subject = {{-0.6f * reach, 0, -half}, {0.6f * reach, height, half}};
  return scene;
}

}  // namespace nook::bake::nnao
