#include <algorithm>

#include "bakers/nnao/level_set.h"
#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

struct Limb {
  Vec3 from, to;
  float radius_from, radius_to;
};

// A body of limbs with rounded seams. Folds and roughness are added to its distance function.
struct Sculpture {
  std::vector<Limb> limbs;
  float seam = 0.08f;
  float rough = 0, rough_scale = 5;  // amplitude in metres; frequency per metre
  float fold = 0, fold_scale = 30;   // folds of a robe, below the height fold_below
  float fold_below = 0;
  std::uint64_t seed = 0;

  float distance(Vec3 p) const {
    float d = 1e3f;
    for (const Limb& l : limbs)
      d = round_union(d, distance_to_limb(p, l.from, l.to, l.radius_from, l.radius_to), seam);
    if (d > 0.15f) return d;
    if (rough > 0) d += rough * fractal_noise(seed, rough_scale * p, 3);
    if (fold > 0 && p.y < fold_below) {
      const float deep = std::fmin(1.0f, 3 * (fold_below - p.y));
      const float phase = fold_scale * std::atan2(p.x, p.z) / 3 + 2 * value_noise(seed + 7, 3 * p);
      d += fold * deep * (std::sin(phase) + 0.4f * std::sin(2.3f * phase + 4 * p.y));
    }
    return d;
  }
};

void add_sculpture(TriangleSoup& soup, const Mat3x4& frame, const Sculpture& sculpture, float cell) {
  Vec3 low{1e3f, 1e3f, 1e3f}, high{-1e3f, -1e3f, -1e3f};
  for (const Limb& l : sculpture.limbs)
    for (const auto& [p, r] : {std::pair{l.from, l.radius_from}, std::pair{l.to, l.radius_to}}) {
      const float out = r + 0.1f;
      low = {std::min(low.x, p.x - out), std::min(low.y, p.y - out), std::min(low.z, p.z - out)};
      high = {std::max(high.x, p.x + out), std::max(high.y, p.y + out), std::max(high.z, p.z + out)};
    }
  add_level_set(soup, frame, low, high, cell, [&](Vec3 p) { return sculpture.distance(p); });
}

// Adds the parts of a face. Their positions are relative to the middle of a skull of radius 0.1 m.
void add_head(std::vector<Limb>& limbs, Vec3 at, Random& random) {
  const auto part = [&](Vec3 from, Vec3 to, float a, float b) {
    limbs.push_back({at + from, at + to, a, b});
  };
  part({0, 0.02f, -0.01f}, {0, -0.04f, 0.03f}, 0.095f, 0.075f);
  part({0, 0.01f, 0.1f}, {0, -0.03f, 0.125f}, 0.01f, 0.017f);                 // nose
  part({-0.045f, 0.025f, 0.085f}, {0.045f, 0.025f, 0.085f}, 0.014f, 0.014f);  // brows
  part({-0.02f, -0.075f, 0.085f}, {0.02f, -0.075f, 0.085f}, 0.011f, 0.011f);
  part({0, -0.11f, 0.07f}, {0, -0.1f, 0.05f}, 0.022f, 0.03f);  // chin
  for (const float side : {-1.0f, 1.0f})
    part({side * 0.098f, 0.015f, 0}, {side * 0.1f, -0.03f, 0.005f}, 0.016f, 0.01f);
  for (int i = random.whole(0, 14); i > 0; --i) {  // curls
    Vec3 d = any_direction(random);
    d.y = std::abs(d.y);
    d.z = std::min(d.z, 0.3f);
    part(0.1f * d, 0.11f * d, 0.025f, 0.02f);
  }
}

Sculpture any_figure(Random& random) {
  Sculpture s;
  s.seam = random.between(0.03f, 0.09f);
  s.seed = random.bits();
  const float lean = random.between(-0.08f, 0.08f), waist = random.between(0.11f, 0.15f);
  const Vec3 hip{0, 0.95f, 0}, chest{lean, 1.35f, random.between(-0.04f, 0.04f)},
      head = chest + Vec3{random.between(-0.03f, 0.03f), 0.33f, 0.02f};
  s.limbs = {{hip, chest, waist + 0.03f, waist + 0.03f},
             {chest + Vec3{-0.16f, 0.08f, 0}, chest + Vec3{0.16f, 0.08f, 0}, 0.075f, 0.075f},
             {chest, head, 0.06f, 0.05f}};
  add_head(s.limbs, head, random);
  for (const float side : {-1.0f, 1.0f}) {
    const Vec3 shoulder = chest + Vec3{0.2f * side, 0.07f, 0},
               elbow = shoulder + Vec3{side * random.between(0.02f, 0.2f), random.between(-0.28f, -0.1f),
                                       random.between(-0.1f, 0.15f)},
               wrist = elbow + 0.26f * normalised(Vec3{side * random.between(-0.8f, 0.5f),
                                                       random.between(-0.8f, 0.8f), random.between(0.2f, 1)});
    s.limbs.push_back({shoulder, elbow, 0.055f, 0.043f});
    s.limbs.push_back({elbow, wrist, 0.043f, 0.03f});
    s.limbs.push_back({wrist, wrist + 0.09f * normalised(wrist - elbow), 0.032f, 0.018f});
    const Vec3 ankle{side * random.between(0.06f, 0.14f), 0.06f, random.between(-0.15f, 0.15f)},
        knee = 0.5f * (hip + ankle) + Vec3{side * 0.03f, 0, 0.05f};
    s.limbs.push_back({hip + Vec3{side * 0.08f, 0, 0}, knee, 0.09f, 0.06f});
    s.limbs.push_back({knee, ankle, 0.06f, 0.04f});
    s.limbs.push_back({ankle, ankle + Vec3{side * 0.02f, -0.02f, 0.13f}, 0.045f, 0.03f});
  }
  if (random.chance(0.5f)) {  // a robe
    s.limbs.push_back({hip + Vec3{0, 0.1f, 0}, {0, 0.1f, 0}, 0.15f, random.between(0.22f, 0.32f)});
    s.fold = random.between(0.01f, 0.03f);
    s.fold_scale = random.between(20, 60);
    s.fold_below = random.between(0.9f, 1.4f);
  }
  return s;
}

Sculpture any_bust(Random& random) {
  Sculpture s;
  s.seam = random.between(0.02f, 0.05f);
  s.seed = random.bits();
  s.limbs = {{{0, 0.1f, 0}, {0, 0.28f, 0}, 0.13f, 0.1f},
             {{-0.15f, 0.25f, 0}, {0.15f, 0.25f, 0}, 0.07f, 0.07f},
             {{0, 0.25f, 0}, {0, 0.5f, 0.02f}, 0.06f, 0.05f}};
  add_head(s.limbs, {0, 0.58f, 0.02f}, random);
  s.fold = random.chance(0.5f) ? 0.008f : 0;
  s.fold_below = 0.38f;
  return s;
}

// Returns an animal, or a shape like a root or a coral.
Sculpture any_creature(Random& random) {
  Sculpture s;
  s.seam = random.between(0.04f, 0.15f);
  s.seed = random.bits();
  Vec3 at{0, random.between(0.4f, 0.7f), -0.5f};
  for (int i = 0; i < 5; ++i) {
    const Vec3 next = at + Vec3{random.between(-0.12f, 0.12f), random.between(-0.12f, 0.15f), 0.24f};
    s.limbs.push_back({at, next, random.between(0.1f, 0.22f), random.between(0.1f, 0.22f)});
    if (i % 2 == 0)
      for (const float side : {-1.0f, 1.0f}) {
        const Vec3 knee = next + Vec3{side * random.between(0.15f, 0.3f), random.between(-0.15f, 0.15f),
                                      random.between(-0.1f, 0.1f)};
        s.limbs.push_back({next, knee, 0.08f, 0.05f});
        s.limbs.push_back({knee, {knee.x + side * 0.08f, 0.04f, knee.z + 0.05f}, 0.05f, 0.035f});
      }
    at = next;
  }
  s.limbs.push_back({at, at + Vec3{0, random.between(-0.1f, 0.2f), 0.25f}, 0.12f, 0.06f});
  for (int i = random.whole(0, 10); i > 0; --i) {
    const Limb& spine = s.limbs[random.below(4)];
    const Vec3 foot = spine.from, way = normalised(any_direction(random) + Vec3{0, 1, 0});
    s.limbs.push_back({foot, foot + random.between(0.2f, 0.4f) * way, 0.04f, 0.01f});
  }
  return s;
}

}  // namespace

TrainingScene make_statues(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 9);
  if (random.chance(0.7f)) {
    // Adds a wall with a niche.
    const float z = -1.4f;
    add_block(soup, {-4, 0, z - 0.3f}, {-0.7f, 3, z});
    add_block(soup, {0.7f, 0, z - 0.3f}, {4, 3, z});
    add_block(soup, {-0.7f, 2.4f, z - 0.3f}, {0.7f, 3, z});
    add_sheet(soup, 20, 2, [&](float u, float v) {
      return Vec3{-0.7f * std::cos(3.1415927f * u), 2.4f * v, z - 0.7f * std::sin(3.1415927f * u)};
    });
  }
  const int count = random.whole(1, 3);
  for (int i = 0; i < count; ++i) {
    const Vec3 foot{1.3f * float(i) - 0.65f * float(count - 1) + random.between(-0.2f, 0.2f), 0,
                    random.between(-1, 0.3f)};
    const int kind = random.whole(0, 2);
    Sculpture s = kind == 0 ? any_figure(random) : kind == 1 ? any_bust(random) : any_creature(random);
    s.rough = random.chance(0.5f) ? 0 : random.between(0.002f, 0.02f);
    s.rough_scale = random.between(4, 20);
    const float plinth = kind == 1 ? random.between(0.8f, 1.2f) : random.between(0.05f, 0.7f),
                half = kind == 1 ? 0.22f : 0.45f;
    add_bevelled_box(soup, standing_frame(foot + Vec3{0, 0.5f * plinth, 0}, 0), {half, 0.5f * plinth, half},
                     0.03f);
    add_bevelled_box(soup, standing_frame(foot + Vec3{0, 0.04f, 0}, 0), {half + 0.07f, 0.05f, half + 0.07f},
                     0.02f);
    add_bevelled_box(soup, standing_frame(foot + Vec3{0, plinth - 0.03f, 0}, 0),
                     {half + 0.04f, 0.03f, half + 0.04f}, 0.015f);
    add_sculpture(soup, standing_frame(foot + Vec3{0, plinth, 0}, random.between(-0.8f, 0.8f)), s,
                  kind == 1 ? 0.012f : random.between(0.018f, 0.03f));
  }
  for (int i = random.whole(0, 4); i > 0; --i) {  // smooth pebbles
    const Vec3 foot{random.between(-2, 2), 0.05f, random.between(0.2f, 1.5f)};
    add_ellipsoid(soup, standing_frame(foot, random.between(0, 6.28f)),
                  {random.between(0.1f, 0.35f), random.between(0.06f, 0.2f), random.between(0.1f, 0.3f)}, 28);
  }
  scene.cameras = {{-2.5f, 0.5f, -0.2f}, {2.5f, 2.2f, 3}};
  scene.subject = {{-1.3f, 0.2f, -1}, {1.3f, 1.8f, 0.3f}};
  return scene;
}

}  // namespace nook::bake::nnao
