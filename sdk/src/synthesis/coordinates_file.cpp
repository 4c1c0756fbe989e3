#include "sdk/src/synthesis/coordinates_file.h"

namespace nook::synthesis {

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
