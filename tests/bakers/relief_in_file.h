// The relief of a material's file, by the format of files alone: libraries and the tool do not hand it out.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

struct ReliefInFile {
  float low = 0, high = 0;           // tiles; both 0 where the file has none
  std::vector<std::uint8_t> levels;  // y * width + x, from low to high; empty of a plane

  bool moves() const { return low != 0 || high != 0; }
};

// Bytes: a container of char, the file.
template <class Bytes>
ReliefInFile relief_in_file(const Bytes& file) {
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t(std::uint8_t(file[at + i])) << 8 * i;
    return value;
  };
  constexpr std::size_t count_at = 32, head_size = 40, entry_size = 24;
  ReliefInFile relief;
  for (std::size_t entry = head_size; entry < head_size + entry_size * number(count_at);
       entry += entry_size) {
    if (std::memcmp(&file[entry], "RELF", 4) != 0) continue;
    const std::size_t first = number(entry + 8), last = first + number(entry + 16);
    relief.low = std::bit_cast<float>(number(first + 1));
    relief.high = std::bit_cast<float>(number(first + 5));
    for (std::size_t at = first + 13; at < last; ++at) relief.levels.push_back(std::uint8_t(file[at]));
  }
  return relief;
}
