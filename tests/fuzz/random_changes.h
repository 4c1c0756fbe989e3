// Inputs with a few random bytes changed, or cut, for fuzz targets without libFuzzer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nook::test {

// below(n): a random number from 0 to n - 1. is_container: the size in the head of a .nook file follows, or
// nearly every change would end there.
template <class Below>
void change_bytes(std::vector<std::byte>& file, bool is_container, const Below& below) {
  for (std::uint32_t change = below(6) + 1; change > 0; --change) {
    // Half of the changes meet the section table and the heads.
    const std::size_t reach = below(2) ? file.size() : file.size() / 8 + 1;
    const std::uint32_t at = below(static_cast<std::uint32_t>(reach));
    if (below(10) == 0)
      file.resize(at);  // cut
    else
      file[at] = std::byte(below(3) ? below(256) : below(2) * 255);
    if (file.empty()) break;
    if (is_container && file.size() >= 24)
      for (std::size_t i = 0; i < 8; ++i) file[16 + i] = std::byte(file.size() >> (8 * i) & 255);
  }
}

}  // namespace nook::test
