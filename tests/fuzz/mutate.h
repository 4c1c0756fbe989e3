// What the replays do to a sound file: cut it, or change a few random bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nook::test {

// numbers.below(n) is a random number below n.
template <class Numbers>
void mutate(std::vector<std::byte>& file, Numbers& numbers) {
  for (std::uint32_t change = numbers.below(6) + 1; change > 0 && !file.empty(); --change) {
    const std::uint32_t at = numbers.below(static_cast<std::uint32_t>(file.size()));
    if (numbers.below(10) == 0)
      file.resize(at);  // cut
    else
      file[at] = std::byte(numbers.below(3) ? numbers.below(256) : numbers.below(2) * 255);
    // The size in the head follows, or nearly every change would end there.
    if (file.size() >= 24)
      for (std::size_t i = 0; i < 8; ++i) file[16 + i] = std::byte(file.size() >> (8 * i) & 255);
  }
}

}  // namespace nook::test
