// Real characters, where the machine has them: counts, sizes in metres, rigid bones, plausible poses.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "bakers/import/gltf.h"
#include "bakers/import/skinned_mesh.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

std::filesystem::path characters() {
  const char* assets = std::getenv("NOOK_ASSETS");
  return std::filesystem::path(assets ? assets : NOOK_ASSETS_DIR) / "characters";
}

struct Expected {
  const char* file;
  std::size_t welded;
  std::size_t bones;
  std::size_t clips;
  float low_m, high_m;        // heights of the rest pose's lowest and highest point
  const char* standing_clip;  // feet on the ground in it; null: the model is not a human in metres
};

// Counts of vertices welded by position alone, as published with the files, except ual_mannequin: 69 of its
// 7,405 places hold vertices with different weights, which part when it moves; and the Rocketbox bodies,
// whose hair is of cards with two sides: 4,369 and 4,345 places.
const Expected expected[] = {
    {"ual_mannequin_CC0.glb", 7474, 53, 44, 0.0f, 1.83f, "Idle_Loop"},
    {"m2m_female_CC0.glb", 7224, 66, 43, 0.0f, 1.81f, "Idle_Loop"},
    {"rocketbox_Female_Adult_01_MIT.glb", 4686, 80, 44, 0.0f, 1.74f, "Idle_Loop"},
    {"rocketbox_Male_Adult_04_MIT.glb", 4611, 80, 43, 0.0f, 1.87f, "Idle_Loop"},
    {"robot_expressive_CC0.glb", 1820, 43, 14, -0.02f, 4.54f, nullptr},
    {"cesium_man_CC-BY.glb", 2338, 19, 1, 0.0f, 1.51f, "clip_0"},
    {"fox_CC-BY.glb", 290, 24, 3, -0.12f, 78.9f, nullptr},
};

struct Heights {
  float low = INFINITY, high = -INFINITY;
};
Heights heights(const std::vector<Vec3>& positions) {
  Heights out;
  for (const Vec3 p : positions) out = {std::min(out.low, p.y), std::max(out.high, p.y)};
  return out;
}

float extent(const std::vector<Vec3>& positions) {
  float most = 0;
  for (const Vec3 p : positions) most = std::max(most, length(p - positions[0]));
  return most;
}

// Returns the distance of the axes from a rotation times one scale.
float unevenness(const Mat3x4& a) {
  const Vec3 axis[3] = {{a.m[0], a.m[4], a.m[8]}, {a.m[1], a.m[5], a.m[9]}, {a.m[2], a.m[6], a.m[10]}};
  const float square = dot(axis[0], axis[0]);
  float worst = 0;
  for (int i = 0; i < 3; ++i) {
    worst = std::max(worst, std::abs(dot(axis[i], axis[i]) / square - 1));
    worst = std::max(worst, std::abs(dot(axis[i], axis[(i + 1) % 3]) / square));
  }
  return worst;
}

}  // namespace

TEST_CASE("real characters import as published and pose without exploding") {
  for (const Expected& want : expected) {
    const std::filesystem::path path = characters() / want.file;
    if (!std::filesystem::exists(path)) {
      WARN("SKIPPED: " << path << " is not there; set NOOK_ASSETS to the folder that holds characters/");
      continue;
    }
    INFO(want.file);
    const ImportedCharacter character = import_gltf(path);
    CHECK(character.mesh.vertex_count() == want.welded);
    CHECK(character.mesh.bones.size() == want.bones);
    CHECK(character.clips.size() == want.clips);
    const Heights rest = heights(character.mesh.position);
    CHECK(std::abs(rest.low - want.low_m) < 0.01f * want.high_m);  // published to the centimetre
    CHECK(std::abs(rest.high - want.high_m) < 0.01f * want.high_m);

    const float rest_extent = extent(character.mesh.position);
    std::vector<Vec3> posed;
    float worst = 0;
    for (std::size_t c = 0; c < character.clips.size(); ++c) {
      INFO(character.clips[c].name);
      for (int i = 0; i < 3; ++i) {
        const Pose pose =
            sample_clip(character, c, character.clips[c].duration_s * static_cast<float>(i) / 2);
        for (const Mat3x4& bone : pose) worst = std::max(worst, unevenness(bone));
        skin_positions(character.mesh, pose, posed);
        // A body folds up but cannot grow: arms stretched out reach about as far as the rest pose does.
        CHECK(extent(posed) < 1.5f * rest_extent);
        CHECK(extent(posed) > 0.3f * rest_extent);
      }
    }
    CHECK(worst < 1e-5f);  // floats

    if (!want.standing_clip) continue;
    skin_positions(character.mesh, sample_clip(character, find_clip(character, want.standing_clip), 0),
                   posed);
    const Heights standing = heights(posed);
    CHECK(std::abs(standing.low) < 0.03f);  // soles may sink a little into the ground
    CHECK(standing.high > 0.93f * want.high_m);
    CHECK(standing.high < 1.03f * want.high_m);
  }
}
