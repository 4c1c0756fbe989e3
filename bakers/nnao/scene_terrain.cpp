#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// Value noise with a smooth fade, in [-1, 1].
float lattice(std::uint64_t seed, int x, int z) {
  return 2 * unit_float(mix_bits(seed ^ mix_bits(std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(z)))) -
         1;
}
float value_noise(std::uint64_t seed, float x, float z) {
  const float fx = std::floor(x), fz = std::floor(z);
  const auto fade = [](float t) { return t * t * (3 - 2 * t); };
  const float u = fade(x - fx), v = fade(z - fz);
  const int ix = int(fx), iz = int(fz);
  const float low = lattice(seed, ix, iz) * (1 - u) + lattice(seed, ix + 1, iz) * u;
  const float high = lattice(seed, ix, iz + 1) * (1 - u) + lattice(seed, ix + 1, iz + 1) * u;
  return low * (1 - v) + high * v;
}
float hills(std::uint64_t seed, float x, float z, float roughness) {
  float sum = 0, weight = 1;
  for (int octave = 0; octave < 5; ++octave) {
    sum += weight * value_noise(seed + std::uint64_t(octave), x, z);
    weight *= roughness;
    x *= 2.03f;
    z *= 2.03f;
  }
  return sum;
}

// Adds a square of ground, or the roof of a cave, depending on `height`.
template <class Height>
void add_ground(TriangleSoup& soup, float half, int cells, const Height& height) {
  const auto first = std::uint32_t(soup.position.size());
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const float x = half * (2 * float(i) / float(cells) - 1), z = half * (2 * float(j) / float(cells) - 1);
      soup.position.push_back({x, height(x, z), z});
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const auto a = first + std::uint32_t(j * (cells + 1) + i), b = a + std::uint32_t(cells + 1);
      soup.triangle.push_back({a, a + 1, b + 1});
      soup.triangle.push_back({a, b + 1, b});
    }
}

// Adds a ball with dents.
void add_rock(TriangleSoup& soup, Vec3 middle, float size, std::uint64_t seed, Random& random) {
  TriangleSoup ball;
  add_ellipsoid(ball, {}, {1, 1, 1}, 40);
  const Mat3x4 frame = tumbled_frame(middle, random);
  const float rough = random.between(0.1f, 0.35f), squash = random.between(0.5f, 1);
  const auto first = std::uint32_t(soup.position.size());
  for (const Vec3 p : ball.position) {
    const float dent = hills(seed, 2 * p.x + 7 * p.y, 2 * p.z - 3 * p.y, 0.5f);
    const Vec3 q = size * (1 + rough * dent) * p;
    soup.position.push_back(transform_point(frame, {q.x, squash * q.y, q.z}));
  }
  for (const auto& t : ball.triangle) soup.triangle.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

TrainingScene make_terrain(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const std::uint64_t seed = random.bits();
  const float tall = random.between(0.1f, 0.6f), scale = random.between(0.4f, 1.2f),
              rough = random.between(0.35f, 0.55f);
  const auto ground = [&](float x, float z) { return tall * hills(seed, scale * x, scale * z, rough); };
  add_ground(soup, 5, 200, ground);
  if (random.chance(0.4f))
    add_ground(soup, 5, 120,
               [&](float x, float z) { return 2.4f + 0.8f * hills(seed + 99, 0.8f * x, 0.8f * z, rough); });
  const int rocks = random.whole(5, 40);
  for (int i = 0; i < rocks; ++i) {
    const float x = random.between(-2.5f, 2.5f), z = random.between(-2.5f, 2.5f),
                size = random.log_between(0.06f, 0.7f);
    add_rock(soup, {x, ground(x, z) + 0.4f * size, z}, size, seed + std::uint64_t(i), random);
  }
  const int posts = random.whole(0, 12);
  for (int i = 0; i < posts; ++i) {
    const float x = random.between(-2.5f, 2.5f), z = random.between(-2.5f, 2.5f);
    const Vec3 foot{x, ground(x, z) - 0.1f, z};
    add_rod(soup, foot,
            foot + Vec3{random.between(-0.3f, 0.3f), random.between(0.4f, 1.5f), random.between(-0.3f, 0.3f)},
            random.log_between(0.01f, 0.08f), 10);
  }
  scene.cameras = {{-3, 0.6f, -3}, {3, 2, 3}};
  scene.subject = {{-2, -0.2f, -2}, {2, 0.6f, 2}};
  return scene;
}

}  // namespace nook::bake::nnao
