// The bits of a value as another type. It stands for bit_cast, which libc++ has from version 14 on.
#pragma once

#include <cstring>
#include <type_traits>

namespace nook {

template <typename To, typename From>
To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
                std::is_trivially_copyable_v<From>);
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

}  // namespace nook
