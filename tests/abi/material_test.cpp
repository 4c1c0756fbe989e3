// nook_material.h, and nook_gl.h as far as it needs no OpenGL: bad parameters, refused allocations,
// growing structs.
#include <nook/nook_gl.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sdk/src/material/material_file.h"
#include "sdk/src/material/reflectance.h"
#include "tests/abi/growing_struct.h"
#include "tests/abi/host.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"

using namespace nook::test;

std::vector<std::byte> nook_test_material_bytes() {
  return nook::material::write_material(nook::material::test::sample_material(2));
}

namespace {

constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;

bool last_is(const char* start, const char* part) {
  const std::string text = nook_last_message();
  return text.rfind(start, 0) == 0 && text.find(part) != std::string::npos;
}

constexpr nook_material_pixel pixel{{0.2f, 0.7f}, {0.1f, 0}, {0, 0.1f}, {0, 0, 1}, {0, 0, 1}};

}  // namespace

TEST_CASE("materials: bad parameters and bad files") {
  Stage stage;
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  nook_material material = nullptr;
  CHECK(nook_material_load(nullptr, bytes.data(), bytes.size(), nullptr, &material) == invalid);
  CHECK(nook_material_load(stage.context, nullptr, 4, nullptr, &material) == invalid);
  CHECK(nook_material_load(stage.context, bytes.data(), bytes.size(), nullptr, nullptr) == invalid);
  CHECK(nook_material_load(stage.context, bytes.data(), bytes.size() - 1, nullptr, &material) ==
        NOOK_ERROR_BAD_FILE);
  CHECK(last_is("nook_material_load: ", "size is wrong"));
  CHECK(nook_material_load(stage.context, stage.host.bytes.data(), stage.host.bytes.size(), nullptr,
                           &material) == NOOK_ERROR_BAD_FILE);
  CHECK(last_is("nook_material_load: ", "got \"CHAR\", need \"MATL\""));
  CHECK(material == nullptr);
  REQUIRE(nook_material_load(stage.context, bytes.data(), bytes.size(), nullptr, &material) == NOOK_OK);

  nook_material_value value{};
  CHECK(nook_material_evaluate(nullptr, &pixel, 1, 2, &value) == invalid);
  CHECK(nook_material_evaluate(material, nullptr, 1, 2, &value) == invalid);
  CHECK(nook_material_evaluate(material, &pixel, 1, 2, nullptr) == invalid);
  CHECK(nook_material_evaluate(material, nullptr, 0, 2, nullptr) == NOOK_OK);
  for (const std::uint32_t fetches : {0u, NOOK_MATERIAL_MAX_FETCHES + 1u}) {
    CHECK(nook_material_evaluate(material, &pixel, 1, fetches, &value) == invalid);
    CHECK(last_is("nook_material_evaluate: ", "need 1 to 8"));
  }
  nook_material_pixel bad_pixels[2] = {pixel, pixel};
  bad_pixels[1].view[1] = NAN;
  CHECK(nook_material_evaluate(material, bad_pixels, 2, 1, &value) == invalid);
  CHECK(last_is("nook_material_evaluate: ", "pixel 1"));
  bad_pixels[1].view[1] = 0;
  bad_pixels[1].dy[0] = INFINITY;
  CHECK(nook_material_evaluate(material, bad_pixels, 2, 2, &value) == invalid);
  CHECK(last_is("nook_material_evaluate: ", "pixel 1"));
  CHECK(nook_material_describe(material, nullptr) == invalid);
  check_info<nook_material_info>(
      [&](nook_material_info* info) { return nook_material_describe(material, info); });
  nook_material_destroy(&material);
  nook_material_destroy(&material);
  nook_material_destroy(nullptr);
  CHECK(nook_material_describe(material, nullptr) == invalid);
}

TEST_CASE("materials: callers of older and newer headers") {
  check_init<nook_material_desc>(nook_desc_init, NOOK_DESC_MATERIAL);
}

TEST_CASE("materials: modes in blocks take less memory, and other modes are refused") {
  Stage stage;
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  nook_material_desc desc;
  REQUIRE(nook_material_desc_init(&desc) == NOOK_OK);
  CHECK(desc.blocks == NOOK_MATERIAL_BLOCKS_NONE);
  CHECK(desc.whole_light_modes == 4);
  const auto load = [&](nook_material* out) {
    return nook_material_load(stage.context, bytes.data(), bytes.size(), &desc, out);
  };
  std::uint64_t size[3];
  for (const nook_material_blocks modes :
       {NOOK_MATERIAL_BLOCKS_NONE, NOOK_MATERIAL_BLOCKS_RGTC, NOOK_MATERIAL_BLOCKS_EAC}) {
    desc.blocks = modes;
    nook_material material = nullptr;
    REQUIRE(load(&material) == NOOK_OK);
    nook_material_info info{};
    info.struct_size = sizeof info;
    REQUIRE(nook_material_describe(material, &info) == NOOK_OK);
    size[modes] = info.table_bytes;
    nook_material_destroy(&material);
  }
  CHECK(size[NOOK_MATERIAL_BLOCKS_RGTC] < size[NOOK_MATERIAL_BLOCKS_NONE]);
  CHECK(size[NOOK_MATERIAL_BLOCKS_EAC] == size[NOOK_MATERIAL_BLOCKS_RGTC]);
  nook_material material = nullptr;
  desc.blocks = 3;
  CHECK(load(&material) == invalid);
  CHECK(last_is("nook_material_load: ", "desc.blocks"));
  desc.blocks = NOOK_MATERIAL_BLOCKS_RGTC;
  // The largest light rank of a file.
  for (const int out_of_range : {-1, 3 * 1024 + 1}) {
    desc.whole_light_modes = out_of_range;
    CHECK(load(&material) == invalid);
    CHECK(last_is("nook_material_load: ", "whole_light_modes"));
  }
  CHECK(material == nullptr);
  desc.whole_light_modes = 3 * 1024;
  CHECK(load(&material) == NOOK_OK);
  nook_material_destroy(&material);
}

TEST_CASE("materials: numbers of any size give an answer") {
  Stage stage;
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  nook_material material = nullptr;
  REQUIRE(nook_material_load(stage.context, bytes.data(), bytes.size(), nullptr, &material) == NOOK_OK);
  for (const float size : {0.0f, 1e-30f, 1e10f, 1e38f, -1e38f}) {
    const nook_material_pixel odd_pixel{
        {size, -size}, {size, 0}, {-size, size}, {size, size, -size}, {size, 0, size}};
    for (const std::uint32_t fetches : {1u, 3u}) {
      nook_material_value value{};
      CHECK(nook_material_evaluate(material, &odd_pixel, 1, fetches, &value) == NOOK_OK);
      CHECK(std::isfinite(value.radiance[0] + value.radiance[1] + value.radiance[2] + value.occlusion));
    }
  }
  nook_material_destroy(&material);
}

TEST_CASE("materials: a round pixel and one fetch read the mipmap level of the header's recipe") {
  Stage stage;
  const nook::material::Material made =
      nook::material::test::sample_material(7, {.width = 12, .height = 16, .clusters = 4, .mixture = 2});
  const std::vector<std::byte> bytes = nook::material::write_material(made);
  const nook::material::MaterialTables tables = nook::material::make_tables(
      nook::material::read_material(bytes), nook::Parallel(), nook::default_memory());
  nook_material material = nullptr;
  REQUIRE(nook_material_load(stage.context, bytes.data(), bytes.size(), nullptr, &material) == NOOK_OK);
  float lowest = 1e9f, highest = -1e9f;
  for (const float level : {0.0f, 1.0f, 2.0f, 2.25f, 3.0f, 9.0f}) {
    CAPTURE(level);
    nook_material_pixel round{{0.3f, -1.4f}, {0, 0}, {0, 0}, {0.48f, 0.6f, 0.64f}, {0, 0.6f, 0.8f}};
    round.dx[0] = std::exp2(level) / 12;
    round.dy[1] = std::exp2(level) / 16;
    nook_material_value value{};
    REQUIRE(nook_material_evaluate(material, &round, 1, 1, &value) == NOOK_OK);
    const nook::material::Sample sample{0.3f, -1.4f, level, {0.48f, 0.6f, 0.64f}, {0, 0.6f, 0.8f}};
    const nook::material::Radiance wanted = evaluate_btf(tables, sample);
    // Whole levels are exact; log2 rounds the others.
    const float rounding = level == std::floor(level) ? 0.0f : 1e-5f;
    // The call clamps what compression left below 0.
    CHECK(std::abs(value.radiance[0] - std::max(wanted.red, 0.0f)) <= rounding);
    CHECK(std::abs(value.radiance[2] - std::max(wanted.blue, 0.0f)) <= rounding);
    CHECK(std::abs(value.occlusion - evaluate_votf(tables, sample)) <= rounding);
    lowest = std::min(lowest, wanted.red);
    highest = std::max(highest, wanted.red);
  }
  CHECK(highest - lowest > 0.01f);  // the levels differ, so that a wrong level fails
  nook_material_destroy(&material);
}

TEST_CASE("materials: each allocation refused in turn leaves nothing") {
  Host host;
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  const nook_context_desc desc = host.context_desc();
  nook_context context = nullptr;
  REQUIRE(nook_context_create(&desc, &context) == NOOK_OK);
  const int held = host.blocks;
  nook_material material = nullptr;
  int refusals = 0;
  for (int n = 0; !material; ++n) {
    host.refuse_at = host.allocations + n;
    const nook_result result = nook_material_load(context, bytes.data(), bytes.size(), nullptr, &material);
    if (result == NOOK_OK) break;
    ++refusals;
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(host.blocks == held);
  }
  CHECK(refusals > 20);
  nook_context_destroy(&context);
  nook_material_destroy(&material);
  CHECK(host.blocks == 0);
}
