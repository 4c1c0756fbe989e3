#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

struct Flight {
  int steps;
  float rise, run, half_width;
};

// Adds a flight of stairs that goes up along z from the frame's origin. It is solid, or has open treads.
void add_flight(TriangleSoup& soup, const Mat3x4& frame, const Flight& flight, bool solid, Random& random) {
  const float nosing = random.between(0, 0.04f), tread = random.between(0.02f, 0.06f);
  for (int i = 0; i < flight.steps; ++i) {
    const float top = flight.rise * float(i + 1), bottom = solid ? 0 : top - tread;
    const float front = flight.run * float(i) - nosing, back = flight.run * float(i + 1);
    add_box(soup, frame * Mat3x4{{1, 0, 0, 0, 0, 1, 0, (top + bottom) / 2, 0, 0, 1, (front + back) / 2}},
            {flight.half_width, (top - bottom) / 2, (back - front) / 2});
  }
  const float height = random.between(0.8f, 1), thick = random.log_between(0.008f, 0.03f);
  for (const float side : {-1.0f, 1.0f}) {
    if (random.chance(0.3f)) continue;
    const float x = side * (flight.half_width - 0.05f);
    for (int i = 0; i < flight.steps; i += random.whole(1, 2)) {
      const Vec3 foot =
          transform_point(frame, {x, flight.rise * float(i + 1), flight.run * (float(i) + 0.5f)});
      add_rod(soup, foot, foot + Vec3{0, height, 0}, thick, 6);
    }
    add_rod(soup, transform_point(frame, {x, flight.rise + height, 0.5f * flight.run}),
            transform_point(frame, {x, flight.rise * float(flight.steps) + height,
                                    flight.run * (float(flight.steps) - 0.5f)}),
            2 * thick, 8);
  }
}

void add_spiral(TriangleSoup& soup, Vec3 foot, int steps, float radius, float rise) {
  add_rod(soup, foot, foot + Vec3{0, rise * float(steps + 4), 0}, 0.08f, 14);
  for (int i = 0; i < steps; ++i) {
    const float angle = 0.4f * float(i);
    Mat3x4 frame = standing_frame(foot + Vec3{0, rise * float(i + 1), 0}, angle);
    frame = frame * Mat3x4{{1, 0, 0, radius / 2, 0, 1, 0, 0, 0, 0, 1, 0}};
    add_box(soup, frame, {radius / 2, 0.025f, 0.14f});
    const Vec3 post = transform_point(frame, {radius / 2, 0, 0});
    add_rod(soup, post, post + Vec3{0, 0.9f, 0}, 0.012f, 6);
  }
}

}  // namespace

TrainingScene make_stairs(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 7);
  const Flight flight{random.whole(4, 12), random.between(0.12f, 0.22f), random.between(0.2f, 0.35f),
                      random.between(0.5f, 1.3f)};
  const float angle = random.between(-0.6f, 0.6f) + 3.14159f;
  const Mat3x4 first = standing_frame({random.between(-0.6f, 0.6f), 0, 1.5f}, angle);
  add_flight(soup, first, flight, random.chance(0.6f), random);
  const float top = flight.rise * float(flight.steps), far = flight.run * float(flight.steps);
  // Adds the landing, a wall behind it, and either a second flight that goes down or a fence.
  add_box(soup, first * Mat3x4{{1, 0, 0, 0, 0, 1, 0, top - 0.08f, 0, 0, 1, far + 0.7f}},
          {flight.half_width + 0.8f, 0.08f, 0.7f});
  if (random.chance(0.7f))
    add_box(soup, first * Mat3x4{{1, 0, 0, 0, 0, 1, 0, top, 0, 0, 1, far + 1.5f}}, {3, top + 1, 0.1f});
  if (random.chance(0.6f))
    add_box(soup, first * Mat3x4{{1, 0, 0, flight.half_width + 0.1f, 0, 1, 0, 1.2f, 0, 0, 1, far / 2}},
            {0.1f, 1.2f, far});
  if (random.chance(0.4f))
    add_spiral(soup, {random.between(1.5f, 2.5f), 0, random.between(-1.0f, 1.0f)}, random.whole(6, 14),
               random.between(0.6f, 1), 0.18f);
  if (random.chance(0.5f))
    add_flight(soup, standing_frame({-2.2f, 0, 0}, random.between(0, 6.28f)),
               {random.whole(3, 7), 0.16f, 0.28f, 0.6f}, true, random);
  for (int i = 0; i < 14; ++i)
    add_crate_or_ball(soup, {random.between(-2.5f, 2.5f), 0, random.between(0.5f, 3)},
                      random.log_between(0.05f, 0.3f), random);
  scene.cameras = {{-2.8f, 0.4f, -0.5f}, {2.8f, 2.8f, 4.5f}};
  scene.subject = {{-1.2f, 0, -1.5f}, {1.2f, 1.4f, 1.5f}};
  return scene;
}

}  // namespace nook::bake::nnao
