// Instances lit by lobes: what they lose by channel, beside what they lose under constant light.
#include <algorithm>
#include <limits>

#include "bakers/character/levels.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

struct Rgb {
  float r, g, b;
};

std::vector<Rgb> directional_ao_of(const Scene& scene, nook_instance_id id) {
  const Instance& instance = instance_of(scene, id);
  std::vector<Rgb> ao(instance.model->model.file_to_welded.size(), Rgb{-1, -1, -1});
  read_directional_ao(scene, instance, &ao[0].r, sizeof(Rgb));
  return ao;
}

float largest_difference(const std::vector<Rgb>& colour, const std::vector<float>& grey) {
  float largest = colour.size() == grey.size() ? 0.0f : INFINITY;
  for (std::size_t i = 0; i < colour.size() && i < grey.size(); ++i)
    for (const float channel : {colour[i].r, colour[i].g, colour[i].b})
      largest = std::max(largest, std::abs(channel - grey[i]));
  return largest;
}

const std::vector<SphericalGaussian> constant_light = {{{0, 1, 0}, 0, {0.5f, 1, 2}}};

// Two estimates of roots in each term, as in directional_test.cpp.
constexpr float simd_tolerance = 2e-3f;

}  // namespace

TEST_CASE("under constant light every vertex keeps its AO, in either form and at every level") {
  CharacterModel data = sample_model();
  std::vector<std::vector<Mat3x4>> poses;
  for (int i = 0; i < 8; ++i) poses.push_back(stiff_pose(data, {float(i), 0, 0}, 0.7f * float(i)));
  for (CharacterLevel& level : nook::bake::make_levels(data, poses)) data.levels.push_back(std::move(level));
  const auto model = load(std::move(data));
  REQUIRE(!model->model.levels.empty());
  for (const nook_form combine : {NOOK_FORM_DEFAULT, NOOK_FORM_PAPER})
    for (const float lod_error : {0.0f, 1.0f}) {
      SceneSettings settings;
      settings.form = combine;
      settings.lod_error = lod_error;
      Scene scene = make_scene(settings);
      scene.has_camera = true;
      const nook_instance_id a = place(scene, model, {0, 1, 0}), b = place(scene, model, {0.6f, 1, 0}, 1);
      link(scene, a, b);
      const Plane ground;
      set_ground(scene, a, &ground);
      add_occluder(scene, {{0.2f, 1.3f, 0.4f}, 0.2f});
      set_light(scene, a, constant_light);
      update(scene);
      CHECK((instance_of(scene, a).plan.level > 0) == (lod_error > 0));
      CHECK(largest_difference(directional_ao_of(scene, a), ao_of(scene, a)) < simd_tolerance);
      // No light, and a light that no update has seen yet: AO itself.
      CHECK(largest_difference(directional_ao_of(scene, b), ao_of(scene, b)) == 0);
      set_light(scene, b, constant_light);
      CHECK(largest_difference(directional_ao_of(scene, b), ao_of(scene, b)) == 0);
    }
}

TEST_CASE("a caster on the bright side darkens more than one on the dark side") {
  const auto model = load(single_model({0, 100, 0}, 0.001f));
  const std::vector<SphericalGaussian> east = {{{1, 0, 0}, 6, {1, 0, 0}}, {{-1, 0, 0}, 6, {0, 1, 0}}};
  const auto lit_behind = [&](Vec3 place_of_caster) {
    Scene scene = make_scene();
    const nook_instance_id id = place(scene, model, {0, 0, 0});
    add_occluder(scene, {place_of_caster, 0.5f});
    set_light(scene, id, east);
    update(scene);
    return directional_ao_of(scene, id)[0];
  };
  const KeyPoint& point = model->model.key_points[0];
  const Vec3 up = point.surface_normal, at = point.surface_position;
  const Vec3 east_up = normalised(Vec3{1, 0, 0} + up), west_up = normalised(Vec3{-1, 0, 0} + up);
  const Rgb east_caster = lit_behind(at + east_up * 1.2f), west_caster = lit_behind(at + west_up * 1.2f);
  INFO("red " << east_caster.r << " " << west_caster.r << " green " << east_caster.g << " " << west_caster.g);
  CHECK(east_caster.r < west_caster.r - 0.05f);
  CHECK(west_caster.g < east_caster.g - 0.05f);
}

// Key points in a crease that darken a vertex beside it: their shadows are large, and the bias takes most of
// them away again.
TEST_CASE("a bias takes the same light as the key points from which it takes away") {
  CharacterModel data = sample_model();
  for (float& alpha : data.alpha) alpha *= 3;
  for (float& bias : data.bias) bias -= 0.4f;
  const auto model = load(std::move(data));
  Scene scene = make_scene();
  const nook_instance_id id = place(scene, model, {0, 1, 0});
  set_light(scene, id, std::vector<SphericalGaussian>{{{1, 0, 0}, 4, {1, 1, 1}}, {{0, -1, 0}, 4, {1, 1, 1}}});
  update(scene);
  const std::vector<Rgb> lit = directional_ao_of(scene, id);
  const std::vector<float> ao = ao_of(scene, id);
  // A vertex takes no larger part of its shadow's light than the key point that takes the largest.
  const Instance& instance = instance_of(scene, id);
  float largest = 0;
  for (std::uint32_t k = 0; k < model->model.key_points.size(); ++k)
    if (const float shadow = instance.arrays().points.shadow[k]; shadow > 0)
      largest = std::max(largest, instance.light().shadow[0][k] / shadow);
  std::size_t cancelled = 0;
  for (std::size_t i = 0; i < ao.size(); ++i) {
    cancelled += ao[i] > 0.5f && ao[i] < 1;
    CHECK(1 - lit[i].r <= largest * (1 - ao[i]) + simd_tolerance);
  }
  CHECK(cancelled > 3);
}

TEST_CASE("a light taken away leaves AO") {
  const auto model = load(sample_model());
  Scene scene = make_scene();
  const nook_instance_id id = place(scene, model, {0, 0, 0});
  set_light(scene, id, std::vector<SphericalGaussian>{{{1, 0, 0}, 10, {1, 1, 1}}});
  update(scene);
  CHECK(largest_difference(directional_ao_of(scene, id), ao_of(scene, id)) > 0.01f);
  set_light(scene, id, {});
  update(scene);
  CHECK(largest_difference(directional_ao_of(scene, id), ao_of(scene, id)) == 0);
}

TEST_CASE("no light makes anything but numbers between 0 and 1") {
  const auto model = load(sample_model());
  Scene scene = make_scene();
  const nook_instance_id id = place(scene, model, {0, 1, 0});
  const Plane ground;
  set_ground(scene, id, &ground);
  for (const float sharpness : {0.0f, 1e-6f, 1.0f, 1e4f})
    for (const float amplitude : {-1e18f, -1.0f, 0.0f, 1e-30f, 1.0f, 1e18f}) {
      set_light(scene, id,
                std::vector<SphericalGaussian>{{{0, 0, 1}, sharpness, {amplitude, 1, -amplitude}},
                                               {{0, 1, 0}, 1e4f, {1, amplitude, 0}}});
      update(scene);
      for (const Rgb& c : directional_ao_of(scene, id))
        for (const float channel : {c.r, c.g, c.b}) CHECK((channel >= 0 && channel <= 1));
    }
}

TEST_CASE("bad lobes are refused and change nothing") {
  const auto model = load(sample_model());
  Scene scene = make_scene();
  const nook_instance_id id = place(scene, model, {0, 0, 0});
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const SphericalGaussian& bad :
       {SphericalGaussian{{0, 0, 0}, 1, {1, 1, 1}}, SphericalGaussian{{nan, 0, 0}, 1, {1, 1, 1}},
        SphericalGaussian{{0, 0, 1}, -1, {1, 1, 1}}, SphericalGaussian{{0, 0, 1}, nan, {1, 1, 1}},
        SphericalGaussian{{0, 0, 1}, 1e5f, {1, 1, 1}}, SphericalGaussian{{0, 0, 1}, 1, {1, nan, 1}},
        SphericalGaussian{{0, 0, 1}, 1, {1, 1, INFINITY}}}) {
    CHECK_THROWS_AS(set_light(scene, id, std::vector<SphericalGaussian>{bad}), Failure);
    CHECK(instance_of(scene, id).light().count == 0);
  }
  CHECK_THROWS_AS(set_light(scene, id, std::vector<SphericalGaussian>(max_light_lobes + 1)), Failure);
  CHECK_THROWS_AS(set_light(scene, id + 7, constant_light), Failure);
}
