// Checks values from a host or a file. Each function throws Failure if the value is invalid. The message
// contains the name of the value, the value itself and the values that are allowed.
#pragma once

#include <nook/nook.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "sdk/src/core/failure.h"

namespace nook {

// Converts a number of any type to text, for a message.
class NumberText {
 public:
  template <std::integral Number>
  explicit NumberText(Number value) noexcept {
    bool is_negative = false;
    if constexpr (std::is_signed_v<Number>) is_negative = value < 0;
    const auto bits = static_cast<std::uint64_t>(value);
    write(is_negative ? "-" : "", is_negative ? 0 - bits : bits);
  }
  // Formats the value with six digits.
  explicit NumberText(double value) noexcept;

  const char* get() const noexcept { return text_; }

 private:
  void write(const char* sign, std::uint64_t magnitude) noexcept;

  char text_[24];
};

template <class Number>
concept CheckedNumber = std::integral<Number> || std::floating_point<Number>;

// Throws Failure with the text "NAME is out of range (got GOT, need NEED)".
[[noreturn]] void fail_range(nook_result code, const char* name, const NumberText& got, const char* need);
[[noreturn]] void fail_range(nook_result code, const char* name, const NumberText& got, const NumberText& low,
                             const NumberText& high);
// Throws Failure with the text "NAME is unknown (got GOT, need 0 to LAST)".
[[noreturn]] void fail_unknown(const char* name, std::int32_t got, std::int32_t last);

// Throws unless `fits` is true. `need` is a text for the message that says which values are allowed, such as
// "0 or more". Floats must also be finite.
template <CheckedNumber Number>
void check_fits(const char* name, Number value, bool fits, const char* need,
                nook_result code = NOOK_ERROR_INVALID_ARGUMENT) {
  // The difference of a number and itself is 0 only if the number is finite.
  if (!fits || !(value - value == 0)) fail_range(code, name, NumberText(value), need);
}

// Throws unless the value is in [low, high].
template <CheckedNumber Number>
void check_range(const char* name, Number value, std::type_identity_t<Number> low,
                 std::type_identity_t<Number> high, nook_result code = NOOK_ERROR_INVALID_ARGUMENT) {
  // The comparison is false for NaN.
  if (!(value >= low && value <= high))
    fail_range(code, name, NumberText(value), NumberText(low), NumberText(high));
}

// Throws unless the index is below `count`.
void check_index(const char* name, std::size_t index, std::size_t count);

void check_at_most(const char* name, std::uint32_t value, std::uint32_t most);

// Returns the distance in bytes between consecutive elements of the caller's array: `stride`, or
// element_bytes if `stride` is 0. Throws INVALID_ARGUMENT if elements overlap, or if `count` elements at this
// distance do not fit into an address space. `name` is the name of the stride, for the message.
std::size_t checked_stride(const char* name, std::size_t stride, std::size_t count,
                           std::size_t element_bytes);

// Checks the size of a tightly packed array in the same way. `name` is the name of the count, for the
// message.
void check_array(const char* name, std::size_t count, std::size_t element_bytes);

// Checks a switch, which must be 0 or 1.
void check_switch(const char* name, std::int32_t value);

// Checks an enumerator, which must be from 0 to `last`.
inline void check_known(const char* name, std::int32_t value, std::int32_t last) {
  if (value < 0 || value > last) fail_unknown(name, value, last);
}

}  // namespace nook
