#include "sdk/src/nnao/network_file.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sdk/src/core/floats.h"
#include "tests/catch.h"
#include "tests/nnao/network_sample.h"

using namespace nook;
using namespace nook::nnao;

namespace {

constexpr NetworkForm forms[] = {NetworkForm::paper, NetworkForm::horizon};

nook_result read_result(std::span<const std::byte> bytes) {
  try {
    read_network(bytes);
  } catch (const Failure& failure) {
    return failure.code();
  }
  return NOOK_OK;
}

}  // namespace

TEST_CASE("every half float comes back from its float") {
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    const float value = from_half(std::uint16_t(bits));
    if (std::isnan(value))
      CHECK(std::isnan(from_half(to_half(value))));
    else
      REQUIRE(to_half(value) == bits);
  }
  // Ties go to the even neighbour, and what lies beyond the largest half is infinite.
  CHECK(from_half(to_half(1 + 0x1p-11f)) == 1);
  CHECK(from_half(to_half(1 + 0x3p-11f)) == 1 + 0x1p-9f);
  CHECK(from_half(to_half(65519)) == 65504);
  CHECK(std::isinf(from_half(to_half(65520))));
  CHECK(to_half(0x1p-26f) == 0);
}

TEST_CASE("a network comes back from its file bit for bit") {
  for (const NetworkForm form : forms) {
    const Network network = test::sample_network(form);
    const std::vector<std::byte> file = write_network(network);
    const Network read = read_network(file);
    CHECK(read.form == form);
    CHECK(read.recipe == network.recipe);
    CHECK(read.paper.filters == network.paper.filters);
    CHECK(read.horizon.direction.weights == network.horizon.direction.weights);
    CHECK(read.paper.layer_3.positive_slope == network.paper.layer_3.positive_slope);
    CHECK(write_network(read) == file);
  }
}

TEST_CASE("a network file cut or flipped at any byte is refused") {
  for (const NetworkForm form : forms) {
    const std::vector<std::byte> good = write_network(test::sample_network(form));
    // The paper's file has 33 KB, and 31 of them are filters, all alike: every byte of the rest, one in 37 of
    // them.
    const auto stride = [&](std::size_t i) {
      return form == NetworkForm::paper && i > 400 && i + 1200 < good.size() ? 37 : 1;
    };
    for (std::size_t i = 0; i < good.size(); i += std::size_t(stride(i))) {
      const std::vector<std::byte> cut(good.begin(), good.begin() + std::ptrdiff_t(i));
      REQUIRE(read_result(cut) == NOOK_ERROR_BAD_FILE);
      auto flipped = good;
      flipped[i] ^= std::byte{0x81};
      REQUIRE(read_result(flipped) != NOOK_OK);
    }
  }
}

TEST_CASE("a network file flipped with its checksum repaired is refused or holds finite numbers") {
  for (const NetworkForm form : forms) {
    const std::vector<std::byte> good = write_network(test::sample_network(form));
    const std::size_t stride = form == NetworkForm::paper ? 11 : 1;
    std::size_t refused = 0;
    for (std::size_t i = 0; i < good.size(); i += stride)
      for (const unsigned flip : {0x01u, 0x40u, 0x80u, 0xffu}) {
        auto file = good;
        file[i] ^= std::byte(flip);
        repair_checksum(file);
        try {
          const Network network = read_network(file);
          const auto sound = [](float value) { return std::abs(value) <= max_parameter; };
          REQUIRE(std::ranges::all_of(network.paper.filters, sound));
          REQUIRE(std::ranges::all_of(network.horizon.tap.weights, sound));
          REQUIRE(std::ranges::all_of(network.horizon.out, sound));
        } catch (const Failure& failure) {
          REQUIRE((failure.code() == NOOK_ERROR_BAD_FILE || failure.code() == NOOK_ERROR_FILE_VERSION));
          ++refused;
        }
      }
    CHECK(refused > 0);
  }
}

TEST_CASE("a network that could overflow is not written") {
  for (const float bad : {NAN, INFINITY, 2 * max_parameter}) {
    Network network = test::sample_network(NetworkForm::horizon);
    network.horizon.join.weights[3] = bad;
    CHECK_THROWS_AS(write_network(network), Failure);
    network = test::sample_network(NetworkForm::paper);
    network.paper.filters[100] = bad;
    CHECK_THROWS_AS(write_network(network), Failure);
  }
  Network network = test::sample_network(NetworkForm::paper);
  network.paper.filters.pop_back();
  CHECK_THROWS_AS(write_network(network), Failure);
}

TEST_CASE("the embedded network is a sound file") {
  CHECK(read_network(default_network_file()).form == NetworkForm::horizon);
}
