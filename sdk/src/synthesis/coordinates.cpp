#include "sdk/src/synthesis/coordinates.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"

namespace nook::synthesis {
namespace {

// Splits a position, in texels, into a texel index and a fraction. The texels repeat after `size` texels. If
// the position is so large that a float cannot represent its fraction, the result is an arbitrary texel.
struct Place {
  std::uint32_t texel;
  float fraction;
};
Place place_of(float texels, std::uint32_t size) {
  const float whole = std::floor(texels);
  if (!std::isfinite(whole)) return {0, 0};
  const float turn = whole - float(size) * std::floor(whole / float(size));
  return {std::uint32_t(std::clamp(turn, 0.0f, float(size - 1))), texels - whole};
}

}  // namespace

void check_sizes(const Coordinates& coordinates, nook_result code) {
  check_range("the side of the plane in texels", coordinates.side, 1, max_side, code);
  check_range("the width of the material in texels", coordinates.width, 1, max_tile_side, code);
  check_range("the height of the material in texels", coordinates.height, 1, max_tile_side, code);
}

void check_coordinates(const Coordinates& coordinates, nook_result code) {
  check_sizes(coordinates, code);
  const std::size_t texels = std::size_t(coordinates.side) * coordinates.side;
  if (coordinates.cells.size() != texels)
    throw Failure(code, "the plane has the wrong number of texels (got %zu, need %zu)",
                  coordinates.cells.size(), texels);
  for (std::size_t i = 0; i < texels; ++i) {
    const Cell cell = coordinates.cells[i];
    if (cell.x >= coordinates.width || cell.y >= coordinates.height)
      throw Failure(code, "texel %zu of the plane shows (%u, %u), which is outside the material (%u x %u)", i,
                    unsigned(cell.x), unsigned(cell.y), coordinates.width, coordinates.height);
  }
}

Point material_point(const Coordinates& coordinates, Point plane) {
  const Place x = place_of(plane.u * float(coordinates.width), coordinates.side),
              y = place_of(plane.v * float(coordinates.height), coordinates.side);
  const Cell cell = coordinates.cells[std::size_t(y.texel) * coordinates.side + x.texel];
  return {(float(cell.x) + x.fraction) / float(coordinates.width),
          (float(cell.y) + y.fraction) / float(coordinates.height)};
}

std::vector<std::byte> write_coordinates(const Coordinates& coordinates) {
  check_coordinates(coordinates, NOOK_ERROR_INVALID_ARGUMENT);
  ByteWriter head, cells, recipe;
  for (const std::uint32_t size : {coordinates.side, coordinates.width, coordinates.height}) head.u16(size);
  for (const Cell cell : coordinates.cells) {
    cells.u16(cell.x);
    cells.u16(cell.y);
  }
  recipe.text(coordinates.recipe);
  const ContainerSection sections[] = {{four_letters("HEAD"), head.bytes()},
                                       {four_letters("CELL"), cells.bytes()},
                                       {four_letters("RECP"), recipe.bytes()}};
  return write_container(synthesis_kind, sections);
}

Coordinates read_coordinates(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, synthesis_kind);
  Coordinates coordinates(memory);
  ByteReader head = file.section("HEAD"), cells = file.section("CELL"), recipe = file.section("RECP");
  for (std::uint32_t* size : {&coordinates.side, &coordinates.width, &coordinates.height}) *size = head.u16();
  head.check_end();
  check_sizes(coordinates, NOOK_ERROR_BAD_FILE);
  coordinates.cells.resize(cells.check_count(coordinates.side * coordinates.side, 32, "cells"));
  for (Cell& cell : coordinates.cells) {
    cell.x = std::uint16_t(cells.u16());
    cell.y = std::uint16_t(cells.u16());
  }
  cells.check_end();
  coordinates.recipe = recipe.text(recipe.remaining());
  check_coordinates(coordinates, NOOK_ERROR_BAD_FILE);
  return coordinates;
}

}  // namespace nook::synthesis
