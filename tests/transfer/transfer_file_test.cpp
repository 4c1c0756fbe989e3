// Files of radiance transfer: a round trip, and bytes that a bake would not write.
#include "sdk/src/transfer/transfer_file.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/transfer/check.h"
#include "tests/catch.h"
#include "tests/transfer/transfer_sample.h"

using namespace nook;
using namespace nook::transfer;

namespace {

nook_result result_of(std::span<const std::byte> bytes) {
  try {
    read_transfer(bytes);
    return NOOK_OK;
  } catch (const Failure& failure) {
    return failure.code();
  }
}

}  // namespace

TEST_CASE("a file gives back what was written") {
  const Transfer made = transfer::test::sample_transfer(7, 21);
  const Transfer read = read_transfer(write_transfer(made));
  CHECK(read.lobes == made.lobes);
  CHECK(read.hashes == made.hashes);
  CHECK(read.shares == made.shares);
  CHECK(read.frames == made.frames);
  CHECK(read.recipe == made.recipe);
}

TEST_CASE("truncated files are refused") {
  const std::vector<std::byte> bytes = write_transfer(transfer::test::sample_transfer());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK(result_of(std::span(bytes).first(size)) == NOOK_ERROR_BAD_FILE);
}

TEST_CASE("flipped bytes with a repaired checksum are refused or harmless") {
  const std::vector<std::byte> bytes = write_transfer(transfer::test::sample_transfer());
  std::size_t refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const unsigned flip : {1u, 0x80u, 0xffu}) {
      std::vector<std::byte> changed = bytes;
      changed[i] ^= std::byte(flip);
      repair_checksum(changed);
      const nook_result result = result_of(changed);
      CHECK((result == NOOK_OK || result == NOOK_ERROR_BAD_FILE || result == NOOK_ERROR_FILE_VERSION));
      refused += result != NOOK_OK;
    }
  CHECK(refused > 100);  // the head, the tables and every code that becomes 3
}

TEST_CASE("numbers out of range are not written") {
  Transfer transfer = transfer::test::sample_transfer();
  transfer.shares.pop_back();
  CHECK_THROWS_AS(write_transfer(transfer), Failure);
  transfer = transfer::test::sample_transfer();
  transfer.lobes = 3;
  CHECK_THROWS_AS(write_transfer(transfer), Failure);
  CHECK_THROWS_AS(write_transfer(Transfer()), Failure);
}

TEST_CASE("packed frames keep their directions to 1e-4") {
  std::vector<Vec3> axes(500);
  lobe_axes(axes);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Frame frame = orthonormal_frame(axes[i], axes[(i * 7 + 3) % axes.size()], i % 2 ? 1.0f : -1.0f);
    const Frame read = unpack(pack(frame));
    CHECK(length(read.normal - frame.normal) < 1e-4f);
    // The angle has 2 pi / 32768 steps of 1.9e-4, and the rounded normal turns its axis by as little.
    CHECK(length(read.tangent - frame.tangent) < 3e-4f);
    CHECK(read.handedness == frame.handedness);
    CHECK(std::abs(dot(read.tangent, read.normal)) < 1e-5f);
  }
}

TEST_CASE("a mesh is the baked one or is named") {
  Transfer transfer = transfer::test::sample_transfer(2, 12);
  const float position[6] = {0, 1, 2, -0.0f, 4, 5}, moved[6] = {0, 1, 2, 0, 4, 5.0001f};
  transfer.hashes.position = hash_floats(position);
  const float same[6] = {0, 1, 2, 0, 4, 5};  // 0 equals -0
  CHECK_NOTHROW(check_same_mesh(transfer, {same, {}, {}, {}, 2}));
  CHECK_THROWS_AS(check_same_mesh(transfer, {moved, {}, {}, {}, 2}), Failure);
  CHECK_THROWS_AS(check_same_mesh(transfer, {same, {}, {}, {}, 3}), Failure);
}
