// Coordinate textures: the point that they show, files, and bytes that a bake would not write.
#include "sdk/src/synthesis/coordinates.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/synthesis/coordinates_sample.h"

using namespace nook;
using namespace nook::synthesis;

namespace {

nook_result result_of(std::span<const std::byte> bytes) {
  try {
    read_coordinates(bytes);
    return NOOK_OK;
  } catch (const Failure& failure) {
    return failure.code();
  }
}

// Coordinates that show the material as it tiles: the texel of the plane modulo the material's size.
Coordinates tiled(std::uint32_t side, std::uint32_t width, std::uint32_t height) {
  Coordinates out;
  out.side = side;
  out.width = width;
  out.height = height;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      out.cells.push_back({std::uint16_t(x % width), std::uint16_t(y % height)});
  return out;
}

}  // namespace

TEST_CASE("coordinates that tile show the point that the plane has") {
  const Coordinates coordinates = tiled(16, 8, 4);
  for (const Point p :
       {Point{0, 0}, Point{0.3f, 0.9f}, Point{1.99f, 3.5f}, Point{-0.01f, -2.6f}, Point{1e6f, 0.25f}}) {
    const Point at = material_point(coordinates, p);
    // Both are multiples of a tile apart; 1e6 tiles leave floats a step of 1/16.
    CHECK(at.u == Approx(p.u - std::floor(p.u)).margin(1e-4));
    CHECK(at.v == Approx(p.v - std::floor(p.v)).margin(1e-4));
  }
}

TEST_CASE("a point of the plane shows its texel's cell, and moves through the material within it") {
  const Coordinates coordinates = synthesis::test::sample_coordinates(8, 6, 4);
  // Texel (3, 5) of the plane, also after one and minus two periods of 8 texels.
  for (const float turn : {0.0f, 8.0f, -16.0f}) {
    const Point at = material_point(coordinates, {(3.25f + turn) / 6, (5.75f + turn) / 4});
    const Cell cell = coordinates.cells[5 * 8 + 3];
    CHECK(at.u == Approx((cell.x + 0.25f) / 6).margin(1e-5));
    CHECK(at.v == Approx((cell.y + 0.75f) / 4).margin(1e-5));
  }
}

TEST_CASE("a file gives back what was written") {
  const Coordinates made = synthesis::test::sample_coordinates();
  const Coordinates read = read_coordinates(write_coordinates(made));
  CHECK(read.side == made.side);
  CHECK(read.width == made.width);
  CHECK(read.height == made.height);
  CHECK(read.cells == made.cells);
  CHECK(read.recipe == made.recipe);
}

TEST_CASE("truncated files are refused") {
  const std::vector<std::byte> bytes = write_coordinates(synthesis::test::sample_coordinates());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK(result_of(std::span(bytes).first(size)) == NOOK_ERROR_BAD_FILE);
}

TEST_CASE("flipped bytes with a repaired checksum are refused or harmless") {
  const std::vector<std::byte> bytes = write_coordinates(synthesis::test::sample_coordinates());
  std::size_t refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const unsigned flip : {1u, 0x80u, 0xffu}) {
      std::vector<std::byte> changed = bytes;
      changed[i] ^= std::byte(flip);
      repair_checksum(changed);
      const nook_result result = result_of(changed);
      CHECK((result == NOOK_OK || result == NOOK_ERROR_BAD_FILE || result == NOOK_ERROR_FILE_VERSION));
      refused += result != NOOK_OK;
    }
  // The head and the tables, and two of three flips of each of the 64 cells' four bytes.
  CHECK(refused > 400);
}

TEST_CASE("numbers out of range are not written") {
  Coordinates coordinates = synthesis::test::sample_coordinates();
  coordinates.cells[3].x = 6;
  CHECK_THROWS_AS(write_coordinates(coordinates), Failure);
  coordinates = synthesis::test::sample_coordinates();
  coordinates.cells.pop_back();
  CHECK_THROWS_AS(write_coordinates(coordinates), Failure);
  coordinates = synthesis::test::sample_coordinates();
  coordinates.side = max_side + 1;
  CHECK_THROWS_AS(write_coordinates(coordinates), Failure);
}
