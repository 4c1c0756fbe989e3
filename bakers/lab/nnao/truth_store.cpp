#include "bakers/lab/nnao/truth_store.h"

#include <cstdio>

#include "platform/file_bytes.h"
#include "sdk/src/core/bytes.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/core/hash.h"

namespace nook::lab {
namespace {

// Increment this whenever the same settings lead to a different reference.
constexpr std::uint32_t version = 1;

std::uint64_t key_of(std::uint64_t scene, const bake::nnao::Camera& camera, const TruthSettings& settings) {
  ByteWriter bytes;
  bytes.u32(version);
  bytes.u64(scene);
  for (const float number : camera.world_from_view.m) bytes.f32(number);
  for (const float number :
       {camera.rays.x_scale, camera.rays.x_offset, camera.rays.y_scale, camera.rays.y_offset})
    bytes.f32(number);
  bytes.u32(camera.rays.orthographic);
  for (const std::uint32_t number : {camera.width, camera.height, settings.rays}) bytes.u32(number);
  bytes.f32(settings.radius);
  bytes.u64(settings.seed);
  return hash64(bytes.bytes());
}

std::filesystem::path file_of(const std::filesystem::path& folder, std::uint64_t key) {
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.truth", static_cast<unsigned long long>(key));
  return folder / name;
}

// Reads a cached file. It contains the noise (64 bits), the AO of each pixel (32 bits each), and a hash of
// these bytes and the key.
Truth unpack(std::span<const std::byte> bytes, std::uint64_t key, std::size_t pixels) {
  ByteReader reader(bytes, "truth");
  Truth truth;
  truth.noise = bit_cast<double>(reader.u64());
  for (std::size_t i = 0; i < pixels; ++i) truth.ao.push_back(reader.f32());
  const std::size_t body = bytes.size() - reader.remaining();
  if (reader.u64() != hash64(bytes.first(body), key) || reader.remaining() != 0)
    throw Failure(NOOK_ERROR_BAD_FILE, "a stored reference is damaged");
  return truth;
}

std::vector<std::byte> pack(const Truth& truth, std::uint64_t key) {
  ByteWriter writer;
  writer.u64(bit_cast<std::uint64_t>(truth.noise));
  for (const float value : truth.ao) writer.f32(value);
  writer.u64(hash64(writer.bytes(), key));
  return writer.bytes();
}

}  // namespace

TruthStore::TruthStore(std::filesystem::path folder, const bake::TriangleSoup& scene)
    : folder_(std::move(folder)) {
  Hash64 hash;
  hash.add(std::as_bytes(std::span(scene.position)));
  hash.add(std::as_bytes(std::span(scene.triangle)));
  scene_ = hash.value();
}

Truth TruthStore::read_or_trace(const bake::nnao::Camera& camera, const TruthSettings& settings,
                                const std::function<Truth()>& trace) const {
  if (folder_.empty()) return trace();
  const std::uint64_t key = key_of(scene_, camera, settings);
  const std::filesystem::path file = file_of(folder_, key);
  if (std::filesystem::exists(file)) {
    try {
      const std::vector<unsigned char> bytes = platform::read_file(file);
      return unpack(std::as_bytes(std::span(bytes)), key, std::size_t(camera.width) * camera.height);
    } catch (const Failure&) {
      // The damaged file is replaced below.
    }
  }
  Truth truth = trace();
  const std::vector<std::byte> bytes = pack(truth, key);
  platform::write_file(file, bytes.data(), bytes.size());
  return truth;
}

}  // namespace nook::lab
