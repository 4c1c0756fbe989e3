// Files of radiance transfer: a round trip, and bytes that a bake would not write.
#include "sdk/src/transfer/transfer_file.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/transfer/transfer_check.h"
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
  const Transfer made =
      GENERATE(transfer::test::sample_transfer(7, 21), transfer::test::sample_transfer(7, 21, 1),
               transfer::test::sample_transfer(3, 12, 2, 77));
  const Transfer read = read_transfer(write_transfer(made));
  CHECK(read.bounces == made.bounces);
  CHECK(read.indirect == made.indirect);
  CHECK(read.votf_hash == made.votf_hash);
  CHECK(read.lobes == made.lobes);
  CHECK(read.hashes == made.hashes);
  CHECK(read.shares == made.shares);
  CHECK(read.frames == made.frames);
  CHECK(read.recipe == made.recipe);
}

TEST_CASE("without reflections and holes a file has the sections of files that never had any") {
  const Transfer made = transfer::test::sample_transfer(7, 21);
  const std::vector<std::byte> bytes = write_transfer(made);
  const Container file(bytes, transfer_kind);
  CHECK(file.version() == 1);
  ByteReader head = file.section("HEAD");
  CHECK(head.u8() == 0);
  CHECK(head.u8() == 0);
  CHECK(head.u16() == 21);
  CHECK(head.u32() == 7);
  CHECK(head.remaining() == 32);
  CHECK_FALSE(file.has("INDI"));
  CHECK_FALSE(file.has("HOLE"));
  // 40 bytes of head and 24 for each of five sections, see core/container.h.
  std::size_t size = 40 + 5 * 24;
  for (const char* name : {"HEAD", "CODE", "SHAR", "FRAM", "RECP"}) {
    const char letters[5] = {name[0], name[1], name[2], name[3], 0};
    size += file.section(letters).remaining();
  }
  CHECK(bytes.size() >= size);
  CHECK(bytes.size() < size + 5 * 16);
}

TEST_CASE("truncated files are refused") {
  const std::vector<std::byte> bytes = write_transfer(transfer::test::sample_transfer(3, 12, 2, 77));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK(result_of(std::span(bytes).first(size)) == NOOK_ERROR_BAD_FILE);
}

TEST_CASE("flipped bytes with a repaired checksum are refused or harmless") {
  const std::vector<std::byte> bytes = write_transfer(transfer::test::sample_transfer(5, 19, 1, 77));
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
  transfer.bounces = 1;
  CHECK_THROWS_AS(write_transfer(transfer), Failure);
  transfer = transfer::test::sample_transfer(3, 12, 2);
  transfer.indirect[5] = 0x7c00;  // infinity
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

TEST_CASE("another VOTF than the baked one is refused, and without holes any will do") {
  CHECK_NOTHROW(check_same_material(transfer::test::sample_transfer(), 5));
  const Transfer holes = transfer::test::sample_transfer(5, 19, 0, 77);
  CHECK_NOTHROW(check_same_material(holes, 77));
  CHECK_THROWS_AS(check_same_material(holes, 5), Failure);
}
