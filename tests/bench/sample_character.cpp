#include "tests/bench/sample_character.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

namespace nook::bench {
namespace {

constexpr std::size_t bones = 65, spheres = 130, key_points = 500, vertices = 7400, file_vertices = 8700;
constexpr std::uint32_t influences = 7;

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  std::uint32_t below(std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random_);
  }
  // Returns a place in a body of a height of 1.8 m.
  Vec3 place() { return {between(-0.4f, 0.4f), between(0, 1.8f), between(-0.2f, 0.2f)}; }
  Vec3 direction() {
    const float y = between(-1, 1), turn = between(0, 6.2831853f), r = std::sqrt(1 - y * y);
    return {r * std::cos(turn), y, r * std::sin(turn)};
  }

 private:
  std::mt19937 random_;
};

// Vertices are a 74 x 100 grid on a cylinder's surface, and key points are scattered over it. Each vertex
// uses seven of its ten nearest. As after a fit, near vertices share most of them, but no two need agree.
void add_linear_layer(CharacterModel& model, Draw& draw) {
  constexpr std::size_t columns = 74;
  std::vector<std::array<float, 2>> place(key_points);
  for (std::size_t k = 0; k < key_points; ++k) {
    place[k] = {draw.between(0, columns), draw.between(0, vertices / columns)};
    const float turn = place[k][0] * 6.2831853f / columns;
    KeyPoint& point = model.key_points[k];
    point.surface_normal = {std::cos(turn), 0, std::sin(turn)};
    point.surface_position = point.surface_normal * 0.25f + Vec3{0, 0.018f * place[k][1], 0};
  }
  std::vector<std::uint16_t> near(key_points);
  for (std::size_t v = 0; v < vertices; ++v) {
    const float x = static_cast<float>(v % columns), y = static_cast<float>(v / columns);
    const auto distance2 = [&](std::uint16_t k) {
      const float across = std::abs(place[k][0] - x), dx = std::min(across, columns - across),
                  dy = place[k][1] - y;
      return dx * dx + dy * dy;
    };
    std::iota(near.begin(), near.end(), std::uint16_t{0});
    std::partial_sort(near.begin(), near.begin() + 10, near.end(),
                      [&](std::uint16_t a, std::uint16_t b) { return distance2(a) < distance2(b); });
    for (std::uint32_t s = 0; s < influences; ++s) {
      std::swap(near[s], near[s + draw.below(10 - s)]);
      model.influence.push_back(near[s]);
      model.alpha.push_back(draw.between(0.05f, 0.2f));
      model.blend.push_back(1.0f / influences);
    }
    model.bias.push_back(draw.between(-0.05f, 0.1f));
  }
}

}  // namespace

CharacterModel sample_model() {
  Draw draw(1);
  CharacterModel model;
  model.kernel = {};  // as shipped
  for (std::size_t b = 0; b < bones; ++b) model.bone_names.push_back(String("bone_" + std::to_string(b)));
  for (std::size_t i = 0; i < spheres; ++i)
    model.spheres.push_back({draw.place(), draw.between(0.02f, 0.12f),
                             static_cast<std::uint16_t>(draw.below(bones)), draw.between(0.2f, 1)});
  for (std::size_t k = 0; k < key_points; ++k) {
    KeyPoint point{draw.place(), draw.direction(), {}, {}, {}, {0.55f, 0.25f, 0.15f, 0.05f}};
    point.surface_position = point.position;
    point.surface_normal = point.normal;
    // Four neighbours in the skeleton, as bones of one key point are.
    const std::uint32_t first = draw.below(bones - 4);
    for (std::uint32_t b = 0; b < 4; ++b) point.bone[b] = static_cast<std::uint16_t>(first + b);
    model.key_points.push_back(point);
  }
  model.influences = influences;
  add_linear_layer(model, draw);
  for (std::size_t i = 0; i < file_vertices; ++i)
    model.file_to_welded.push_back(static_cast<std::uint32_t>(i < vertices ? i : draw.below(vertices)));
  model.primitives.push_back({0, file_vertices});
  model.bounding_radius = 1.2f;
  model.bounding_centre = {0, 0.9f, 0};
  return model;
}

std::vector<Mat3x4> sample_pose(std::size_t bone_count, unsigned seed) {
  Draw draw(seed);
  std::vector<Mat3x4> pose(bone_count);
  for (Mat3x4& bone : pose) {
    const float turn = draw.between(-0.3f, 0.3f), c = std::cos(turn), s = std::sin(turn);
    bone = {{c, -s, 0, draw.between(-0.05f, 0.05f), s, c, 0, draw.between(-0.05f, 0.05f), 0, 0, 1, 0}};
  }
  return pose;
}

SampleSkin sample_skin(const CharacterModel& model) {
  Memory* memory = default_memory();
  Draw draw(2);
  const std::size_t count = model.file_to_welded.size();
  SampleSkin skin{{6 * count, memory}, {4 * count, memory}, {4 * count, memory}, {}};
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 p = draw.place(), n = draw.direction();
    const float rest[6] = {p.x, p.y, p.z, n.x, n.y, n.z};
    const float weight[4] = {0.55f, 0.25f, 0.15f, 0.05f};
    const std::size_t first = v * (model.bone_count() - 4) / count;
    for (std::size_t j = 0; j < 6; ++j) skin.rest[6 * v + j] = rest[j];
    for (std::size_t b = 0; b < 4; ++b) {
      skin.bone[4 * v + b] = static_cast<std::uint8_t>(first + b);
      skin.weight[4 * v + b] = weight[b];
    }
  }
  skin.view = {skin.rest.data(), skin.bone.data(), skin.weight.data(), static_cast<std::uint32_t>(count)};
  return skin;
}

}  // namespace nook::bench
