// nook_transfer.h: the vectors of a light, bad parameters and bad files.
#include <nook/experimental/nook_transfer.h>

#include <algorithm>
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
    REQUIRE(nook_material_load(stage.context, material_bytes.data(), material_bytes.size(), nullptr,
                               &material) == NOOK_OK);
    nook_transfer_response_desc desc;
    REQUIRE(nook_transfer_response_desc_init(&desc) == NOOK_OK);
    desc.material = material;
    desc.lobe_count = 19;
    REQUIRE(nook_transfer_response_create(stage.context, &desc, &response) == NOOK_OK);
    amplitudes.assign(3 * 19, 0.5f);
    vectors.resize(5 * 4096);
  }
  // Of amplitudes, for 19 lobes.
  nook_transfer_vectors_desc vectors_desc(nook_transfer of) const {
    nook_transfer_vectors_desc desc;
    REQUIRE(nook_transfer_vectors_desc_init(&desc) == NOOK_OK);
    desc.transfer = of;
    desc.amplitudes = amplitudes.data();
    desc.lobe_count = 19;
    return desc;
  }
  ~Loaded() {
    nook_transfer_response_destroy(&response);
    nook_material_destroy(&material);
    nook_transfer_destroy(&transfer);
  }

  Stage stage;
  nook_transfer transfer = nullptr;
  nook_material material = nullptr;
  nook_transfer_response response = nullptr;
  std::vector<float> amplitudes, vectors;
};

}  // namespace

TEST_CASE("transfer: a light of a map or of a probe becomes vectors, and they shade") {
  Loaded l;
  nook_probe_fit_desc fit_desc;
  REQUIRE(nook_probe_fit_desc_init(&fit_desc) == NOOK_OK);
  nook_probe_fit fit = nullptr;
  REQUIRE(nook_probe_fit_create(l.stage.context, &fit_desc, &fit) == NOOK_OK);
  nook_probe_desc probe_desc;
  REQUIRE(nook_probe_desc_init(&probe_desc) == NOOK_OK);
  const std::vector<float> coefficients(36, 0.3f);
  probe_desc.functions = fit;
  probe_desc.coefficients = coefficients.data();
  nook_probe probe = nullptr;
  REQUIRE(nook_probe_create(l.stage.context, &probe_desc, &probe) == NOOK_OK);
  std::vector<float> rgb(3 * 16 * 8, 0.2f);
  std::fill_n(rgb.begin(), rgb.size() / 2, 1.0f);
  nook_transfer_light_desc desc;
  REQUIRE(nook_transfer_light_desc_init(&desc) == NOOK_OK);
  SECTION("a map") {
    desc.rgb = rgb.data();
    desc.width = 16;
    desc.height = 8;
  }
  SECTION("a probe") {
    desc.probe = probe;
  }
  nook_transfer_light light = nullptr;
  REQUIRE(nook_transfer_light_create(l.stage.context, &desc, &light) == NOOK_OK);
  const float quarter_turn[9] = {0, 0, 1, 0, 1, 0, -1, 0, 0};
  nook_transfer_projection_info quality{};
  quality.struct_size = sizeof quality;
  REQUIRE(nook_transfer_light_project(light, 19, quarter_turn, l.amplitudes.data(), &quality) == NOOK_OK);
  // 19 lobes are blurred.
  CHECK((quality.relative_error > 0 && quality.relative_error < 1));
  CHECK(quality.negative_share < 0.5f);
  nook_transfer_response_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_transfer_response_describe(l.response, &info) == NOOK_OK);
  CHECK(info.vector_floats == 3 * info.light_modes);
  const nook_transfer_vectors_desc vectors_desc = l.vectors_desc(l.transfer);
  REQUIRE(nook_transfer_read_vectors(l.response, &vectors_desc, l.vectors.data(), 5, 0) == NOOK_OK);
  const nook_material_pixel pixel{{0.2f, 0.7f}, {0, 0}, {0, 0}, {0, 0, 1}, {0, 0, 1}};
  float radiance[3] = {NAN, NAN, NAN};
  REQUIRE(nook_transfer_shade(l.material, &pixel, l.vectors.data(), info.vector_floats, 1, radiance) ==
          NOOK_OK);
  CHECK(std::isfinite(radiance[0] + radiance[1] + radiance[2]));
  nook_transfer_light_destroy(&light);
  nook_probe_destroy(&probe);
  nook_probe_fit_destroy(&fit);
}

TEST_CASE("transfer: a mesh is checked by its vertices, and a material by its modes") {
  const Loaded l;
  nook_transfer_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_transfer_describe(l.transfer, &info) == NOOK_OK);
  CHECK(info.share_bytes == std::uint64_t(info.lobe_count) * info.vertex_count);
  nook_transfer_mesh_desc mesh;
  REQUIRE(nook_transfer_mesh_desc_init(&mesh) == NOOK_OK);
  mesh.vertex_count = info.vertex_count;
  CHECK(nook_transfer_check(l.transfer, &mesh, nullptr) == NOOK_OK);
  CHECK(nook_transfer_check(l.transfer, nullptr, l.material) == NOOK_OK);
  const std::vector<float> other(3 * info.vertex_count, 7.0f);
  mesh.positions = other.data();
  CHECK(nook_transfer_check(l.transfer, &mesh, nullptr) == invalid);
  CHECK(last_has("positions"));
}

TEST_CASE("transfer: bad parameters and bad files") {
  Loaded l;
  const std::vector<std::byte> bytes = transfer_bytes();
  nook_transfer other = nullptr;
  CHECK(nook_transfer_load(nullptr, bytes.data(), bytes.size(), &other) == invalid);
  CHECK(nook_transfer_load(l.stage.context, nullptr, 4, &other) == invalid);
  CHECK(nook_transfer_load(l.stage.context, bytes.data(), bytes.size() - 1, &other) == NOOK_ERROR_BAD_FILE);
  CHECK(other == nullptr);
  float* const out = l.vectors.data();
  nook_transfer_vectors_desc desc = l.vectors_desc(l.transfer);
  const auto read = [&](std::uint32_t vertices, std::uint32_t stride) {
    return nook_transfer_read_vectors(l.response, &desc, out, vertices, stride);
  };
  CHECK(read(5, 0) == NOOK_OK);
  CHECK(nook_transfer_read_vectors(nullptr, &desc, out, 5, 0) == invalid);
  CHECK(nook_transfer_read_vectors(l.response, nullptr, out, 5, 0) == invalid);
  CHECK(nook_transfer_read_vectors(l.response, &desc, nullptr, 5, 0) == invalid);
  desc.lobe_count = 18;
  CHECK(read(5, 0) == invalid);
  desc.lobe_count = 19;
  desc.first_vertex = 3;
  CHECK(read(3, 0) == invalid);
  CHECK(last_has("the transfer has only 5"));
  desc.first_vertex = 0;
  CHECK(read(5, 1) == invalid);
  CHECK(last_has("stride_floats"));
  l.amplitudes[7] = NAN;
  CHECK(read(5, 0) == invalid);
  CHECK(last_has("lobe 2"));
  l.amplitudes[7] = 0;
  const float normal[3] = {0, 0, 2}, up[3] = {0, 0, 1}, tangent[4] = {1, 0, 0, 0.5f}, right[4] = {1, 0, 0, 1};
  desc.normals = up;
  CHECK(read(5, 0) == invalid);
  CHECK(last_has("set desc.normals and desc.tangents to NULL"));
  desc = l.vectors_desc(nullptr);
  CHECK(read(1, 0) == invalid);
  CHECK(last_has("desc.normals"));
  desc.normals = normal;
  CHECK(read(1, 0) == invalid);
  CHECK(last_has("desc.tangents"));
  desc.tangents = right;
  CHECK(read(1, 0) == invalid);
  CHECK(last_has("unit length"));
  desc.normals = up;
  desc.tangents = tangent;
  CHECK(read(1, 0) == invalid);
  CHECK(last_has("handedness"));
  desc.tangents = right;
  desc.first_vertex = 1;
  CHECK(read(1, 0) == invalid);
  CHECK(last_has("first_vertex"));
  desc.first_vertex = 0;
  CHECK(read(1, 0) == NOOK_OK);
  check_info<nook_transfer_info>(
      [&](nook_transfer_info* info) { return nook_transfer_describe(l.transfer, info); });
  check_info<nook_transfer_response_info>(
      [&](nook_transfer_response_info* info) { return nook_transfer_response_describe(l.response, info); });
}

TEST_CASE("transfer: lights that are not valid") {
  Loaded l;
  std::vector<float> rgb(3 * 8 * 4, 1.0f);
  nook_transfer_light_desc desc;
  REQUIRE(nook_transfer_light_desc_init(&desc) == NOOK_OK);
  nook_transfer_light light = nullptr;
  const auto create = [&] { return nook_transfer_light_create(l.stage.context, &desc, &light); };
  CHECK(create() == invalid);
  CHECK(last_has("desc has 0 sources"));
  desc.rgb = rgb.data();
  desc.width = 8;
  desc.height = 4;
  const float down[3] = {0, -0.5f, 0}, up[3] = {0, 1, 0};
  desc.direction = up;
  CHECK(create() == invalid);
  CHECK(last_has("desc has 2 sources"));
  desc.direction = nullptr;
  rgb[10] = NAN;
  CHECK(create() == invalid);
  CHECK(last_has("row 0, column 3"));
  rgb[10] = -1;
  CHECK(create() == invalid);
  rgb[10] = 1;
  desc.layout = NOOK_TRANSFER_MAP_CUBE;
  CHECK(create() == invalid);
  desc.layout = NOOK_TRANSFER_MAP_LATLONG;
  desc.width = 0;
  CHECK(create() == invalid);
  CHECK(light == nullptr);
  desc.width = 8;
  REQUIRE(create() == NOOK_OK);
  const auto project = [&](std::uint32_t lobes, const float* rotation) {
    return nook_transfer_light_project(light, lobes, rotation, l.amplitudes.data(), nullptr);
  };
  CHECK(project(11, nullptr) == invalid);
  CHECK(project(2563, nullptr) == invalid);
  const float squeeze[9] = {1, 0, 0, 0, 0.5f, 0, 0, 0, 1};
  CHECK(project(19, squeeze) == invalid);
  CHECK(last_has("rotation"));
  CHECK(nook_transfer_light_project(light, 19, nullptr, nullptr, nullptr) == invalid);
  nook_transfer_projection_info small{};
  small.struct_size = sizeof small - 1;
  l.amplitudes.assign(3 * 19, 7.0f);
  CHECK(nook_transfer_light_project(light, 19, nullptr, l.amplitudes.data(), &small) == invalid);
  CHECK(last_has("struct_size"));
  CHECK(l.amplitudes[0] == 7);
  nook_transfer_light_destroy(&light);
  REQUIRE(nook_transfer_light_desc_init(&desc) == NOOK_OK);
  desc.direction = down;
  CHECK(create() == invalid);
  CHECK(last_has("unit length"));
  desc.direction = up;
  desc.irradiance[1] = INFINITY;
  CHECK(create() == invalid);
  CHECK(last_has("desc.irradiance"));
  desc.irradiance[1] = 1;
  REQUIRE(create() == NOOK_OK);
  nook_transfer_projection_info info{};
  info.struct_size = sizeof info;
  CHECK(nook_transfer_light_project(light, 19, nullptr, l.amplitudes.data(), &info) == invalid);
  CHECK(last_has("pass NULL"));
  CHECK(project(19, nullptr) == NOOK_OK);
  nook_transfer_light_destroy(&light);
}

TEST_CASE("transfer: callers of older and newer headers") {
  check_init<nook_transfer_light_desc>(nook_desc_init, NOOK_DESC_TRANSFER_LIGHT);
  check_init<nook_transfer_mesh_desc>(nook_desc_init, NOOK_DESC_TRANSFER_MESH);
  check_init<nook_transfer_vectors_desc>(nook_desc_init, NOOK_DESC_TRANSFER_VECTORS);
}

TEST_CASE("transfer: suns are counted, and too little room writes none") {
  Stage stage;
  std::vector<float> rgb(3 * 32 * 16, 0.2f);
  for (const std::size_t texel : {40u, 300u}) rgb[3 * texel] = 9000.0f;
  nook_transfer_light_desc desc;
  REQUIRE(nook_transfer_light_desc_init(&desc) == NOOK_OK);
  desc.rgb = rgb.data();
  desc.width = 32;
  desc.height = 16;
  desc.split_suns = 1;
  nook_transfer_light light = nullptr;
  REQUIRE(nook_transfer_light_create(stage.context, &desc, &light) == NOOK_OK);
  std::uint32_t count = 0;
  REQUIRE(nook_transfer_light_read_suns(light, nullptr, &count) == NOOK_OK);
  REQUIRE(count == 2);
  nook_transfer_sun suns[2] = {};
  count = 1;
  CHECK(nook_transfer_light_read_suns(light, suns, &count) == invalid);
  CHECK(count == 2);
  CHECK(suns[0].solid_angle == 0);
  CHECK(nook_transfer_light_read_suns(light, suns, &count) == NOOK_OK);
  CHECK(suns[1].solid_angle > 0);
  nook_transfer_light_destroy(&light);
}

TEST_CASE("transfer: a direction turns with the shape, and the context keeps what it factored") {
  Host host;
  const nook_context_desc context_desc = host.context_desc();
  nook_context context = nullptr;
  REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
  const float side[3] = {1, 0, 0}, up[3] = {0, 0, 1};
  const float up_from_side[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};  // takes +x to +z
  const auto make = [&](const float* direction) {
    nook_transfer_light_desc desc;
    REQUIRE(nook_transfer_light_desc_init(&desc) == NOOK_OK);
    desc.direction = direction;
    desc.irradiance[0] = 3;
    nook_transfer_light light = nullptr;
    REQUIRE(nook_transfer_light_create(context, &desc, &light) == NOOK_OK);
    return light;
  };
  nook_transfer_light from_side = make(side), from_up = make(up);
  const int before = host.blocks;
  std::vector<float> direct(3 * 19), turned(3 * 19);
  REQUIRE(nook_transfer_light_project(from_side, 19, nullptr, direct.data(), nullptr) == NOOK_OK);
  const int factored = host.blocks;
  CHECK(factored > before);
  REQUIRE(nook_transfer_light_project(from_up, 19, up_from_side, turned.data(), nullptr) == NOOK_OK);
  CHECK(turned == direct);
  CHECK(host.blocks == factored);
  REQUIRE(nook_transfer_light_project(from_up, 19, nullptr, turned.data(), nullptr) == NOOK_OK);
  CHECK(turned != direct);
  int refusals = 0;
  std::vector<float> more(3 * 21);
  for (;; ++refusals) {
    host.refuse_at = host.allocations + refusals;
    const nook_result result = nook_transfer_light_project(from_up, 21, nullptr, more.data(), nullptr);
    if (result == NOOK_OK) break;
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(host.blocks >= factored);
    // The last refused allocation holds the moments; the factor was kept before.
    if (host.blocks != factored) CHECK(refusals >= 3);
  }
  CHECK(refusals >= 3);
  CHECK(host.blocks > factored);
  nook_transfer_light_destroy(&from_side);
  nook_transfer_light_destroy(&from_up);
  nook_context_destroy(&context);
  CHECK(host.blocks == 0);
}

TEST_CASE("transfer: a neural material is refused, because its radiance is not a sum of light modes") {
  Loaded loaded;
  const std::vector<std::byte> bytes =
      nook::material::write_material(nook::material::test::sample_material(1, {.channels = 4}));
  nook_material neural = nullptr;
  REQUIRE(nook_material_load(loaded.stage.context, bytes.data(), bytes.size(), nullptr, &neural) == NOOK_OK);
  nook_material_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_material_describe(neural, &info) == NOOK_OK);
  CHECK(info.neural_channels == 4);
  const nook_material_tensor none{};
  CHECK(std::memcmp(&info.btf, &none, sizeof none) == 0);  // a neural material has no tensor of radiance
  CHECK(nook_transfer_check(loaded.transfer, nullptr, neural) == invalid);
  CHECK(last_has("the material is neural"));
  nook_transfer_response_desc desc;
  REQUIRE(nook_transfer_response_desc_init(&desc) == NOOK_OK);
  desc.material = neural;
  desc.lobe_count = 19;
  nook_transfer_response response = nullptr;
  CHECK(nook_transfer_response_create(loaded.stage.context, &desc, &response) == invalid);
  CHECK(last_has("the material is neural"));
  const nook_material_pixel pixel{{0, 0}, {0, 0}, {0, 0}, {0, 0, 1}, {0, 0, 1}};
  float radiance[3];
  CHECK(nook_transfer_shade(neural, &pixel, loaded.vectors.data(), 0, 1, radiance) == invalid);
  CHECK(last_has("the material is neural"));
  nook_material_destroy(&neural);
}
