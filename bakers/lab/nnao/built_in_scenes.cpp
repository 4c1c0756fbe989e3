#include "bakers/lab/nnao/built_in_scenes.h"

#include <numbers>

#include "bakers/nnao/scene_families.h"

namespace nook::lab {

using namespace bake::nnao;
using namespace bake;

namespace {

constexpr float pi = 3.14159265f;

void add_picket_fence(TriangleSoup& soup, float x, float z, float length) {
  for (float along = 0; along < length; along += 0.11f) {
    const float left = x + along, right = left + 0.07f, peak = left + 0.035f;
    add_block(soup, {left, 0, z}, {right, 0.85f, z + 0.016f});
    for (const float side : {z, z + 0.016f})
      add_triangle(soup, {left, 0.85f, side}, {right, 0.85f, side}, {peak, 0.93f, side});
  }
  for (const float height : {0.2f, 0.65f})
    add_block(soup, {x, height, z - 0.03f}, {x + length, height + 0.05f, z});
}

void add_wire_mesh(TriangleSoup& soup, float x, float z, float length) {
  const float height = 1.1f;
  for (float along = -height; along < length; along += 0.09f) {
    // The positions at which the diagonal meets the left and right ends of the frame.
    const float low = along < 0 ? -along : 0, high = along + height > length ? length - along : height;
    add_rod(soup, {x + along + low, low, z}, {x + along + high, high, z}, 0.004f, 5);
    add_rod(soup, {x + along + low, height - low, z + 0.008f}, {x + along + high, height - high, z + 0.008f},
            0.004f, 5);
  }
  for (const float end : {x, x + length}) add_rod(soup, {end, 0, z}, {end, height + 0.05f, z}, 0.02f);
}

void add_bentwood_chair(TriangleSoup& soup, Vec3 foot, float turn) {
  const Mat3x4 frame = standing_frame(foot, turn);
  const auto at = [&](float x, float y, float z) { return transform_point(frame, {x, y, z}); };
  add_cylinder(soup, at(0, 0.44f, 0), at(0, 0.465f, 0), 0.21f, 0.205f, 24);
  for (int leg = 0; leg < 4; ++leg) {
    const float a = pi * (0.25f + 0.5f * float(leg)), c = std::cos(a), s = std::sin(a);
    add_cylinder(soup, at(0.25f * c, 0, 0.25f * s), at(0.17f * c, 0.44f, 0.17f * s), 0.011f, 0.016f, 10);
  }
  add_torus(soup, standing_frame(at(0, 0.22f, 0), 0), 0.205f, 0.009f, 28);
  // The back of the chair consists of two hoops.
  for (const float size : {1.0f, 0.62f}) {
    Vec3 last = at(-0.19f * size, 0.46f, -0.16f);
    for (int i = 1; i <= 12; ++i) {
      const float a = pi * float(i) / 12;
      const Vec3 next = at(-0.19f * size * std::cos(a), 0.46f + 0.46f * size * std::sqrt(std::sin(a) + 1e-6f),
                           -0.16f - 0.06f * std::sin(a));
      add_capsule(soup, last, next, 0.011f, 8);
      last = next;
    }
  }
}

// Adds a plant: blades that bend outwards, and leaves on stalks.
void add_plant(TriangleSoup& soup, Vec3 foot, bake::Random& random) {
  add_cylinder(soup, foot, foot + Vec3{0, 0.22f, 0}, 0.12f, 0.16f, 20);
  const Vec3 root = foot + Vec3{0, 0.22f, 0};
  for (int blade = 0; blade < 46; ++blade) {
    const float a = random.between(0, 2 * pi), reach = random.between(0.1f, 0.45f);
    const float rise = random.between(0.25f, 0.75f), half_width = random.between(0.005f, 0.014f);
    const Vec3 out{std::cos(a), 0, std::sin(a)}, side{-out.z, 0, out.x};
    Vec3 last = root + random.between(0, 0.1f) * out;
    for (int i = 1; i <= 6; ++i) {
      const float share = float(i) / 6, before = 1 - float(i - 1) / 6, after = 1.02f - share;
      const Vec3 next =
          root + (reach * share * share) * out + Vec3{0, rise * (share - 0.45f * share * share * share), 0};
      add_quad(soup, last - half_width * before * side, last + half_width * before * side,
               next + half_width * after * side, next - half_width * after * side);
      last = next;
    }
    if (blade % 3 != 0) continue;
    const Vec3 u = 0.05f * out + Vec3{0, random.between(-0.03f, 0.01f), 0}, v = 0.03f * side;
    add_quad(soup, last, last + u - v, last + 2.0f * u, last + u + v);
  }
}

void add_hand(TriangleSoup& soup, const Mat3x4& frame) {
  const auto at = [&](float x, float y, float z) { return transform_point(frame, {x, y, z}); };
  Mat3x4 palm = frame;
  const Vec3 centre = at(0, 0.14f, 0);
  palm.m[3] = centre.x;
  palm.m[7] = centre.y;
  palm.m[11] = centre.z;
  add_ellipsoid(soup, palm, {0.045f, 0.055f, 0.018f}, 20);
  add_capsule(soup, at(0, -0.1f, 0), at(0, 0.1f, 0), 0.028f, 16);
  constexpr float lengths[4] = {0.068f, 0.078f, 0.073f, 0.058f};
  for (int finger = 0; finger < 4; ++finger) {
    const float spread = float(finger) - 1.5f, length = lengths[finger];
    const Vec3 base = at(0.022f * spread, 0.185f, 0);
    const Vec3 middle = at(0.027f * spread, 0.185f + 0.6f * length, 0.012f);
    const Vec3 tip = at(0.03f * spread, 0.185f + 1.1f * length, 0.035f);
    add_capsule(soup, base, middle, 0.0095f, 12);
    add_capsule(soup, middle, tip, 0.0085f, 12);
  }
  add_capsule(soup, at(-0.04f, 0.12f, 0.005f), at(-0.075f, 0.165f, 0.025f), 0.011f, 12);
  add_capsule(soup, at(-0.075f, 0.165f, 0.025f), at(-0.08f, 0.2f, 0.035f), 0.0095f, 12);
}

}  // namespace

TrainingScene make_thin_scene(std::uint64_t seed) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  bake::Random random(mix_bits(~seed));
  add_floor(soup, 5);
  add_block(soup, {-5, 0, -1.6f}, {5, 3, -1.5f});
  add_picket_fence(soup, -2.3f, -1.1f, 2.0f);
  add_wire_mesh(soup, 0.1f, -1.25f, 2.0f);
  add_bentwood_chair(soup, {-0.7f, 0, -0.2f}, 0.5f);
  add_bentwood_chair(soup, {-0.1f, 0, -0.6f}, -0.7f);
  for (const float x : {0.7f, 1.5f}) add_plant(soup, {x, 0, -0.4f}, random);
  for (int hand = 0; hand < 3; ++hand) {
    Mat3x4 frame = standing_frame({-1.75f + 0.28f * float(hand), 0.1f, -0.35f}, 0.5f * float(hand) - 0.5f);
    add_hand(soup, frame);
  }
  scene.cameras = {{-2.2f, 0.35f, 0.6f}, {2.0f, 1.6f, 1.7f}};
  scene.subject = {{-1.8f, 0.1f, -1.0f}, {1.6f, 0.7f, -0.3f}};
  return scene;
}

bake::TriangleSoup mover_stage() {
  bake::TriangleSoup soup;
  bake::Random random(1);
  constexpr float wall_z = -0.8f, far = 20;
  add_quad(soup, {-far, 0, far}, {far, 0, far}, {far, 0, wall_z}, {-far, 0, wall_z});
  add_quad(soup, {-far, 0, wall_z}, {far, 0, wall_z}, {far, 3, wall_z}, {-far, 3, wall_z});
  add_block(soup, {-far, 0, wall_z}, {far, 0.1f, wall_z + 0.02f});
  add_block(soup, {-1.5f, 0, wall_z + 0.05f}, {-1.1f, 0.4f, wall_z + 0.4f});
  add_block(soup, {-1.05f, 0, wall_z + 0.1f}, {-0.8f, 0.25f, wall_z + 0.35f});
  add_table(soup, standing_frame({2.2f, 0, wall_z + 0.5f}, 0), random);
  add_chair(soup, standing_frame({0.75f, 0, wall_z + 0.3f}, 0.3f), random);
  add_rod(soup, {0.35f, 0, 0.7f}, {0.35f, 3, 0.7f}, 0.03f, 16);
  return soup;
}

std::array<MoverShot, 4> mover_shots() {
  constexpr float right = std::numbers::pi_v<float> / 2, degree = std::numbers::pi_v<float> / 180;
  return {{{"whole", {0.6f, 1.4f, 3.6f}, {0, 0.85f, 0}, 40 * degree, right},
           {"feet", {0.5f, 0.5f, 1.5f}, {0, 0.25f, 0}, 45 * degree, right},
           {"above", {-1.4f, 2.4f, 2.0f}, {0, 0.7f, 0}, 50 * degree, right},
           {"towards", {-0.5f, 1.3f, 3.0f}, {0, 0.8f, 0}, 45 * degree, 0}}};
}

}  // namespace nook::lab
