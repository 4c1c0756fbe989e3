// Loads bytes as a network of the screen-space pass and evaluates what loads: nothing may crash, and AO lies
// in [0, 1], whatever the bytes. The checksum is repaired first, so that the fuzzer reaches what lies behind
// it. Built for libFuzzer with clang; elsewhere network_fuzz_replay.cpp drives it.
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/evaluate.h"
#include "sdk/src/nnao/network_file.h"

namespace {

// A step with sky above it.
struct Picture {
  static constexpr std::uint32_t size = 8;
  std::vector<float> depth;
  std::vector<nook::Vec3> normal;

  Picture() {
    for (std::uint32_t i = 0; i < size * size; ++i) {
      depth.push_back(i / size < 3 ? 2.0f : i / size < 6 ? 2.2f : std::numeric_limits<float>::infinity());
      normal.push_back({0, 0, 1});
    }
  }
  nook::nnao::View view() const { return {size, size, {0.2f, -0.8f, 0.2f, -0.8f, false}, depth, normal}; }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nook;
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = std::byte(data[i]);
  repair_checksum(bytes);
  try {
    const nnao::Network network = nnao::read_network(bytes);
    const Picture picture;
    for (std::uint32_t y = 0; y < Picture::size; y += 3)
      for (std::uint32_t x = 0; x < Picture::size; x += 3) {
        const float ao = nnao::evaluate_pixel(network, picture.view(), {0.7f, 16, 16}, x, y);
        if (!(ao >= 0 && ao <= 1)) std::abort();
      }
  } catch (const Failure&) {
  }
  return 0;
}
