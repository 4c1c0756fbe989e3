// Every call that takes a number of elements and the bytes between them: distances for which no memory is
// large enough are refused before anything is computed from them.
#include <nook/experimental/nook_poses.h>
#include <nook/experimental/nook_sg.h>
#include <nook/experimental/nook_transfer.h>
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_clips.h>
#include <nook/nook_probe.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/transfer/transfer_file.h"
#include "tests/abi/host.h"
#include "tests/catch.h"
#include "tests/character/clip_sample.h"
#include "tests/transfer/transfer_sample.h"

using namespace nook::test;

std::vector<std::byte> nook_test_material_bytes();
std::vector<std::byte> nook_test_clips_bytes();

namespace {

constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;

// Multiples of 4 whose product with `count` does not fit an address, or a signed difference of two. count is
// more than 1.
std::vector<std::size_t> bad_strides(std::size_t count) {
  std::vector<std::size_t> strides;
  for (const std::size_t most : {SIZE_MAX, std::size_t{PTRDIFF_MAX}})
    for (const std::size_t bytes : {most, most - 3, most / 2 + 1, most / count + 4, most / (count - 1) + 4})
      strides.push_back(bytes & ~std::size_t{3});
  return strides;
}

// Calls write(out, stride) with strides that are refused. Nothing is written.
void refuses(const char* call, std::size_t count,
             const std::function<nook_result(void*, std::size_t)>& write) {
  REQUIRE(count > 1);
  std::vector<unsigned char> out(1 << 16, 0xa5);
  for (const std::size_t stride : bad_strides(count)) {
    if (stride > PTRDIFF_MAX / count) {
      INFO(call << ", stride " << stride);
      CHECK(write(out.data(), stride) == invalid);
      CHECK(std::string(nook_last_message()).find("stride") != std::string::npos);
    }
  }
  CHECK(out == std::vector<unsigned char>(out.size(), 0xa5));
  // 0 stands for the smallest stride.
  CHECK(write(out.data(), 0) == NOOK_OK);
}

struct Strides : Stage {
  std::vector<float> positions;

  Strides() {
    nook_check_vertex_info vertex{};
    vertex.struct_size = sizeof vertex;
    for (std::uint32_t v = 0; v < info.check_vertex_count; ++v) {
      REQUIRE(nook_model_describe_check_vertex(model, v, &vertex) == NOOK_OK);
      positions.insert(positions.end(), vertex.position, vertex.position + 3);
    }
    for (const nook_instance_id id : {first, second})
      REQUIRE(set_rows(scene, id, pose.data(), info.bone_count) == NOOK_OK);
    REQUIRE(nook_scene_update(scene) == NOOK_OK);
  }
};

}  // namespace

TEST_CASE("strides: reading AO and arrays of a model refuses what overflows") {
  Strides s;
  const std::uint32_t count = s.info.file_vertex_count;
  refuses("nook_model_read", count, [&](void* out, std::size_t stride) {
    return nook_model_read(s.model, NOOK_MODEL_STATIC_AO, out, count, stride);
  });
  for (const nook_format format : {NOOK_FORMAT_FLOAT, NOOK_FORMAT_HALF, NOOK_FORMAT_UNORM8})
    refuses("nook_scene_read", count, [&](void* out, std::size_t stride) {
      return nook_scene_read(s.scene, s.first, NOOK_CHANNEL_AO, format, out, count, stride);
    });
  refuses("nook_scene_read of directional AO", count, [&](void* out, std::size_t stride) {
    return nook_scene_read(s.scene, s.first, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, out, count,
                           stride);
  });
}

TEST_CASE("strides: poses and vertices of the host refuse what overflows") {
  Strides s;
  nook_pose_desc pose = pose_of_rows(s.pose.data(), s.info.bone_count);
  refuses("nook_scene_set_pose", s.info.bone_count, [&](void*, std::size_t stride) {
    pose.stride = stride;
    return nook_scene_set_pose(s.scene, s.first, &pose);
  });
  refuses("nook_model_convert_pose", s.info.bone_count, [&](void* out, std::size_t stride) {
    pose.stride = stride;
    return nook_model_convert_pose(s.model, &pose, static_cast<float*>(out), s.info.bone_count);
  });
  pose.stride = 0;
  // Strides are refused before anything is written.
  float ao[4] = {2, 2, 2, 2};
  for (const std::size_t stride : {SIZE_MAX - 3, SIZE_MAX / 2 - 3, std::size_t{4}}) {
    INFO(stride);
    CHECK(nook_model_evaluate_poses(s.model, nullptr, &pose, 8, stride, nullptr, ao,
                                    std::size_t{8} * s.info.file_vertex_count) == invalid);
    CHECK(std::string(nook_last_message()).find("pose_stride") != std::string::npos);
  }
  CHECK(ao[0] == 2);
  nook_pose_check_desc check;
  REQUIRE(nook_pose_check_desc_init(&check) == NOOK_OK);
  check.vertex_count = s.info.check_vertex_count;
  check.positions = s.positions.data();
  refuses("nook_model_check_pose", check.vertex_count, [&](void*, std::size_t stride) {
    check.stride = stride;
    nook_pose_check_info info{};
    info.struct_size = sizeof info;
    return nook_model_check_pose(s.model, &pose, &check, &info);
  });
  nook_vertex_match_desc match;
  REQUIRE(nook_vertex_match_desc_init(&match) == NOOK_OK);
  match.vertex_count = s.info.check_vertex_count;
  match.positions = match.normals = s.positions.data();
  for (std::size_t nook_vertex_match_desc::*field :
       {&nook_vertex_match_desc::position_stride, &nook_vertex_match_desc::normal_stride})
    refuses("nook_model_match_vertices", match.vertex_count, [&](void* out, std::size_t stride) {
      match.position_stride = match.normal_stride = 0;
      match.*field = stride;
      return nook_model_match_vertices(s.model, &match, static_cast<std::uint32_t*>(out), nullptr);
    });
}

TEST_CASE("strides: clips refuse what overflows") {
  Strides s;
  const std::vector<std::byte> bytes = nook_test_clips_bytes();
  nook_clips clips = nullptr;
  REQUIRE(nook_clips_load(s.context, s.model, bytes.data(), bytes.size(), &clips) == NOOK_OK);
  const nook_clip_time time{1, NOOK_CLIP_CLAMP, 0.6};
  refuses("nook_clips_read_ao", s.info.file_vertex_count, [&](void* out, std::size_t stride) {
    return nook_clips_read_ao(clips, &time, NOOK_FORMAT_FLOAT, out, s.info.file_vertex_count, stride);
  });
  nook_clips_destroy(&clips);
}

TEST_CASE("strides of 32 bits: products of a count and a stride are checked") {
  // Here products cannot overflow, where size_t has 64 bits. A count and a stride at their ends are refused,
  // if their product is larger than any memory.
  Strides s;
  nook_world_sample_desc sample;
  REQUIRE(nook_world_sample_desc_init(&sample) == NOOK_OK);
  sample.positions = sample.normals = s.positions.data();
  sample.point_count = UINT32_MAX;
  sample.stride = UINT32_MAX - 3;
  float ao[4] = {2, 2, 2, 2};
  CHECK(nook_world_sample(s.scene, &sample, ao, nullptr) == invalid);
  CHECK(std::string(nook_last_message()).find("desc.stride") != std::string::npos);
  CHECK(ao[0] == 2);

  const std::vector<std::byte> bytes =
      nook::transfer::write_transfer(nook::transfer::test::sample_transfer());
  const std::vector<std::byte> material_bytes = nook_test_material_bytes();
  nook_transfer transfer = nullptr;
  nook_material material = nullptr;
  nook_transfer_response response = nullptr;
  REQUIRE(nook_transfer_load(s.context, bytes.data(), bytes.size(), &transfer) == NOOK_OK);
  REQUIRE(nook_material_load(s.context, material_bytes.data(), material_bytes.size(), nullptr, &material) ==
          NOOK_OK);
  nook_transfer_response_desc desc;
  REQUIRE(nook_transfer_response_desc_init(&desc) == NOOK_OK);
  desc.material = material;
  desc.lobe_count = 19;
  REQUIRE(nook_transfer_response_create(s.context, &desc, &response) == NOOK_OK);
  nook_transfer_vectors_desc vectors;
  REQUIRE(nook_transfer_vectors_desc_init(&vectors) == NOOK_OK);
  const std::vector<float> amplitudes(3 * 19, 0.5f);
  vectors.amplitudes = amplitudes.data();
  vectors.lobe_count = 19;
  vectors.normals = vectors.tangents = s.positions.data();
  float out[4] = {2, 2, 2, 2};
  CHECK(nook_transfer_read_vectors(response, &vectors, out, UINT32_MAX, UINT32_MAX) == invalid);
  CHECK(std::string(nook_last_message()).find("stride_floats") != std::string::npos);
  CHECK(out[0] == 2);
  nook_transfer_response_destroy(&response);
  nook_material_destroy(&material);
  nook_transfer_destroy(&transfer);
}

TEST_CASE("counts of packed arrays that no memory can hold are refused") {
  float direction[3] = {0, 1, 0}, rgb[3] = {2, 2, 2};
  nook_lobe lobe{};
  lobe.axis[1] = lobe.sharpness = lobe.amplitude[0] = 1;
  nook_probe_surface surface{};
  const float coefficients[27] = {};
  for (const std::size_t count : {SIZE_MAX, SIZE_MAX / 12 + 1, std::size_t{PTRDIFF_MAX} / 12 + 1}) {
    INFO(count);
    CHECK(nook_sg_radiance(&lobe, 1, direction, rgb, count) == invalid);
    CHECK(nook_sg_irradiance(&lobe, 1, NOOK_PROBE_IRRADIANCE_FITTED, direction, rgb, count) == invalid);
    CHECK(nook_sg_specular(&lobe, 1, NOOK_PROBE_SPECULAR_ISOTROPIC, &surface, rgb, count) == invalid);
    CHECK(nook_sh_radiance(coefficients, 2, direction, rgb, count) == invalid);
    CHECK(nook_sh_irradiance(coefficients, 2, direction, rgb, count) == invalid);
  }
  CHECK(rgb[0] == 2);
}

TEST_CASE("strides: all of the headers are in this file, or have a reason") {
  // By header: the declarations of fields and parameters that are strides.
  const std::map<std::string, int> known{
      {"nook_bake.h", 1},       // nook_bake_character_read: tests/bakers/api/character_test.cpp
      {"nook_character.h", 8},  // nook_model_read, nook_scene_read, pose, check, and four of a match
      {"nook_clips.h", 1},      // nook_clips_read_ao
      {"nook_gl.h", 3},     // a view (an answer) and a target, which is within 2^40: tests/gl/output_test.cpp
      {"nook_poses.h", 1},  // nook_model_evaluate_poses
      {"nook_transfer.h", 1},      // nook_transfer_read_vectors
      {"nook_world_sample.h", 1},  // nook_world_sample
  };
  const std::regex declared(R"((size_t|uint32_t|uint64_t)\s+\w*stride\w*\s*[;,)])");
  std::map<std::string, int> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(NOOK_HEADERS)) {
    if (entry.path().extension() != ".h") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const std::string header = text.str();
    const auto count = std::distance(std::sregex_iterator(header.begin(), header.end(), declared), {});
    if (count > 0) found[entry.path().filename().string()] = int(count);
  }
  CHECK(found == known);
}
