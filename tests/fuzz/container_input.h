// The input of a fuzz target of a .nook file: the file, and behind it a script, bytes that choose what is
// done with what was loaded. The file ends by the size in its head, so that a plain .nook file is an
// input with an empty script.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"

namespace nook::test {

// Aborts, which every fuzzer takes for a finding.
inline void require(bool sound) {
  if (!sound) std::abort();
}

// Reads choices; behind the last byte all of them are 0.
class Script {
 public:
  explicit Script(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::uint32_t byte() { return at_end() ? 0 : bytes_[at_++]; }
  std::uint32_t below(std::uint32_t count) { return count ? byte() % count : 0; }
  std::uint32_t word() {
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += 8) value |= byte() << shift;
    return value;
  }

  // One byte chooses among the numbers that matter, those between -3.5 and 4, and any four bytes.
  float number() {
    using Limits = std::numeric_limits<float>;
    constexpr std::array special{0.0f,
                                 1.0f,
                                 -1.0f,
                                 0.5f,
                                 10.0f,
                                 1e-3f,
                                 -1e3f,
                                 1e6f,
                                 1e18f,
                                 -1e30f,
                                 Limits::max(),
                                 Limits::min(),
                                 Limits::denorm_min(),
                                 Limits::infinity(),
                                 -Limits::infinity(),
                                 Limits::quiet_NaN()};
    const std::uint32_t choice = byte();
    if (choice < special.size()) return special[choice];
    if (choice < 250) return (float(choice) - 128) / 32;
    return std::bit_cast<float>(word());
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

// Where the file of an input ends: the size in its head if that fits, else the input's end.
inline std::size_t file_size_of(std::span<const std::uint8_t> input) {
  constexpr std::size_t head_size = 40, size_at = 16;
  if (input.size() < head_size) return input.size();
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < 8; ++i) size |= std::uint64_t(input[size_at + i]) << (8 * i);
  return size >= head_size && size <= input.size() ? std::size_t(size) : input.size();
}

struct ContainerInput {
  std::vector<std::byte> file;  // with the right checksum, so that the reader goes on behind it
  Script script;
};

inline ContainerInput split_input(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  const std::size_t file_size = file_size_of(input);
  ContainerInput split{std::vector<std::byte>(file_size), Script(input.subspan(file_size))};
  std::transform(data, data + file_size, split.file.begin(), [](std::uint8_t b) { return std::byte(b); });
  repair_checksum(split.file);
  return split;
}

}  // namespace nook::test
