// Rest space to world on every instruction set, against the matrices applied in double precision.
#include <cmath>

#include "sdk/src/character/shadow_kernels_rest.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/kernel_reference.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int bones = 9;

Mat3x4 random_bone(std::mt19937& random, float scale) {
  const Vec3 a = random_direction(random);
  const Vec3 b = normalised(cross(a, random_direction(random)));
  const Vec3 c = cross(a, b);
  const Vec3 t = random_vector(random, 3);
  return {{a.x * scale, a.y * scale, a.z * scale, t.x, b.x * scale, b.y * scale, b.z * scale, t.y,
           c.x * scale, c.y * scale, c.z * scale, t.z}};
}

CharacterModel random_model(std::mt19937& random, std::size_t spheres, std::size_t points) {
  std::uniform_int_distribution<int> bone(0, bones - 1);
  std::uniform_real_distribution<float> unit(0.1f, 1);
  CharacterModel model;
  model.bone_names.resize(bones);
  for (std::size_t i = 0; i < spheres; ++i) {
    const Vec3 centre = random_vector(random, 1);
    model.spheres.push_back({centre, unit(random), static_cast<std::uint16_t>(bone(random)), unit(random)});
  }
  for (std::size_t k = 0; k < points; ++k) {
    KeyPoint point{random_vector(random, 1),
                   random_direction(random),
                   random_vector(random, 1),
                   random_direction(random),
                   {},
                   {}};
    float sum = 0;
    for (int b = 0; b < 4; ++b) {
      point.bone[b] = static_cast<std::uint16_t>(bone(random));
      sum += point.weight[b] = unit(random);
    }
    for (float& w : point.weight) w /= sum;
    model.key_points.push_back(point);
  }
  return model;
}

struct Posed {
  double position[3], normal[3];
};
Posed posed(const KeyPoint& point, const std::vector<Mat3x4>& pose, Vec3 p, Vec3 n, Vec3 offset) {
  double m[12] = {};
  for (int b = 0; b < 4; ++b)
    for (int j = 0; j < 12; ++j) m[j] += double(point.weight[b]) * pose[point.bone[b]].m[j];
  Posed out{};
  const double away[3] = {offset.x, offset.y, offset.z};
  double length2 = 0;
  for (int r = 0; r < 3; ++r) {
    out.position[r] = m[4 * r] * p.x + m[4 * r + 1] * p.y + m[4 * r + 2] * p.z + m[4 * r + 3] - away[r];
    out.normal[r] = m[4 * r] * n.x + m[4 * r + 1] * n.y + m[4 * r + 2] * n.z;
    length2 += out.normal[r] * out.normal[r];
  }
  for (double& c : out.normal) c /= std::sqrt(length2);
  return out;
}

struct TargetArrays {
  std::vector<float> number[6];
  explicit TargetArrays(std::uint32_t count) {
    for (auto& n : number) n.resize(count, -77.0f);
  }
  KeyPointTarget target() {
    return {number[0].data(), number[1].data(), number[2].data(),
            number[3].data(), number[4].data(), number[5].data()};
  }
  // Largest difference of key point k from the truth.
  double error(std::uint32_t k, const Posed& truth) const {
    double worst = 0;
    for (int a = 0; a < 3; ++a) {
      worst = std::max(worst, std::abs(number[a][k] - truth.position[a]));
      worst = std::max(worst, std::abs(number[3 + a][k] - truth.normal[a]));
    }
    return worst;
  }
};

}  // namespace

TEST_CASE("key points follow their blended bones") {
  std::mt19937 random(21);
  const CharacterModel model = random_model(random, 0, 37);
  std::vector<Mat3x4> pose;
  for (int b = 0; b < bones; ++b) pose.push_back(random_bone(random, 1.7f));
  const Vec3 offset{1, -2, 0.5f};
  const RestKeyPoints rest(model);
  REQUIRE(rest.padded_count() == 48);
  for (const ShadowKernels* kernels : available_kernels()) {
    TargetArrays fitted(48), surface(48), alone(48);
    const KeyPointTarget surface_target = surface.target();
    kernels->pose_key_points(rest.view(), pose.data(), offset, fitted.target(), &surface_target);
    kernels->pose_key_points(rest.view(), pose.data(), offset, alone.target(), nullptr);
    INFO(kernels->name);
    for (std::uint32_t k = 0; k < 48; ++k) {
      const KeyPoint& point = model.key_points[std::min(k, 36u)];  // padding repeats the last one
      // A handful of roundings of coordinates below 10 m; a normal that almost blends away magnifies them.
      CHECK(fitted.error(k, posed(point, pose, point.position, point.normal, offset)) < 2e-5);
      CHECK(surface.error(k, posed(point, pose, point.surface_position, point.surface_normal, offset)) <
            2e-5);
    }
    for (int a = 0; a < 6; ++a) CHECK(alone.number[a] == fitted.number[a]);
  }
}

TEST_CASE("spheres ride on their bone and grow with its scale") {
  std::mt19937 random(22);
  for (const std::size_t count : {1u, 4u, 7u, 130u}) {
    const CharacterModel model = random_model(random, count, 1);
    std::vector<Mat3x4> pose;
    for (int b = 0; b < bones; ++b) pose.push_back(random_bone(random, 0.5f + 0.2f * float(b)));
    const Vec3 offset{0.5f, 0, -1};
    const RestSpheres rest(model);
    for (const ShadowKernels* kernels : available_kernels()) {
      std::vector<float> x(count + 1, -77.0f), y = x, z = x, inverse = x;
      kernels->pose_spheres(rest.view(), pose.data(), offset, {x.data(), y.data(), z.data(), inverse.data()});
      INFO(kernels->name << " spheres " << count);
      for (std::size_t i = 0; i < count; ++i) {
        const ProxySphere& sphere = model.spheres[i];
        const Vec3 centre = transform_point(pose[sphere.bone], sphere.centre) - offset;
        CHECK(length(Vec3{x[i], y[i], z[i]} - centre) < 2e-6);
        CHECK(std::abs(1 / inverse[i] - sphere.radius * (0.5f + 0.2f * float(sphere.bone))) < 2e-6);
        CHECK(rest.caster_weight()[i] == sphere.caster_weight);
      }
      CHECK((x[count] == -77 && y[count] == -77 && z[count] == -77 && inverse[count] == -77));
    }
  }
}

TEST_CASE("a sphere without size and a normal that blends away stay finite") {
  CharacterModel model;
  model.bone_names.resize(2);
  model.spheres.push_back({{}, 0, 0, 1});
  model.key_points.push_back({{}, {0, 1, 0}, {}, {0, 1, 0}, {0, 1}, {0.5f, 0.5f}});
  const std::vector<Mat3x4> pose{{}, {{-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0}}};
  const RestSpheres spheres(model);
  const RestKeyPoints points(model);
  for (const ShadowKernels* kernels : available_kernels()) {
    float x, y, z, inverse;
    kernels->pose_spheres(spheres.view(), pose.data(), {}, {&x, &y, &z, &inverse});
    CHECK(std::abs(inverse * min_sphere_radius - 1) < 1e-6);
    TargetArrays out(16);
    kernels->pose_key_points(points.view(), pose.data(), {}, out.target(), nullptr);
    for (int a = 3; a < 6; ++a) CHECK(out.number[a][0] == 0);
  }
}

TEST_CASE("bones that are not the model's are refused") {
  std::mt19937 random(23);
  CharacterModel model = random_model(random, 3, 3);
  model.spheres[2].bone = bones;
  model.key_points[1].bone[3] = bones;
  CHECK_THROWS_AS(RestSpheres(model), Failure);
  CHECK_THROWS_AS(RestKeyPoints(model), Failure);
}
