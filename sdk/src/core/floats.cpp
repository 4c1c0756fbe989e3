#include "sdk/src/core/floats.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nook {
namespace {

// An unsigned integer of 192 bits, lowest word first. The largest number that occurs here is 10 * 2^151,
// which has 155 bits. 2^151 is the scale of subnormal floats.
class Whole {
 public:
  explicit Whole(std::uint32_t value) : words_{value} {}

  void multiply(std::uint32_t factor) {
    std::uint64_t carry = 0;
    for (std::uint32_t& word : words_) {
      carry += std::uint64_t(word) * factor;
      word = std::uint32_t(carry);
      carry >>= 32;
    }
  }

  void double_times(int count) {
    for (; count > 0; --count) multiply(2);
  }

  void add(const Whole& other) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < words_.size(); ++i, carry >>= 32) {
      carry += std::uint64_t(words_[i]) + other.words_[i];
      words_[i] = std::uint32_t(carry);
    }
  }

  // `other` must not be larger than this number.
  void subtract(const Whole& other) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::uint64_t difference = std::uint64_t(words_[i]) - other.words_[i] - borrow;
      words_[i] = std::uint32_t(difference);
      borrow = difference >> 63;
    }
  }

  // Returns a negative value, 0 or a positive value, if this number is less than, equal to or greater than
  // `other`.
  int compare(const Whole& other) const {
    for (std::size_t i = words_.size(); i-- > 0;)
      if (words_[i] != other.words_[i]) return words_[i] < other.words_[i] ? -1 : 1;
    return 0;
  }

 private:
  std::array<std::uint32_t, 6> words_;
};

Whole sum(Whole a, const Whole& b) {
  a.add(b);
  return a;
}

// A positive float as the fraction value / scale. `below` and `above` are half the distances to the next
// smaller and the next larger float, multiplied by the same scale. A decimal number between value - below and
// value + above is read back as this float.
struct Interval {
  Whole value, below, above, scale;
  bool closed;  // true if both ends of the interval are also read back as this float, because a tie is
                // rounded to the even mantissa
};

Interval interval_of(std::uint32_t bits) {
  const std::uint32_t field = bits >> 23, fraction = bits & 0x7fffff;
  const std::uint32_t mantissa = field > 0 ? fraction | 0x800000 : fraction;
  const int exponent = int(field > 0 ? field : 1) - 150;
  // Just below a power of two, the distance between floats is half as large as above it.
  const bool is_uneven = fraction == 0 && field > 1;
  Interval interval{Whole(4 * mantissa), Whole(is_uneven ? 1 : 2), Whole(2), Whole(4), mantissa % 2 == 0};
  for (Whole* number : {&interval.value, &interval.below, &interval.above}) number->double_times(exponent);
  interval.scale.double_times(-exponent);
  return interval;
}

// True if value + above is greater than the scale, or equal to it if the interval is closed.
bool reaches(const Interval& interval) {
  const int order = sum(interval.value, interval.above).compare(interval.scale);
  return order > 0 || (order == 0 && interval.closed);
}

void shift(Interval& interval) {
  for (Whole* number : {&interval.value, &interval.below, &interval.above}) number->multiply(10);
}

// Divides the interval by a power of ten, so that its upper end is in [1/10, 1). Returns the exponent of the
// power.
int normalise(Interval& interval) {
  int power = 0;
  for (; reaches(interval); ++power) interval.scale.multiply(10);
  for (;; --power) {
    Interval larger = interval;
    shift(larger);
    if (reaches(larger)) return power;
    interval = larger;
  }
}

// Removes the next digit from a normalised interval, and returns it. Sets `last` if the digits so far are
// enough: after rounding the last one, they are inside the interval.
int next_digit(Interval& interval, bool& last) {
  shift(interval);
  int digit = 0;
  for (; interval.value.compare(interval.scale) >= 0; ++digit) interval.value.subtract(interval.scale);
  const int down = interval.value.compare(interval.below);
  const bool down_fits = down < 0 || (down == 0 && interval.closed), up_fits = reaches(interval);
  last = down_fits || up_fits;
  const int half = sum(interval.value, interval.value).compare(interval.scale);
  const bool is_nearer_up = half > 0 || (half == 0 && digit % 2 == 1);
  return digit + (up_fits && (is_nearer_up || !down_fits));
}

}  // namespace

// Implements R. G. Burger, R. K. Dybvig, Printing Floating-Point Numbers Quickly and Accurately, PLDI 1996,
// with exact integers. Speed does not matter, because only a few literals are written for the shaders of a
// pass.
FloatLiteral float_literal(float value) {
  FloatLiteral literal{};
  char* out = literal.text;
  const auto bits = bit_cast<std::uint32_t>(value);
  if (bits >> 31) *out++ = '-';
  int power = 1;
  if (bits << 1 == 0) {
    *out++ = '0';
  } else {
    Interval interval = interval_of(bits & 0x7fffffff);
    power = normalise(interval);
    bool last = false;
    for (int count = 0; !last; ++count) {
      if (count == 1) *out++ = '.';
      *out++ = char('0' + next_digit(interval, last));
    }
  }
  const int exponent = power - 1, size = exponent < 0 ? -exponent : exponent;
  *out++ = 'e';
  *out++ = exponent < 0 ? '-' : '+';
  *out++ = char('0' + size / 10);
  *out++ = char('0' + size % 10);
  return literal;
}

}  // namespace nook
