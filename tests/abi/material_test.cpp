// nook_material.h, and nook_gl_material.h as far as it needs no OpenGL: bad parameters, refused allocations,
// growing structs.
#include <nook/nook_gl_material.h>

#include <cmath>
#include <string>

#include "sdk/src/material/material_file.h"
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

constexpr nook_material_sample sample{{0.2f, 0.7f}, 0, {0, 0, 1}, {0, 0, 1}};

constexpr nook_material_pixel pixel{{0.2f, 0.7f}, {0.1f, 0}, {0, 0.1f}, {0, 0, 1}, {0, 0, 1}};

}  // namespace

TEST_CASE("materials: bad parameters and bad files") {
  Stage stage;
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  nook_material material = nullptr;
  CHECK(nook_material_load(nullptr, bytes.data(), bytes.size(), &material) == invalid);
  CHECK(nook_material_load(stage.context, nullptr, 4, &material) == invalid);
  CHECK(nook_material_load(stage.context, bytes.data(), bytes.size(), nullptr) == invalid);
  CHECK(nook_material_load(stage.context, bytes.data(), bytes.size() - 1, &material) == NOOK_ERROR_BAD_FILE);
  CHECK(last_is("nook_material_load: ", "size is wrong"));
  CHECK(nook_material_load(stage.context, stage.host.bytes.data(), stage.host.bytes.size(), &material) ==
        NOOK_ERROR_BAD_FILE);
  CHECK(last_is("nook_material_load: ", "got \"CHAR\", need \"MATL\""));
  CHECK(material == nullptr);
  REQUIRE(nook_material_load(stage.context, bytes.data(), bytes.size(), &material) == NOOK_OK);

  nook_material_value value{};
  CHECK(nook_material_evaluate(nullptr, &sample, 1, &value) == invalid);
  CHECK(nook_material_evaluate(material, nullptr, 1, &value) == invalid);
  CHECK(nook_material_evaluate(material, &sample, 1, nullptr) == invalid);
  CHECK(nook_material_evaluate(material, nullptr, 0, nullptr) == NOOK_OK);
  nook_material_sample bad[2] = {sample, sample};
  bad[1].view[1] = NAN;
  CHECK(nook_material_evaluate(material, bad, 2, &value) == invalid);
  CHECK(last_is("nook_material_evaluate: ", "sample 1"));

  CHECK(nook_material_evaluate_anisotropic(nullptr, &pixel, 1, 2, &value) == invalid);
  CHECK(nook_material_evaluate_anisotropic(material, nullptr, 1, 2, &value) == invalid);
  CHECK(nook_material_evaluate_anisotropic(material, &pixel, 1, 2, nullptr) == invalid);
  CHECK(nook_material_evaluate_anisotropic(material, nullptr, 0, 2, nullptr) == NOOK_OK);
  for (const std::uint32_t fetches : {0u, NOOK_MATERIAL_MAX_FETCHES + 1u}) {
    CHECK(nook_material_evaluate_anisotropic(material, &pixel, 1, fetches, &value) == invalid);
    CHECK(last_is("nook_material_evaluate_anisotropic: ", "need 1 to 8"));
  }
  nook_material_pixel bad_pixels[2] = {pixel, pixel};
  bad_pixels[1].dy[0] = INFINITY;
  CHECK(nook_material_evaluate_anisotropic(material, bad_pixels, 2, 2, &value) == invalid);
  CHECK(last_is("nook_material_evaluate_anisotropic: ", "pixel 1"));
  CHECK(nook_material_describe(material, nullptr) == invalid);
  check_info<nook_material_info>(
      offsetof(nook_material_info, neural_channels),
      [&](nook_material_info* info) { return nook_material_describe(material, info); });
  nook_material_destroy(&material);
  nook_material_destroy(&material);
  nook_material_destroy(nullptr);
  CHECK(nook_material_describe(material, nullptr) == invalid);
}

TEST_CASE("materials: callers of older and newer headers") {
  check_init<nook_gl_material_desc>(nook_gl_material_desc_init, sizeof(nook_gl_material_desc));
  check_init<nook_material_desc>(nook_material_desc_init, sizeof(nook_material_desc));
}

TEST_CASE("materials: modes in blocks take less memory, and other modes are refused") {
  Stage stage;
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  nook_material_desc desc;
  REQUIRE(nook_material_desc_init(&desc, sizeof desc, NOOK_VERSION) == NOOK_OK);
  const auto load = [&](nook_material* out) {
    return nook_material_load_with(stage.context, bytes.data(), bytes.size(), &desc, out);
  };
  std::uint64_t size[3];
  for (const nook_material_modes modes :
       {NOOK_MATERIAL_MODES_PLAIN, NOOK_MATERIAL_MODES_RGTC, NOOK_MATERIAL_MODES_EAC}) {
    desc.modes = modes;
    nook_material material = nullptr;
    REQUIRE(load(&material) == NOOK_OK);
    nook_material_info info{};
    info.struct_size = sizeof info;
    REQUIRE(nook_material_describe(material, &info) == NOOK_OK);
    size[modes] = info.table_bytes;
    nook_material_destroy(&material);
  }
  CHECK(size[NOOK_MATERIAL_MODES_RGTC] < size[NOOK_MATERIAL_MODES_PLAIN]);
  CHECK(size[NOOK_MATERIAL_MODES_EAC] == size[NOOK_MATERIAL_MODES_RGTC]);
  nook_material material = nullptr;
  desc.modes = 3;
  CHECK(load(&material) == invalid);
  CHECK(last_is("nook_material_load_with: ", "desc.modes"));
  desc.modes = NOOK_MATERIAL_MODES_RGTC;
  // The largest light rank of a file.
  for (const int out_of_range : {-1, 3 * 1024 + 1}) {
    desc.whole_light_modes = out_of_range;
    CHECK(load(&material) == invalid);
    CHECK(last_is("nook_material_load_with: ", "whole_light_modes"));
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
  REQUIRE(nook_material_load(stage.context, bytes.data(), bytes.size(), &material) == NOOK_OK);
  for (const float size : {0.0f, 1e-30f, 1e10f, 1e38f, -1e38f}) {
    const nook_material_sample odd{{size, -size}, size, {size, size, -size}, {size, 0, size}};
    nook_material_value value{};
    CHECK(nook_material_evaluate(material, &odd, 1, &value) == NOOK_OK);
    CHECK(std::isfinite(value.radiance[0] + value.radiance[1] + value.radiance[2] + value.occlusion));
    const nook_material_pixel odd_pixel{
        {size, -size}, {size, 0}, {-size, size}, {size, size, -size}, {size, 0, size}};
    CHECK(nook_material_evaluate_anisotropic(material, &odd_pixel, 1, 3, &value) == NOOK_OK);
    CHECK(std::isfinite(value.radiance[0] + value.radiance[1] + value.radiance[2] + value.occlusion));
  }
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
    const nook_result result = nook_material_load(context, bytes.data(), bytes.size(), &material);
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
