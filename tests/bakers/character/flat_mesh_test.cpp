// Meshes without any volume, as cloth, flags, cards and leaves are.
#include <algorithm>
#include <cmath>

#include "bakers/character/character_bake.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/character_error.h"
#include "sdk/src/character/model_file.h"
#include "tests/bakers/character/waving_flag.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::measure;

TEST_CASE("a flag bakes and follows poses that it has not seen") {
  const FlagSides sides = GENERATE(FlagSides::front, FlagSides::both);
  const SkinnedMesh mesh = flag(sides);
  REQUIRE(mesh.vertex_count() == (sides == FlagSides::both ? 800 : 400));
  BakeSettings settings;
  settings.spheres = 32;
  settings.key_points = 100;
  settings.rays = 64;
  settings.steps = 600;
  const BakeResult baked = bake_character(mesh, flag_poses(mesh, 200, 0), settings);
  const CharacterModel shipped = read_character_model(write_character_model(baked.model));
  const CharacterEvaluation e = evaluate_character(mesh, shipped, flag_poses(mesh, 12, 0.35f), 256, 5);
  INFO("mse " << e.model.mse << " static " << e.static_bake.mse << " oracle " << e.oracle.mse << " noise "
              << e.noise_floor_mse);
  CHECK(e.static_bake.mse > 1e-3);  // the poses do occlude
  CHECK(e.model.mse < 0.25 * e.static_bake.mse);
}

TEST_CASE("the smallest meshes bake") {
  // They occlude themselves by nothing or almost nothing.
  const auto bake = [](const SkinnedMesh& mesh) {
    BakeSettings settings;
    settings.spheres = 8;
    settings.key_points = 20;
    settings.steps = 50;
    const BakeResult baked = bake_character(mesh, std::vector<Pose>(8, Pose(mesh.bones.size())), settings);
    const CharacterModel shipped = read_character_model(write_character_model(baked.model));
    for (const float ao : predict_ao(shipped, Pose(mesh.bones.size()))) CHECK(ao > 0.999f);
  };
  const auto make = [](std::vector<Vec3> position, std::vector<std::array<std::uint32_t, 3>> triangle,
                       std::vector<std::uint16_t> bone) {
    FileMesh file;
    file.bones.resize(2);
    file.bones[1].parent = 0;
    file.position = std::move(position);
    file.triangle = std::move(triangle);
    for (const std::uint16_t b : bone) {
      const std::pair<std::uint16_t, float> rigid{b, 1.0f};
      file.weights.push_back(make_weights({&rigid, 1}));
    }
    std::vector<std::string> warnings;
    return weld(std::move(file), warnings, NOOK_ERROR_INVALID_ARGUMENT);
  };
  SECTION("a triangle") {
    bake(make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {0, 0, 0}));
  }
  SECTION("a card whose bones each hold one edge") {
    bake(make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {0, 1, 1, 0}));
  }
}

TEST_CASE("each side of a card is traced with its own normal") {
  // A card of two sides 5 cm above a floor of 20 m.
  FileMesh file;
  file.bones.resize(1);
  const auto add_square = [&](float half, float y, bool up) {
    const auto first = std::uint32_t(file.position.size());
    for (const Vec3 p : {Vec3{-half, y, -half}, {-half, y, half}, {half, y, half}, {half, y, -half}})
      file.position.push_back(p);
    for (std::array<std::uint32_t, 3> t : {std::array{0u, 1u, 2u}, std::array{0u, 2u, 3u}}) {
      if (!up) std::swap(t[1], t[2]);
      file.triangle.push_back({first + t[0], first + t[1], first + t[2]});
    }
  };
  add_square(10, 0, true);
  add_square(0.5f, 0.05f, true);
  add_square(0.5f, 0.05f, false);
  const std::pair<std::uint16_t, float> rigid{std::uint16_t{0}, 1.0f};
  file.weights.assign(file.position.size(), make_weights({&rigid, 1}));
  std::vector<std::string> warnings;
  const SkinnedMesh mesh = weld(std::move(file), warnings, NOOK_ERROR_INVALID_ARGUMENT);
  const AoTargets traced = trace_character_ao(mesh, std::vector<Pose>(1, Pose(1)), 256, 1);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    // The floor ends 10 m away, 0.3 degrees below the horizon.
    CHECK(float(traced.row(0)[mesh.file_to_welded[4 + corner]]) * AoTargets::scale == 1);
    CHECK(float(traced.row(0)[mesh.file_to_welded[8 + corner]]) * AoTargets::scale < 0.01f);
  }
}

TEST_CASE("a prop that holds still takes no weights from the noise of rays") {
  // A plate on two walls, which is moved as a whole. Its shadows differ from pose to pose by rounding alone.
  FileMesh file;
  file.bones.resize(1);
  const auto add_square = [&](Vec3 middle, Vec3 u, Vec3 v) {
    const auto first = std::uint32_t(file.position.size());
    for (const Vec3 p : {middle - u - v, middle + u - v, middle + u + v, middle - u + v})
      file.position.push_back(p);
    file.triangle.push_back({first, first + 1, first + 2});
    file.triangle.push_back({first, first + 2, first + 3});
  };
  add_square({0, 0.7f, 0}, {0.8f, 0, 0}, {0, 0, 0.5f});
  add_square({-0.7f, 0.35f, 0}, {0, 0.35f, 0}, {0, 0, 0.5f});
  add_square({0.7f, 0.35f, 0}, {0, 0.35f, 0}, {0, 0, -0.5f});
  const std::pair<std::uint16_t, float> rigid{std::uint16_t{0}, 1.0f};
  file.weights.assign(file.position.size(), make_weights({&rigid, 1}));
  std::vector<std::string> warnings;
  const SkinnedMesh mesh = weld(std::move(file), warnings, NOOK_ERROR_INVALID_ARGUMENT);
  std::vector<Pose> poses;
  for (int i = 0; i < 40; ++i) {
    const float angle = 0.7f * float(i), c = std::cos(angle), s = std::sin(angle);
    poses.push_back({Mat3x4{{c, 0, s, 0.13f * float(i), 0, 1, 0, 0.01f * float(i), -s, 0, c, 0.3f}}});
  }
  BakeSettings settings;
  settings.spheres = 12;
  settings.key_points = 20;
  settings.rays = 8;
  settings.steps = 30;
  const BakeResult baked = bake_character(mesh, poses, settings);
  // Sums of the anchors' least weights are 0.06; the steps of the mini-batches add at most 5e-3 each.
  CHECK(*std::max_element(baked.model.alpha.begin(), baked.model.alpha.end()) < 1);
  const CharacterModel shipped = read_character_model(write_character_model(baked.model));
  CHECK(shipped.vertex_count() == baked.model.vertex_count());
}
