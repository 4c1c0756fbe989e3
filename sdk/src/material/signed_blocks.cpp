#include "sdk/src/material/signed_blocks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace nook::material {
namespace {

std::uint64_t big_endian(const std::uint8_t* bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < signed_block_bytes; ++i) value = value << 8 | bytes[i];
  return value;
}

std::uint64_t rgtc_codes(const std::uint8_t* bytes) {
  std::uint64_t codes = 0;
  for (int i = 0; i < 6; ++i) codes |= std::uint64_t(bytes[2 + i]) << (8 * i);
  return codes;
}

// The eight levels of an RGTC block are lowest + k step, in units of 1 / 127.
struct Levels {
  int lowest = 0, step = 1;
};

int nearest_level(float number, const Levels& levels) {
  return int(std::clamp(std::floor((number - float(levels.lowest)) / float(levels.step) + 0.5f), 0.0f, 7.0f));
}

float error_of(const float (&numbers)[16], const Levels& levels) {
  const float inverse = 1 / float(levels.step);
  float sum = 0;
  for (const float number : numbers) {
    const float place = std::floor((number - float(levels.lowest)) * inverse + 0.5f);
    const float away = float(levels.lowest) + std::clamp(place, 0.0f, 7.0f) * float(levels.step) - number;
    sum += away * away;
  }
  return sum;
}

// Tries several steps. The eight levels of the largest step span the full range of the values, and the levels
// of the smallest step span three quarters of it. For each step, it tries lowest levels that are a quarter of
// a step apart. Finally, it tries the neighbours of the best combination.
Levels best_levels(const float (&numbers)[16]) {
  const auto [low, high] = std::minmax_element(std::begin(numbers), std::end(numbers));
  const int most = 2 * signed_block_steps / 7;
  const int widest = std::clamp(int(std::ceil((*high - *low) / 7)), 1, most);
  Levels best;
  float smallest = std::numeric_limits<float>::max();
  const auto attempt = [&](int lowest, int step) {
    const Levels levels{std::clamp(lowest, -signed_block_steps, signed_block_steps - 7 * step), step};
    const float error = error_of(numbers, levels);
    if (error < smallest) {
      smallest = error;
      best = levels;
    }
  };
  for (int step = std::max(widest - std::max(widest / 4, 1), 1); step <= widest; ++step) {
    const float other = *high - 7 * float(step), half = 0.5f * float(step);
    const int first = int(std::floor(std::min(*low, other) - half)),
              last = int(std::ceil(std::max(*low, other) + half));
    for (int lowest = first; lowest <= last; lowest += std::max(step / 4, 1)) attempt(lowest, step);
  }
  const Levels found = best;
  for (int away = 1; away < std::max(found.step / 4, 1); ++away) {
    attempt(found.lowest - away, found.step);
    attempt(found.lowest + away, found.step);
  }
  return best;
}

void encode_rgtc(const float (&given)[16], std::uint8_t* bytes) {
  float numbers[16];
  for (int i = 0; i < 16; ++i) numbers[i] = std::clamp(given[i], -1.0f, 1.0f) * signed_block_steps;
  const Levels levels = best_levels(numbers);
  RgtcBlock block;
  block.lower = std::int8_t(levels.lowest);
  block.upper = std::int8_t(levels.lowest + 7 * levels.step);
  for (int i = 0; i < 16; ++i) block.code[i] = code_of(7 - nearest_level(numbers[i], levels));
  write_rgtc(block, bytes);
}

// The modifiers of EAC, from table C.12 of OpenGL ES 3.0. In units of 1 / 1023, a value is 8 base + 8
// multiplier modifier, or 8 base + modifier if the multiplier is 0.
constexpr std::int8_t modifiers[16][8] = {
    {-3, -6, -9, -15, 2, 5, 8, 14}, {-3, -7, -10, -13, 2, 6, 9, 12}, {-2, -5, -8, -13, 1, 4, 7, 12},
    {-2, -4, -6, -13, 1, 3, 5, 12}, {-3, -6, -8, -12, 2, 5, 7, 11},  {-3, -7, -9, -11, 2, 6, 8, 10},
    {-4, -7, -8, -11, 3, 6, 7, 10}, {-3, -5, -8, -11, 2, 4, 7, 10},  {-2, -6, -8, -10, 1, 5, 7, 9},
    {-2, -5, -8, -10, 1, 4, 7, 9},  {-2, -4, -8, -10, 1, 3, 7, 9},   {-2, -5, -7, -10, 1, 4, 6, 9},
    {-3, -4, -7, -10, 2, 3, 6, 9},  {-1, -2, -3, -10, 0, 1, 2, 9},   {-4, -6, -8, -9, 3, 5, 7, 8},
    {-3, -5, -7, -9, 2, 4, 6, 8}};
constexpr int eac_steps = 1023;

struct EacHead {
  int base = 0, multiplier = 0, table = 0;

  int level(std::uint32_t code) const {
    const int modifier = modifiers[table][code];
    const int value = 8 * base + (multiplier == 0 ? modifier : 8 * multiplier * modifier);
    return std::clamp(value, -eac_steps, eac_steps);
  }
};

float error_of(const float (&numbers)[16], const EacHead& head) {
  float nearest[16];
  std::fill(std::begin(nearest), std::end(nearest), float(4 * eac_steps));
  for (std::uint32_t code = 0; code < 8; ++code) {
    const auto level = float(head.level(code));
    for (int i = 0; i < 16; ++i) nearest[i] = std::min(nearest[i], std::abs(numbers[i] - level));
  }
  float sum = 0;
  for (const float away : nearest) sum += away * away;
  return sum;
}

// Tries all modifier tables, each with two multipliers: the multiplier for which the table spans the range of
// the values, and the next smaller one. For each, tries several bases around the base that aligns the centre
// of the table with the centre of the values.
EacHead best_head(const float (&numbers)[16]) {
  const auto [low, high] = std::minmax_element(std::begin(numbers), std::end(numbers));
  EacHead best;
  float smallest = std::numeric_limits<float>::max();
  for (int table = 0; table < 16; ++table) {
    const int lowest = modifiers[table][3], highest = modifiers[table][7];
    const int widest = std::clamp(int(std::ceil((*high - *low) / float(8 * (highest - lowest)))), 0, 15);
    for (int multiplier = std::max(widest - 1, 0); multiplier <= widest; ++multiplier) {
      const float step = multiplier == 0 ? 1 : float(8 * multiplier);
      const float middle = 0.5f * (*low + *high - step * float(lowest + highest));
      for (int away = -1; away <= 1; ++away) {
        const int base = std::clamp(int(std::floor(middle / 8 + 0.5f)) + away, -127, 127);
        const EacHead head{base, multiplier, table};
        const float error = error_of(numbers, head);
        if (error >= smallest) continue;
        smallest = error;
        best = head;
      }
    }
  }
  return best;
}

// EAC stores codes column by column, with the first code in the highest bits.
constexpr std::uint32_t eac_shift(std::uint32_t texel) {
  return 3 * (15 - (texel % 4 * 4 + texel / 4));
}

void encode_eac(const float (&given)[16], std::uint8_t* bytes) {
  float numbers[16];
  for (int i = 0; i < 16; ++i) numbers[i] = std::clamp(given[i], -1.0f, 1.0f) * eac_steps;
  const EacHead head = best_head(numbers);
  std::uint64_t value = std::uint64_t(std::uint8_t(head.base)) << 56 | std::uint64_t(head.multiplier) << 52 |
                        std::uint64_t(head.table) << 48;
  for (std::uint32_t i = 0; i < 16; ++i) {
    std::uint32_t nearest = 0;
    const auto away = [&](std::uint32_t code) { return std::abs(numbers[i] - float(head.level(code))); };
    for (std::uint32_t code = 1; code < 8; ++code)
      if (away(code) < away(nearest)) nearest = code;
    value |= std::uint64_t(nearest) << eac_shift(i);
  }
  for (std::size_t i = 0; i < signed_block_bytes; ++i) bytes[i] = std::uint8_t(value >> (56 - 8 * i));
}

float decode_rgtc_texel(const std::uint8_t* bytes, std::uint32_t texel) {
  const int upper = std::int8_t(bytes[0]), lower = std::int8_t(bytes[1]);
  const int down = sevenths_of(std::uint32_t(rgtc_codes(bytes) >> (3 * texel) & 7));
  return float(upper * (7 - down) + lower * down) / float(7 * signed_block_steps);
}

float decode_eac_texel(const std::uint8_t* bytes, std::uint32_t texel) {
  const std::uint64_t value = big_endian(bytes);
  const EacHead head{std::int8_t(bytes[0]), bytes[1] >> 4, bytes[1] & 15};
  return float(head.level(std::uint32_t(value >> eac_shift(texel) & 7))) / float(eac_steps);
}

}  // namespace

void write_rgtc(const RgtcBlock& block, std::uint8_t* bytes) {
  bytes[0] = std::uint8_t(block.upper);
  bytes[1] = std::uint8_t(block.lower);
  std::uint64_t codes = 0;
  for (int i = 0; i < 16; ++i) codes |= std::uint64_t(block.code[i]) << (3 * i);
  for (int i = 0; i < 6; ++i) bytes[2 + i] = std::uint8_t(codes >> (8 * i));
}

RgtcBlock read_rgtc(const std::uint8_t* bytes) {
  RgtcBlock block;
  block.upper = std::int8_t(bytes[0]);
  block.lower = std::int8_t(bytes[1]);
  const std::uint64_t codes = rgtc_codes(bytes);
  for (int i = 0; i < 16; ++i) block.code[i] = std::uint8_t(codes >> (3 * i) & 7);
  return block;
}

void encode_block(BlockForm form, const float (&numbers)[16], std::uint8_t* bytes) {
  form == BlockForm::rgtc ? encode_rgtc(numbers, bytes) : encode_eac(numbers, bytes);
}

float decode_texel(BlockForm form, const std::uint8_t* bytes, std::uint32_t texel) {
  return form == BlockForm::rgtc ? decode_rgtc_texel(bytes, texel) : decode_eac_texel(bytes, texel);
}

}  // namespace nook::material
