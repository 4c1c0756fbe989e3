#include "sdk/src/material/signed_blocks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "sdk/src/core/failure.h"
#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/material/tables.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"

using namespace nook::material;

namespace {

using Bytes = std::uint8_t[signed_block_bytes];

// The signed RGTC of the OpenGL 3.3 specification, section 3.9, where the first end is above the other.
double rgtc_reference(const Bytes& bytes, std::uint32_t texel) {
  std::uint64_t bits = 0;
  for (int i = 7; i >= 2; --i) bits = bits * 256 + bytes[i];
  const unsigned code = unsigned(bits >> 3 * texel) & 7;
  const double red_0 = double(std::int8_t(bytes[0])) / 127, red_1 = double(std::int8_t(bytes[1])) / 127;
  if (code == 0) return red_0;
  if (code == 1) return red_1;
  return ((8.0 - code) * red_0 + (code - 1.0) * red_1) / 7;
}

// The signed R11 EAC of the OpenGL ES 3.0 specification, section C.1.7, with one row of its table of
// modifiers, 13: its texels are counted down the columns.
double eac_reference_of_table_13(const Bytes& bytes, std::uint32_t column, std::uint32_t row) {
  constexpr int modifiers[8] = {-1, -2, -3, -10, 0, 1, 2, 9};
  REQUIRE((bytes[1] & 15) == 13);
  const std::uint32_t bit = 47 - 3 * (4 * column + row);  // of the highest of three, of 63 to 0
  int code = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t at = bit - i;
    code = 2 * code + (bytes[7 - at / 8] >> at % 8 & 1);
  }
  const int multiplier = bytes[1] >> 4, base = std::int8_t(bytes[0]);
  const int value =
      multiplier == 0 ? 8 * base + modifiers[code] : 8 * base + 8 * multiplier * modifiers[code];
  return std::clamp(value, -1023, 1023) / 1023.0;
}

struct Numbers16 {
  float at[16];
};

Numbers16 smooth_numbers(test::Numbers& random) {
  const float range = std::exp2(random.between(-7, 0)), middle = random.between(range - 1, 1 - range);
  const float slope_x = random.between(-1, 1), slope_y = random.between(-1, 1);
  Numbers16 out;
  for (int i = 0; i < 16; ++i) {
    const float x = float(i % 4) / 1.5f - 1, y = float(i / 4) / 1.5f - 1;
    out.at[i] =
        middle + range * std::clamp(slope_x * x + slope_y * y + random.between(-0.5f, 0.5f), -1.0f, 1.0f);
  }
  return out;
}

double squared_error(BlockForm form, const Numbers16& numbers, const Bytes& bytes) {
  double sum = 0;
  for (std::uint32_t i = 0; i < 16; ++i)
    sum += std::pow(double(decode_texel(form, bytes, i)) - double(numbers.at[i]), 2);
  return sum;
}

// The smallest squared error of eight levels that are multiples of 1 / 127, of all of these.
double best_error_of_levels(const Numbers16& numbers) {
  double best = std::numeric_limits<double>::max();
  for (int step = 1; step <= 36; ++step)
    for (int lowest = -127; lowest + 7 * step <= 127; ++lowest) {
      double sum = 0;
      for (const float number : numbers.at) {
        const double value = 127 * double(number),
                     level = lowest + step * std::clamp(std::round((value - lowest) / step), 0.0, 7.0);
        sum += (level - value) * (level - value) / (127.0 * 127.0);
      }
      best = std::min(best, sum);
    }
  return best;
}

}  // namespace

TEST_CASE("a block of RGTC decodes as the specification says, to multiples of 1 / 127") {
  test::Numbers random(3);
  for (int block = 0; block < 200; ++block) {
    const Numbers16 numbers = smooth_numbers(random);
    Bytes bytes;
    encode_block(BlockForm::rgtc, numbers.at, bytes);
    REQUIRE(std::int8_t(bytes[0]) > std::int8_t(bytes[1]));
    for (std::uint32_t i = 0; i < 16; ++i) {
      const double value = rgtc_reference(bytes, i);
      // A float's rounding.
      CHECK(std::abs(double(decode_texel(BlockForm::rgtc, bytes, i)) - value) < 1e-6);
      CHECK(std::abs(127 * value - std::round(127 * value)) < 1e-9);
    }
    const RgtcBlock read = read_rgtc(bytes);
    Bytes again;
    write_rgtc(read, again);
    CHECK(std::equal(std::begin(bytes), std::end(bytes), std::begin(again)));
  }
}

TEST_CASE("the encoder of RGTC is close to the best of all levels") {
  test::Numbers random(5);
  double got = 0, best = 0;
  for (int block = 0; block < 60; ++block) {
    const Numbers16 numbers = smooth_numbers(random);
    Bytes bytes;
    encode_block(BlockForm::rgtc, numbers.at, bytes);
    const double error = squared_error(BlockForm::rgtc, numbers, bytes),
                 smallest = best_error_of_levels(numbers);
    CHECK(error > smallest * (1 - 1e-5));  // floats against doubles
    got += error;
    best += smallest;
  }
  // Steps below three quarters of the range, and levels off the quarters of a step, are not tried: 3 % over
  // many blocks.
  CHECK(got < 1.1 * best);
}

TEST_CASE("a block of EAC decodes as the specification says") {
  for (const int multiplier : {0, 1, 7, 15})
    for (const int base : {-127, -3, 0, 90, 127}) {
      Bytes bytes = {
          std::uint8_t(base), std::uint8_t(multiplier << 4 | 13), 0x05, 0x39, 0x77, 0xc2, 0x9d, 0xa6};
      for (std::uint32_t i = 0; i < 16; ++i)
        CHECK(std::abs(double(decode_texel(BlockForm::eac, bytes, i)) -
                       eac_reference_of_table_13(bytes, i % 4, i / 4)) < 1e-6);
    }
}

TEST_CASE("both forms of blocks lose as much as eight levels over the range of numbers") {
  test::Numbers random(7);
  for (const BlockForm form : {BlockForm::rgtc, BlockForm::eac}) {
    double squares = 0, bound = 0;
    for (int block = 0; block < 300; ++block) {
      const Numbers16 numbers = smooth_numbers(random);
      Bytes bytes;
      encode_block(form, numbers.at, bytes);
      squares += squared_error(form, numbers, bytes);
      const auto [low, high] = std::minmax_element(std::begin(numbers.at), std::end(numbers.at));
      // The variance of rounding to steps of a seventh of the range, at least of 1 / 127.
      const double step = std::max(double(*high - *low) / 7, 1.0 / 127);
      bound += 16 * step * step / 12;
    }
    CHECK(squares < bound);
  }
}

TEST_CASE("ends of the range and equal numbers come back from blocks") {
  for (const BlockForm form : {BlockForm::rgtc, BlockForm::eac})
    for (const float number : {-1.0f, -0.3f, 0.0f, 1.0f / 127, 0.77f, 1.0f}) {
      Numbers16 numbers;
      std::fill(std::begin(numbers.at), std::end(numbers.at), number);
      Bytes bytes;
      encode_block(form, numbers.at, bytes);
      for (std::uint32_t i = 0; i < 16; ++i)
        CHECK(std::abs(decode_texel(form, bytes, i) - number) <= 0.5f / 127 + 1e-6f);
    }
}

TEST_CASE("modes in blocks have the bytes of their blocks, and of the integers beside them") {
  for (const test::SampleSize& size :
       {test::SampleSize{.width = 16, .height = 8, .rank_light = 8, .bits = 8},
        test::SampleSize{.width = 7, .height = 5, .rank_light = 6, .rank_view = 5, .bits = 16},
        test::SampleSize{.width = 1, .height = 1, .rank_x = 1, .rank_y = 1}}) {
    const Material material = test::sample_material(4, size);
    for (const std::uint32_t whole : {0u, 4u, 100u}) {
      const MaterialTables tables =
          make_tables(material, {}, nook::default_memory(), default_map_side, {BlockForm::rgtc, whole});
      const std::uint32_t modes = 4 * vec4_count(size.rank_light), packed = modes - std::min(whole, modes);
      CHECK(tables.btf.packed_modes == packed);
      std::size_t blocks = 0;
      for (std::uint32_t level = 0; level < tables.btf.levels; ++level)
        blocks +=
            std::size_t((level_size(size.width, level) + 3) / 4) * ((level_size(size.height, level) + 3) / 4);
      CHECK(tables.btf.blocks.size() == blocks * 8 * 4 * size.clusters * vec4_count(size.rank_view) * packed);
      CHECK(tables.votf.packed_modes == 1);
      CHECK(tables.votf.spatial_8.empty());
      CHECK(tables.btf.spatial.empty());
      CHECK(tables.light.empty());
    }
  }
}

TEST_CASE("blocks of a single texel that take more than 1 GiB are refused before memory is taken") {
  // The file format allows 2^29 numbers, which are 4 GiB of blocks: 16 bytes for each pair of numbers. The
  // arrays are left out, so that whoever reads them before the refusal crashes.
  Material material;
  material.btf.shape = {.views = 1024,
                        .width = 1,
                        .height = 1,
                        .rank_light = 1024,
                        .rank_view = 512,
                        .rank_x = 1,
                        .rank_y = 1,
                        .clusters = 1024,
                        .mixture = 1};
  CHECK_NOTHROW(check_shape(material.btf.shape, 1024, 1024, "BTF", NOOK_ERROR_BAD_FILE));
  std::string message;
  try {
    make_tables(material, {}, nook::default_memory(), default_map_side, {BlockForm::rgtc, 0});
  } catch (const nook::Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
    message = failure.what();
  }
  CHECK(message.find("got 4294967296, need at most 1073741824") != std::string::npos);
  // A layer of a single texel is a block of 16 bytes.
  const std::uint32_t most = std::uint32_t(max_block_bytes / BlockSize::block_bytes);
  CHECK_NOTHROW(check_block_bytes({1, 1, most, 1}));
  CHECK_THROWS_AS(check_block_bytes({1, 1, most + 2, 1}), nook::Failure);
  // As many numbers of the largest texels, with all of their levels.
  CHECK_NOTHROW(check_block_bytes({1024, 1024, 256, 11}));
}

TEST_CASE("modes in blocks decode to what integers do, up to the rounding of blocks") {
  for (const BlockForm form : {BlockForm::rgtc, BlockForm::eac}) {
    const Material material =
        test::sample_material(6, {.width = 13, .height = 10, .rank_light = 8, .rank_view = 5, .bits = 8});
    const auto tables_of = [&](const ModeForm& modes) {
      return make_tables(material, {}, nook::default_memory(), 16, modes);
    };
    const MaterialTables integers = tables_of({}), whole = tables_of({form, 8}),
                         packed = tables_of({form, 4});
    test::Numbers random(8);
    double square[2] = {}, difference[2] = {};
    for (int i = 0; i < 200; ++i) {
      const Sample sample{random.between(-1, 2),
                          random.between(-1, 2),
                          random.between(0, 4),
                          nook::normalised({random.between(-1, 1), random.between(-1, 1), 0.5f}),
                          {}};
      float wanted[8], same[8], got[8];
      decode_modes(integers, sample, wanted);
      decode_modes(whole, sample, same);
      decode_modes(packed, sample, got);
      for (int a = 0; a < 8; ++a) {
        CHECK(same[a] == wanted[a]);
        square[a / 4] += double(wanted[a]) * double(wanted[a]);
        difference[a / 4] += std::pow(double(got[a]) - double(wanted[a]), 2);
      }
    }
    CHECK(difference[0] == 0);
    // Texels are random, so that a block of eight levels rounds by up to a 14th of the range of numbers.
    CHECK(difference[1] > 0);
    CHECK(difference[1] < 0.01 * square[1]);
  }
}

TEST_CASE("beside modes in blocks, the light map has the basis of each light") {
  // A basis as smooth as a material's basis.
  Material material = test::sample_material(9, {.lights = 40, .rank_light = 6, .bits = 8});
  for (std::size_t light = 0; light < material.lights.size(); ++light)
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const auto [x, y, z] = material.lights[light];
      const float columns[6] = {z, x * z, y * z, x * y * z, x * x * z - y * y * z, z * z * z};
      for (std::size_t a = 0; a < 6; ++a)
        material.light_basis[(3 * light + channel) * 6 + a] = columns[a] * (0.5f + 0.2f * float(channel));
    }
  const auto worst_of = [&](const MaterialTables& tables) {
    double worst = 0;
    for (std::size_t a = 0; a < 6; ++a) {
      // The map's column is the basis times a scale, which the least squares over all lights find.
      std::vector<double> got, wanted;
      for (std::size_t light = 0; light < material.lights.size(); ++light) {
        float basis[24];
        light_basis_at(tables, material.lights[light], basis);
        for (std::size_t channel = 0; channel < 3; ++channel) {
          got.push_back(double(basis[8 * channel + a]));
          wanted.push_back(double(material.light_basis[(3 * light + channel) * 6 + a]));
        }
      }
      double product = 0, square = 0, largest = 0;
      for (std::size_t i = 0; i < got.size(); ++i) {
        product += got[i] * wanted[i];
        square += wanted[i] * wanted[i];
        largest = std::max(largest, std::abs(got[i]));
      }
      for (std::size_t i = 0; i < got.size(); ++i)
        worst = std::max(worst, std::abs(got[i] - product / square * wanted[i]) / largest);
    }
    return worst;
  };
  const MaterialTables packed = make_tables(material, {}, nook::default_memory(), 16, {BlockForm::rgtc, 4});
  const MaterialTables plain = make_tables(material, {}, nook::default_memory(), 16);
  CHECK(packed.light_side == 32);
  CHECK(plain.light_side == 64);
  // Half a step of signed bytes, twice, and what lies above the largest number of the larger map.
  CHECK(worst_of(packed) < 0.03);
  CHECK(worst_of(plain) > worst_of(packed));
}
