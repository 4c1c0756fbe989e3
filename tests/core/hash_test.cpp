#include "sdk/src/core/hash.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "sdk/src/core/container.h"
#include "tests/catch.h"

using namespace nook;

namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

// The bytes that the self test of the reference implementation hashes.
std::vector<std::byte> generated_bytes(std::size_t count) {
  std::vector<std::byte> bytes;
  std::uint64_t state = 2654435761u;
  for (std::size_t i = 0; i < count; ++i, state *= 11400714785074694797u)
    bytes.push_back(std::byte(state >> 56));
  return bytes;
}

std::vector<std::byte> file_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

TEST_CASE("the hash has the values that are published for XXH64") {
  CHECK(hash64({}) == 0xef46db3751d8e999);
  CHECK(hash64(bytes_of("a")) == 0xd24ec4f1a98c6e5b);
  CHECK(hash64(bytes_of("abc")) == 0x44bc2cf5ad770999);
  CHECK(hash64(bytes_of("Nobody inspects the spammish repetition")) == 0xfbcea83c8a378bf1);
  CHECK(hash64(bytes_of("xxhash"), 20141025) == 0xb559b98d844e0635);

  constexpr std::uint64_t seed = 2654435761u;
  struct Vector {
    std::size_t size;
    std::uint64_t unseeded, seeded;
  };
  for (const Vector& v :
       {Vector{0, 0xef46db3751d8e999, 0xac75fda2929b17ef}, Vector{1, 0xe934a84adb052768, 0x5014607643a9b4c3},
        Vector{4, 0x9136a0dca57457ee, 0xcaab286bd8e9fdb5}, Vector{14, 0x8282dcc4994e35c8, 0xc3bd6bf63deb6df0},
        Vector{222, 0xb641ae8cb691c174, 0x20cb8ab7ae10c14a}}) {
    CAPTURE(v.size);
    CHECK(hash64(generated_bytes(v.size)) == v.unseeded);
    CHECK(hash64(generated_bytes(v.size), seed) == v.seeded);
  }
}

TEST_CASE("pieces of any size have the hash of the whole") {
  const std::vector<std::byte> bytes = generated_bytes(200);
  const std::span<const std::byte> all(bytes);
  for (std::size_t size = 0; size <= 70; ++size)
    for (std::size_t cut = 0; cut <= size; ++cut) {
      Hash64 pieces(7);
      pieces.add(all.first(cut));
      pieces.value();
      pieces.add(all.subspan(cut, size - cut));
      REQUIRE(pieces.value() == hash64(all.first(size), 7));
    }
  for (const std::size_t step : {1, 31, 32, 33, 64, 65}) {
    Hash64 pieces;
    for (std::size_t at = 0; at < all.size(); at += step)
      pieces.add(all.subspan(at, std::min(step, all.size() - at)));
    CHECK(pieces.value() == hash64(all));
  }
}

TEST_CASE("files that the reference implementation checked keep their checksum") {
  const std::vector<std::byte> network = file_bytes(NOOK_DEFAULT_NETWORK);
  REQUIRE(network.size() > 500);
  std::vector<std::byte> repaired = network;
  repair_checksum(repaired);
  CHECK(repaired == network);
}
