#include <algorithm>

#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

struct Coach {
  float length, width, belt, roof, clearance, wheel, nose, tail, bonnet;
};

Coach any_coach(Random& random) {
  const bool van = random.chance(0.3f);
  return {random.between(3.6f, 4.8f),
          random.between(1.6f, 1.9f),
          random.between(0.85f, 1.05f),
          van ? random.between(1.8f, 2.2f) : random.between(1.35f, 1.6f),
          random.between(0.16f, 0.28f),
          random.between(0.29f, 0.36f),
          random.between(0.55f, 0.75f),
          random.between(0.65f, 1),
          van ? 0.12f : random.between(0.22f, 0.32f)};
}

// Adds a tyre with a tread, and a rim with spokes.
void add_car_wheel(TriangleSoup& soup, const Mat3x4& frame, float radius, Random& random) {
  const float half = 0.1f;
  const Mat3x4 axle = tilted(frame, 1.5707963f);
  add_lathe(soup, axle,
            {{{0.6f * radius, half},
              {0.66f * radius, 1.1f * half},
              {0.95f * radius, half},
              {radius, 0.7f * half},
              {radius, -0.7f * half},
              {0.95f * radius, -half},
              {0.66f * radius, -1.1f * half},
              {0.6f * radius, -half},
              {0.58f * radius, -0.2f * half}}},
            30);
  add_lathe(soup, axle,
            {{{0.62f * radius, half}, {0.58f * radius, 0.5f * half}, {0.2f, 0.4f * half}, {0, 0.3f * half}}},
            24);
  const int spokes = random.whole(4, 9);
  for (int i = 0; i < spokes; ++i) {
    const float angle = 6.2831853f * float(i) / float(spokes);
    const Vec3 out{std::cos(angle), 0, std::sin(angle)};
    add_tube(soup,
             {transform_point(axle, Vec3{0, 0.75f * half, 0}),
              transform_point(axle, 0.6f * radius * out + Vec3{0, 0.9f * half, 0})},
             0.03f, 6);
  }
}

}  // namespace

void add_car(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const Coach c = any_coach(random);
  const float half = 0.5f * c.length, axle = 0.58f * half, arch = c.wheel + 0.05f;
  // Adds the body as cross-sections along z. Its sides lean inwards above the belt, and its ends are round.
  const auto deck = [&](float t) {  // the height of the belt
    const float end = std::abs(2 * t - 1);
    return (t > 0.5f ? c.nose : c.tail) + (c.belt - (t > 0.5f ? c.nose : c.tail)) * (1 - end * end * end);
  };
  const auto width = [&](float t) {
    const float end = std::abs(2 * t - 1);
    return 0.5f * c.width * (1 - 0.18f * std::pow(end, 6.0f));
  };
  const int stations = 72;
  for (const float side : {-1.0f, 1.0f})
    add_sheet(soup, stations, 6, [&](float t, float v) {
      const float z = half * (2 * t - 1);
      float low = c.clearance;
      for (const float at : {-axle, axle}) {
        const float away = z - at;
        if (std::abs(away) < arch) low = std::max(low, c.wheel + std::sqrt(arch * arch - away * away));
      }
      const float y = low + v * (deck(t) - low);
      const float belly = 0.04f * std::sin(3.1415927f * v) - 0.06f * v * v;
      return transform_point(frame, {side * (width(t) + belly), y, z});
    });
  add_sheet(soup, stations, 6, [&](float t, float v) {  // bonnet, boot and below the windows
    const float x = (2 * v - 1) * (width(t) - 0.06f);
    return transform_point(frame, {x, deck(t) + 0.03f * (1 - (2 * v - 1) * (2 * v - 1)), half * (2 * t - 1)});
  });
  for (const float end : {-1.0f, 1.0f}) {
    const float h = end > 0 ? c.nose : c.tail, w = 0.5f * c.width * 0.82f;
    add_block(soup, frame, {-w, c.clearance, end * half - 0.04f}, {w, h, end * half + 0.01f * end});
    add_bevelled_box(soup, moved(frame, {0, c.clearance + 0.15f, end * (half + 0.03f)}),
                     {w + 0.04f, 0.09f, 0.07f}, 0.03f);
    for (const float side : {-1.0f, 1.0f})  // lamps in their sockets
      add_torus(soup, tilted(moved(frame, {side * 0.75f * w, h - 0.12f, end * (half + 0.01f)}), 1.5707963f),
                0.08f, 0.02f, 16);
  }
  // Adds the grille and the number plate.
  for (int i = 0; i < 5; ++i)
    add_block(soup, frame, {-0.4f, c.nose - 0.22f + 0.035f * float(i), half},
              {0.4f, c.nose - 0.205f + 0.035f * float(i), half + 0.03f});
  // Adds the cabin: a shell that leans inwards, with pillars that stand out from the glass.
  const float front = half * (1 - 2 * c.bonnet), back = -half * 0.85f,
              roof_front = front - 0.55f * (c.roof - c.belt), roof_back = back + 0.35f * (c.roof - c.belt);
  const auto cabin = [&](float s, float v, float out) {  // s runs round, v up
    const float z = v * (s > 0 ? roof_front : roof_back) + (1 - v) * (s > 0 ? front : back);
    return Vec3{out * (0.5f * c.width - 0.08f - 0.14f * v), c.belt - 0.03f + v * (c.roof - c.belt), z};
  };
  const auto quad = [&](Vec3 a, Vec3 b, Vec3 d, Vec3 e) {
    add_quad(soup, transform_point(frame, a), transform_point(frame, b), transform_point(frame, d),
             transform_point(frame, e));
  };
  for (const float out : {-1.0f, 1.0f})
    quad(cabin(1, 0, out), cabin(-1, 0, out), cabin(-1, 1, out), cabin(1, 1, out));
  for (const float s : {-1.0f, 1.0f}) quad(cabin(s, 0, -1), cabin(s, 0, 1), cabin(s, 1, 1), cabin(s, 1, -1));
  add_bevelled_box(soup, moved(frame, {0, c.roof, 0.5f * (roof_front + roof_back)}),
                   {0.5f * c.width - 0.2f, 0.035f, 0.5f * (roof_front - roof_back) + 0.03f}, 0.03f);
  for (const float out : {-1.0f, 1.0f}) {
    for (const float s : {-1.0f, 1.0f})
      add_tube(soup, {transform_point(frame, cabin(s, 0, out)), transform_point(frame, cabin(s, 1, out))},
               0.03f, 6);
    const Vec3 middle = 0.5f * (cabin(1, 0, out) + cabin(-1, 0, out));
    add_tube(soup,
             {transform_point(frame, middle),
              transform_point(frame, 0.5f * (cabin(1, 1, out) + cabin(-1, 1, out)))},
             0.035f, 6);
    // Adds a mirror and a handle.
    add_bevelled_box(soup, moved(frame, {out * (0.5f * c.width + 0.06f), c.belt + 0.06f, front - 0.15f}),
                     {0.09f, 0.06f, 0.04f}, 0.02f);
    add_block(soup, frame, {out * (0.5f * c.width + 0.02f) - 0.015f, c.belt - 0.2f, -0.3f},
              {out * (0.5f * c.width + 0.02f) + 0.015f, c.belt - 0.17f, -0.12f});
    for (const float z : {-axle, axle})
      add_car_wheel(soup,
                    moved(frame, {out * (0.5f * c.width - 0.12f), c.wheel, z}) *
                        standing_frame({}, out > 0 ? 1.5707963f : -1.5707963f),
                    c.wheel, random);
  }
  // Adds the floor of the body, and the inner walls of the wheel arches.
  add_block(soup, frame, {-0.5f * c.width + 0.25f, c.clearance, -half + 0.1f},
            {0.5f * c.width - 0.25f, c.clearance + 0.25f, half - 0.1f});
}

namespace {

void add_bicycle(TriangleSoup& soup, const Mat3x4& frame) {
  const auto at = [&](float y, float z) { return transform_point(frame, {0, y, z}); };
  const Mat3x4 across{{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0}};
  for (const float z : {-0.5f, 0.5f}) {
    const Mat3x4 wheel = moved(frame, {0, 0.34f, z}) * across;
    add_torus(soup, wheel, 0.32f, 0.018f, 36);
    for (int i = 0; i < 14; ++i) {
      const float angle = 0.4488f * float(i);
      add_rod(soup, transform_point(wheel, {}),
              transform_point(wheel, {0.31f * std::cos(angle), 0, 0.31f * std::sin(angle)}), 0.002f, 4);
    }
  }
  for (const auto& rod : {std::array<Vec3, 2>{at(0.34f, -0.5f), at(0.85f, -0.18f)},
                          {at(0.34f, -0.5f), at(0.3f, 0)},
                          {at(0.3f, 0), at(0.95f, -0.22f)},
                          {at(0.3f, 0), at(0.8f, 0.35f)},
                          {at(0.82f, -0.17f), at(0.85f, 0.34f)},
                          {at(0.34f, 0.5f), at(1, 0.3f)}})
    add_rod(soup, rod[0], rod[1], 0.016f);
  add_rod(soup, transform_point(frame, {-0.27f, 1, 0.3f}), transform_point(frame, {0.27f, 1, 0.3f}), 0.012f);
  add_cushion(soup, moved(frame, {0, 0.97f, -0.22f}), {0.07f, 0.03f, 0.13f}, 0.7f, 14);
  add_torus(soup, moved(frame, {0.04f, 0.3f, 0}) * across, 0.09f, 0.008f, 24);
}

// Adds a trailer: a chassis, a load bed with stakes, and tracks or wheels.
void add_trailer(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const float half = random.between(1.2f, 2.5f), width = random.between(0.7f, 1.1f),
              bed = random.between(0.7f, 1);
  for (const float x : {-0.45f, 0.4f})
    add_block(soup, frame, {x, bed - 0.2f, -half}, {x + 0.07f, bed - 0.04f, half + 0.8f});
  for (float z = -half; z < half; z += 0.45f)
    add_block(soup, frame, {-width, bed - 0.08f, z}, {width, bed - 0.03f, z + 0.07f});
  for (float x = -width; x < width; x += 0.16f)
    add_block(soup, frame, {x, bed - 0.03f, -half}, {x + 0.15f, bed, half});
  for (const float side : {-1.0f, 1.0f}) {
    for (float z = -half; z < half; z += 0.6f)
      add_block(soup, moved(frame, {side * width, 0, 0}), {-0.03f, bed - 0.1f, z},
                {0.03f, bed + 0.5f, z + 0.06f});
    for (int i = 0; i < 3; ++i)
      add_block(soup, moved(frame, {side * (width - 0.04f), 0, 0}),
                {-0.012f, bed + 0.06f + 0.15f * float(i), -half},
                {0.012f, bed + 0.18f + 0.15f * float(i), half});
    for (const float z : {-0.4f, 0.4f})
      add_car_wheel(soup,
                    moved(frame, {side * (width - 0.1f), 0.36f, z}) *
                        standing_frame({}, side > 0 ? 1.5707963f : -1.5707963f),
                    0.36f, random);
  }
  const int load = random.whole(0, 12);
  for (int i = 0; i < load; ++i)
    add_crate_or_ball(soup,
                      transform_point(frame, {random.between(-0.7f, 0.7f) * width, bed,
                                              random.between(-0.8f, 0.8f) * half}),
                      random.between(0.08f, 0.25f), random);
}

}  // namespace

TrainingScene make_vehicles(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 25);
  if (random.chance(0.5f)) add_block(soup, {-9, 0, -3.6f}, {9, 3, -3.3f});
  const int cars = random.whole(1, 3);
  for (int i = 0; i < cars; ++i)
    add_car(soup,
            standing_frame({2.6f * float(i) - 2.4f, 0, random.between(-1, 0.6f)},
                           random.chance(0.7f) ? 0 : 3.1415927f),
            random);
  if (random.chance(0.5f))
    add_trailer(soup, standing_frame({2.6f * float(cars) - 2.2f, 0, 0}, random.between(-0.2f, 0.2f)), random);
  const int bicycles = random.whole(0, 4);
  for (int i = 0; i < bicycles; ++i)
    add_bicycle(soup, rolled(standing_frame({-4 + 0.45f * float(i), 0, random.between(-0.5f, 0.5f)},
                                            random.between(-0.2f, 0.2f)),
                             random.between(-0.2f, 0.2f)));
  for (int i = 0; i < 6; ++i)
    add_crate_or_ball(soup, {random.between(-4, 5), 0, random.between(2.2f, 3.5f)},
                      random.log_between(0.05f, 0.3f), random);
  scene.cameras = {{-5, 0.4f, -3}, {6, 2.2f, 5.5f}};
  scene.subject = {{-3, 0.1f, -1.8f}, {3, 1.3f, 1.8f}};
  return scene;
}

}  // namespace nook::bake::nnao
