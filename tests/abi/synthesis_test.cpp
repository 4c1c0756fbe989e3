// nook_synthesis.h: points of the plane, bad parameters and bad files.
#include <nook/experimental/nook_synthesis.h>

#include <limits>
#include <string>
#include <vector>

#include "sdk/src/material/material_file.h"
#include "sdk/src/synthesis/coordinates.h"
#include "tests/abi/host.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"
#include "tests/synthesis/coordinates_sample.h"

using namespace nook::test;

namespace {

constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;

bool last_has(const char* part) {
  return std::string(nook_last_message()).find(part) != std::string::npos;
}

// Coordinates for the sample material, which has 6 x 4 texels.
std::vector<std::byte> synthesis_bytes(std::uint32_t width = 6) {
  return nook::synthesis::write_coordinates(nook::synthesis::test::sample_coordinates(8, width, 4));
}
std::vector<std::byte> material_bytes() {
  return nook::material::write_material(nook::material::test::sample_material());
}

}  // namespace

TEST_CASE("any point of the plane has coordinates in the material") {
  Stage stage;
  const std::vector<std::byte> bytes = synthesis_bytes();
  nook_synthesis synthesis = nullptr;
  REQUIRE(nook_synthesis_load(stage.context, bytes.data(), bytes.size(), &synthesis) == NOOK_OK);
  nook_synthesis_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_synthesis_describe(synthesis, &info) == NOOK_OK);
  CHECK(info.side == 8);
  CHECK(info.texture_bytes == 8 * 8 * 4);
  const float plane[4] = {0.25f, 0.5f, -3.5f, 100};
  float uvs[4] = {-1, -1, -1, -1};
  REQUIRE(nook_synthesis_material_uvs(synthesis, plane, 2, uvs) == NOOK_OK);
  for (const float uv : uvs) CHECK((uv >= 0 && uv <= 1));
  nook_synthesis_destroy(&synthesis);
}

TEST_CASE("bad parameters of coordinate textures are refused") {
  Stage stage;
  const std::vector<std::byte> bytes = synthesis_bytes(5), of_material = material_bytes();
  nook_synthesis synthesis = nullptr;
  nook_material material = nullptr;
  CHECK(nook_synthesis_load(stage.context, nullptr, 8, &synthesis) == invalid);
  CHECK(nook_synthesis_load(nullptr, bytes.data(), bytes.size(), &synthesis) == invalid);
  CHECK(nook_synthesis_load(stage.context, bytes.data(), bytes.size() - 1, &synthesis) ==
        NOOK_ERROR_BAD_FILE);
  CHECK(nook_synthesis_load(stage.context, of_material.data(), of_material.size(), &synthesis) ==
        NOOK_ERROR_BAD_FILE);
  CHECK(synthesis == nullptr);
  REQUIRE(nook_synthesis_load(stage.context, bytes.data(), bytes.size(), &synthesis) == NOOK_OK);
  REQUIRE(nook_material_load(stage.context, of_material.data(), of_material.size(), nullptr, &material) ==
          NOOK_OK);
  nook_synthesis_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_synthesis_describe(synthesis, &info) == NOOK_OK);
  nook_material_info other{};
  other.struct_size = sizeof other;
  REQUIRE(nook_material_describe(material, &other) == NOOK_OK);
  // A host compares these: the coordinates are for a narrower material.
  CHECK((info.material_width == 5 && info.material_height == 4));
  CHECK((other.width == 6 && other.height == 4));
  const float bad[2] = {0, std::numeric_limits<float>::quiet_NaN()};
  float out[2];
  CHECK(nook_synthesis_material_uvs(synthesis, bad, 1, out) == invalid);
  CHECK(last_has("point 0"));
  CHECK(nook_synthesis_material_uvs(synthesis, bad, 0, nullptr) == NOOK_OK);
  CHECK(nook_synthesis_material_uvs(synthesis, nullptr, 1, out) == invalid);
  nook_material_destroy(&material);
  nook_synthesis_destroy(&synthesis);
}
