// The C++ wrapper. This file sees public headers only, as a host does.
#include <unistd.h>

#include <nook/experimental/nook_sg.h>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nook/experimental/nook_capture.hpp>
#include <nook/experimental/nook_debug.hpp>
#include <nook/experimental/nook_poses.hpp>
#include <nook/experimental/nook_recording.hpp>
#include <nook/experimental/nook_stages.hpp>
#include <nook/experimental/nook_synthesis.hpp>
#include <nook/experimental/nook_transfer.hpp>
#include <nook/experimental/nook_world_sample.hpp>
#include <nook/nook.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/catch.h"

std::vector<std::byte> nook_test_model_bytes();
std::vector<std::byte> nook_test_material_bytes();
std::vector<std::byte> nook_test_clips_bytes();
std::vector<std::byte> nook_test_bent_model_bytes();

namespace {

// A folder of this process that is removed with it.
struct TemporaryFolder {
  TemporaryFolder()
      : path(std::filesystem::temp_directory_path() / ("nook_recording_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  std::ptrdiff_t files() const { return std::distance(std::filesystem::directory_iterator(path), {}); }

  const std::filesystem::path path;
};

}  // namespace

TEST_CASE("the C++ wrapper owns, moves and throws") {
  const std::vector<std::byte> bytes = nook_test_model_bytes();
  nook::Context context;
  nook::CharacterModel model(context, bytes.data(), bytes.size());
  nook::Scene scene(context);
  const nook_instance_id id = scene.add_instance(model);
  nook::Scene moved = std::move(scene);
  moved.update();
  std::vector<float> ao(model.info().file_vertex_count);
  moved.read_ao(id, ao.data(), static_cast<std::uint32_t>(ao.size()));
  CHECK(moved.info().instances == 1);
  CHECK(model.bone_name(0) == "skeleton:bone_0");
  std::vector<float> bones(12 * model.info().bone_count, 0.0f);
  for (std::size_t b = 0; b < bones.size(); b += 12) bones[b] = bones[b + 5] = bones[b + 10] = 1;
  nook_pose_desc pose = nook::pose_desc();
  pose.kind = NOOK_POSE_REST_TO_WORLD;
  pose.layout = NOOK_TRANSFORM_ROWS_3X4;
  pose.transforms = bones.data();
  pose.transform_count = model.info().bone_count;
  moved.set_pose(id, pose);
  moved.update();
  moved.read_ao(id, ao.data(), static_cast<std::uint32_t>(ao.size()));
  CHECK(nook::evaluate_poses(model, pose, 1) == ao);
  CHECK(model.map_bones({"skeleton:bone_1"})[1] == 0);
  CHECK(model.remap({3, 3, 1}).info().file_vertex_count == 3);
  try {
    moved.remove_instance(999);
    FAIL("no exception");
  } catch (const nook::Error& error) {
    CHECK(error.result() == NOOK_ERROR_INVALID_HANDLE);
    CHECK(std::string(error.what()).find("999") != std::string::npos);
  }
}

TEST_CASE("the C++ wrapper reads bent normals as the C functions do") {
  const std::vector<std::byte> bytes = nook_test_bent_model_bytes();
  const nook::Context context;
  const nook::CharacterModel model(context, bytes.data(), bytes.size());
  const std::uint32_t count = model.info().file_vertex_count;
  std::vector<std::int8_t> occluded(std::size_t{8} * count), normals(std::size_t{4} * count);
  REQUIRE(nook_model_read(model.get(), NOOK_MODEL_OCCLUDED_DIRECTIONS, occluded.data(), count, 0) == NOOK_OK);
  CHECK(model.occluded_directions() == occluded);
  nook::Scene scene(context);
  const nook_instance_id id = scene.add_instance(model);
  scene.update();
  REQUIRE(nook_scene_read(scene.get(), id, NOOK_CHANNEL_BENT_NORMAL, NOOK_FORMAT_SNORM8, normals.data(),
                          count, 0) == NOOK_OK);
  std::vector<std::int8_t> wrapped(normals.size());
  scene.read_bent_normals(id, wrapped.data(), count);
  CHECK(wrapped == normals);
  CHECK(normals != std::vector<std::int8_t>(normals.size()));
}

TEST_CASE("the C++ wrapper's fits start from another, and from nothing again") {
  const float up[3] = {0, 0, 1}, white[3] = {1, 1, 1};
  const nook::Context context;
  nook_probe_fit_desc desc = nook::probe_fit_desc();
  desc.method = NOOK_PROBE_FIT_RUNNING_AVERAGE;
  nook::ProbeFit fit(context, desc), other(context, desc);
  fit.add_samples(up, white, nullptr, 1);
  nook::check(nook_probe_fit_seed(other.get(), fit.get()));
  CHECK(other.solve().coefficients() == fit.solve().coefficients());
  other.reset();
  const std::vector<float> none = other.solve().coefficients();
  CHECK(none == std::vector<float>(none.size(), 0.0f));
}

TEST_CASE("the C++ wrapper fits, saves and evaluates probes") {
  std::vector<float> directions, radiance;
  for (int i = 0; i < 500; ++i) {
    const float z = 1 - 2 * (float(i) + 0.5f) / 500, r = std::sqrt(1 - z * z);
    directions.insert(directions.end(), {r * std::cos(2.4f * float(i)), r * std::sin(2.4f * float(i)), z});
    radiance.insert(radiance.end(), {1 + z, 1, 1 - z});
  }
  nook::Context context;
  nook::ProbeFit fit(context), other(context);
  fit.add_samples(directions.data(), radiance.data(), nullptr, 500);
  other.add_samples(directions.data(), radiance.data(), nullptr, 500);
  fit.merge(other);
  CHECK(fit.info().samples == 1000);
  const nook::Probe probe = fit.solve();
  const auto file = probe.save(NOOK_PROBE_PACKING_FLOAT);
  const nook::Probe loaded(context, file.data(), file.size());
  CHECK(loaded.coefficients() == probe.coefficients());
  CHECK(loaded.lobes().size() == loaded.info().function_count);

  nook_probe_desc desc = nook::probe_desc();
  std::vector<float> two = probe.coefficients();
  for (const float value : probe.coefficients()) two.push_back(3 * value);
  desc.functions = fit.get();
  desc.counts[0] = 2;
  desc.coefficients = two.data();
  const nook::Probe grid(context, desc);
  const float middle[3] = {0.5f, 0, 0}, up[3] = {0, 0, 1};
  float between[3], one[3];
  grid.irradiance(middle, up, between, 1);
  probe.irradiance(nullptr, up, one, 1);
  CHECK(std::abs(between[0] - 2 * one[0]) < 1e-4f);
  try {
    grid.radiance(nullptr, nullptr, one, 1);
    FAIL("no exception");
  } catch (const nook::Error& error) {
    CHECK(error.result() == NOOK_ERROR_INVALID_ARGUMENT);
  }
}

TEST_CASE("the C++ wrapper owns a material and decodes it") {
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  const nook::Context context;
  nook::Material made(context, bytes.data(), bytes.size());
  const nook::Material material = std::move(made);
  CHECK_FALSE(made);
  const nook_material_info info = material.info();
  CHECK(info.visibility == NOOK_MATERIAL_VISIBILITY_DISTANCE);
  CHECK(info.visibility_threshold == 0.05f);
  CHECK(info.visibility_weight == 12);
  CHECK(info.light_count == 5);
  CHECK(info.view_count == 9);
  CHECK(info.btf.clusters == 3);
  CHECK(info.btf.mixture == 2);
  CHECK(info.votf.rank_light == 1);
  // Without a view map all three clusters: three terms of one group of four view modes and four light modes;
  // their coefficients; their clusters.
  CHECK(info.decode_fetches == 3 * 4 + 3 + 1);
  CHECK(info.decode_multiply_adds == 3 * 16);
  CHECK(info.light_fetches == 3);
  CHECK(info.light_multiply_adds == 12);
  CHECK(info.occlusion_fetches == 3 + 3 + 1);
  CHECK(info.further_decode_fetches == 3 * 4);
  CHECK(info.further_occlusion_fetches == 3);
  CHECK(info.view_map_bytes == 0);
  CHECK(info.compressed_bytes < bytes.size());
  nook_material_value value{};
  const nook_material_pixel pixel{{0.2f, 0.7f}, {0.1f, 0}, {0, 0.1f}, {0, 0, 1}, {0, 0, 1}};
  material.evaluate(&pixel, 1, 2, &value);
  CHECK(value.visibility >= 0);
  CHECK_THROWS_AS(nook::Material(context, bytes.data(), 10), nook::Error);
}

TEST_CASE("recorded frames: the wrapper writes a file whole or not at all") {
  const TemporaryFolder folder;
  nook::Context context;
  const std::vector<float> depth(20, 0.97f), ao(20, 0.5f);
  nook_nnao_recording_desc desc = nook::nnao_recording_desc();
  desc.width = 5;
  desc.height = 4;
  desc.depth = depth.data();
  desc.ao = ao.data();
  desc.radius = 0.5f;
  desc.note = "a remark";
  desc.projection[0] = desc.projection[5] = 1.5f;
  desc.projection[10] = desc.projection[11] = -1;
  desc.projection[14] = -0.2f;
  const nook::Recording recording(context, desc);
  const std::filesystem::path file = folder.path / "frame.nook";
  std::ofstream(file) << "an older file";
  recording.write(file);
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  CHECK(bytes.size() == recording.save().size());
  const nook::Recording loaded(context, bytes.data(), bytes.size());
  CHECK(loaded.save() == recording.save());
  CHECK(loaded.desc().note == std::string(desc.note));
  CHECK(folder.files() == 1);
  CHECK_THROWS_AS(recording.write(folder.path / "absent" / "frame.nook"), std::runtime_error);
  CHECK(folder.files() == 1);
  // Files of the user's beside it stay, and the file keeps its permissions.
  for (const char* name : {"frame.nook.part", "frame.nook.nook-part-recording-0"})
    std::ofstream(folder.path / name) << "mine";
  const auto own = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
  std::filesystem::permissions(file, own);
  recording.write(file);
  CHECK(folder.files() == 3);
  CHECK(std::filesystem::file_size(folder.path / "frame.nook.nook-part-recording-0") == 4);
  CHECK(std::filesystem::status(file).permissions() == own);
}

TEST_CASE("the C++ wrapper of clips loads, finds and reads") {
  const std::vector<std::byte> model_bytes = nook_test_model_bytes(), bytes = nook_test_clips_bytes();
  nook::Context context;
  nook::CharacterModel model(context, model_bytes.data(), model_bytes.size());
  const nook::Clips clips(context, model, bytes.data(), bytes.size());
  CHECK(clips.info().clip_count == 2);
  CHECK(clips.find("walk") == 1);
  CHECK(clips.clip(1).frame_count == 5);
  CHECK(clips.find("swim") == clips.info().clip_count);
  const nook_clip_time time{1, NOOK_CLIP_LOOP, 0.6};
  CHECK(clips.ao(time).size() == model.info().file_vertex_count);
  std::uint32_t width = 0, height = 0;
  const std::vector<std::uint8_t> texels = nook::clips_table(clips, NOOK_CLIPS_MODES, width, height);
  CHECK(texels.size() == std::size_t(4) * width * height);
}
