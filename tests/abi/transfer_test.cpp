// nook_transfer.h: every function from C, bad parameters and bad files.
#include <nook/nook_transfer.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "sdk/src/material/material_file.h"
#include "sdk/src/transfer/transfer_file.h"
#include "tests/abi/growing_struct.h"
#include "tests/abi/host.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"
#include "tests/transfer/transfer_sample.h"

using namespace nook::test;

std::vector<std::byte> nook_test_material_bytes();
extern "C" int nook_call_every_transfer_function(const void* transfer_bytes, std::size_t transfer_size,
                                                 const void* material_bytes, std::size_t material_size);

namespace {

constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;

bool last_has(const char* part) {
  return std::string(nook_last_message()).find(part) != std::string::npos;
}

std::vector<std::byte> transfer_bytes() {
  return nook::transfer::write_transfer(nook::transfer::test::sample_transfer());
}

// A loaded shape and material with their light.
struct Loaded {
  Loaded() {
    const std::vector<std::byte> bytes = transfer_bytes(), material_bytes = nook_test_material_bytes();
    REQUIRE(nook_transfer_load(stage.context, bytes.data(), bytes.size(), &transfer) == NOOK_OK);
    REQUIRE(nook_material_load(stage.context, material_bytes.data(), material_bytes.size(), &material) ==
            NOOK_OK);
    REQUIRE(nook_transfer_fit_create(stage.context, 19, &fit) == NOOK_OK);
    nook_transfer_response_desc desc;
    REQUIRE(nook_transfer_response_desc_init(&desc, sizeof desc, NOOK_VERSION) == NOOK_OK);
    desc.material = material;
    desc.lobe_count = 19;
    REQUIRE(nook_transfer_response_create(stage.context, &desc, &response) == NOOK_OK);
    amplitudes.assign(3 * 19, 0.5f);
    vectors.resize(5 * 4096);
  }
  ~Loaded() {
    nook_transfer_response_destroy(&response);
    nook_transfer_fit_destroy(&fit);
    nook_material_destroy(&material);
    nook_transfer_destroy(&transfer);
  }

  Stage stage;
  nook_transfer transfer = nullptr;
  nook_material material = nullptr;
  nook_transfer_fit fit = nullptr;
  nook_transfer_response response = nullptr;
  std::vector<float> amplitudes, vectors;
};

}  // namespace

TEST_CASE("transfer: every function, from C") {
  const std::vector<std::byte> bytes = transfer_bytes(), material = nook_test_material_bytes();
  CHECK(nook_call_every_transfer_function(bytes.data(), bytes.size(), material.data(), material.size()) == 0);
}

TEST_CASE("transfer: bad parameters and bad files") {
  Loaded l;
  const std::vector<std::byte> bytes = transfer_bytes();
  nook_transfer other = nullptr;
  CHECK(nook_transfer_load(nullptr, bytes.data(), bytes.size(), &other) == invalid);
  CHECK(nook_transfer_load(l.stage.context, nullptr, 4, &other) == invalid);
  CHECK(nook_transfer_load(l.stage.context, bytes.data(), bytes.size() - 1, &other) == NOOK_ERROR_BAD_FILE);
  CHECK(other == nullptr);
  float* const a = l.amplitudes.data();
  float* const out = l.vectors.data();
  CHECK(nook_transfer_vectors(l.transfer, l.response, a, 19, 0, 5, out, 0) == NOOK_OK);
  CHECK(nook_transfer_vectors(l.transfer, l.response, a, 18, 0, 5, out, 0) == invalid);
  CHECK(nook_transfer_vectors(l.transfer, l.response, a, 19, 3, 3, out, 0) == invalid);
  CHECK(nook_transfer_vectors(l.transfer, l.response, a, 19, 0, 5, out, 1) == invalid);
  CHECK(last_has("stride_floats"));
  l.amplitudes[7] = NAN;
  CHECK(nook_transfer_vectors(l.transfer, l.response, a, 19, 0, 5, out, 0) == invalid);
  CHECK(last_has("lobe 2"));
  l.amplitudes[7] = 0;
  const float normal[3] = {0, 0, 2}, up[3] = {0, 0, 1}, tangent[4] = {1, 0, 0, 0.5f};
  CHECK(nook_transfer_open_vectors(l.response, a, 19, normal, tangent, 1, out, 0) == invalid);
  CHECK(nook_transfer_open_vectors(l.response, a, 19, up, tangent, 1, out, 0) == invalid);
  CHECK(last_has("handedness"));
  nook_transfer_fit fit = nullptr;
  CHECK(nook_transfer_fit_create(l.stage.context, 11, &fit) == invalid);
  CHECK(nook_transfer_fit_create(l.stage.context, 2563, &fit) == invalid);
  CHECK(fit == nullptr);
  check_info<nook_transfer_info>(offsetof(nook_transfer_info, bounces), [&](nook_transfer_info* info) {
    return nook_transfer_describe(l.transfer, info);
  });
  check_info<nook_transfer_response_info>(
      offsetof(nook_transfer_response_info, reflectance),
      [&](nook_transfer_response_info* info) { return nook_transfer_response_describe(l.response, info); });
}

TEST_CASE("transfer: lights that are not valid") {
  Loaded l;
  std::vector<float> rgb(3 * 8 * 4, 1.0f);
  nook_transfer_map_desc desc;
  REQUIRE(nook_transfer_map_desc_init(&desc, sizeof desc, NOOK_VERSION) == NOOK_OK);
  desc.rgb = rgb.data();
  desc.width = 8;
  desc.height = 4;
  nook_transfer_light light = nullptr;
  rgb[10] = NAN;
  CHECK(nook_transfer_light_create_map(l.stage.context, &desc, &light) == invalid);
  CHECK(last_has("row 0, column 3"));
  rgb[10] = -1;
  CHECK(nook_transfer_light_create_map(l.stage.context, &desc, &light) == invalid);
  rgb[10] = 1;
  desc.layout = NOOK_TRANSFER_MAP_CUBE;
  CHECK(nook_transfer_light_create_map(l.stage.context, &desc, &light) == invalid);
  desc.layout = NOOK_TRANSFER_MAP_LATLONG;
  desc.width = 0;
  CHECK(nook_transfer_light_create_map(l.stage.context, &desc, &light) == invalid);
  CHECK(light == nullptr);
  desc.width = 8;
  REQUIRE(nook_transfer_light_create_map(l.stage.context, &desc, &light) == NOOK_OK);
  const float squeeze[9] = {1, 0, 0, 0, 0.5f, 0, 0, 0, 1};
  CHECK(nook_transfer_fit_light(l.fit, light, squeeze, l.amplitudes.data(), 19, nullptr) == invalid);
  CHECK(last_has("rotation"));
  const float down[3] = {0, -0.5f, 0}, one[3] = {1, 1, 1};
  CHECK(nook_transfer_fit_directional(l.fit, down, one, l.amplitudes.data(), 19) == invalid);
  nook_transfer_light_destroy(&light);
}

TEST_CASE("transfer: a neural material is refused, because its radiance is no sum of light modes") {
  Loaded loaded;
  const std::vector<std::byte> bytes =
      nook::material::write_material(nook::material::test::sample_material(1, {.channels = 4}));
  nook_material neural = nullptr;
  REQUIRE(nook_material_load(loaded.stage.context, bytes.data(), bytes.size(), &neural) == NOOK_OK);
  nook_material_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_material_describe(neural, &info) == NOOK_OK);
  CHECK(info.neural_channels == 4);
  const nook_material_tensor none{};
  CHECK(std::memcmp(&info.btf, &none, sizeof none) == 0);  // a neural material has no tensor of radiance
  CHECK(nook_transfer_check_material(loaded.transfer, neural) == invalid);
  CHECK(last_has("the material is neural"));
  nook_transfer_response_desc desc;
  REQUIRE(nook_transfer_response_desc_init(&desc, sizeof desc, NOOK_VERSION) == NOOK_OK);
  desc.material = neural;
  desc.lobe_count = 19;
  nook_transfer_response response = nullptr;
  CHECK(nook_transfer_response_create(loaded.stage.context, &desc, &response) == invalid);
  CHECK(last_has("the material is neural"));
  const nook_material_sample sample{{0, 0}, 0, {0, 0, 1}, {0, 0, 1}};
  float radiance[3];
  CHECK(nook_transfer_shade(neural, &sample, loaded.vectors.data(), 0, 1, radiance) == invalid);
  CHECK(last_has("the material is neural"));
  nook_material_destroy(&neural);
}
