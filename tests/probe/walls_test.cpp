// Walls of a grid: sides, masks and interpolation against closed forms, and their section in files.
#include "sdk/src/probe/probe.h"

#include <cmath>
#include <limits>
#include <vector>

#include "sdk/src/probe/probe_file.h"
#include "tests/catch.h"
#include "tests/probe/probe_sample.h"

using namespace nook;
using namespace nook::probe;

namespace {

// Two probes on the x axis with the light of a constant, 1 and 8, and a wall at x = 1.5.
Probes two_rooms() {
  Probes probes;
  probes.basis = harmonic_basis(1);
  probes.grid = {{2, 1, 1}, {0, 0, 0}, {2, 1, 1}};
  probes.coefficients.assign(8, {});
  probes.coefficients[0] = {1, 1, 1};
  probes.coefficients[4] = {8, 8, 8};
  CellWalls walls;
  walls.plane[0] = {{-1, 0, 0}, 0.75f};
  walls.counts = {0x55, 0xaa, 0x55, 0xaa, 0x55, 0xaa, 0x55, 0xaa};
  probes.walls.cell.push_back(walls);
  return probes;
}

float first_at(const Probes& probes, Vec3 position, Vec3 normal) {
  std::vector<Vec3> b(probes.basis.count);
  interpolate(probes, position, normal, b);
  return b[0].x;
}

nook_result check_result(const Probes& probes) {
  try {
    check_probes(probes, NOOK_ERROR_BAD_FILE);
  } catch (const Failure& failure) {
    return failure.code();
  }
  return NOOK_OK;
}

}  // namespace

TEST_CASE("a wall lets each side see its own probe, right up to it and beyond the grid") {
  Probes probes = two_rooms();
  probes.walls.bias = 0.01f;
  for (const float x : {-5.0f, 0.0f, 1.0f, 1.49f}) CHECK(first_at(probes, {x, 0, 0}, {0, 1, 0}) == 1);
  for (const float x : {1.51f, 2.0f, 7.0f}) CHECK(first_at(probes, {x, 0, 0}, {0, 1, 0}) == 8);
  // On the wall itself the normal tells the side.
  CHECK(first_at(probes, {1.5f, 0, 0}, {-1, 0, 0}) == 1);
  CHECK(first_at(probes, {1.5f, 0, 0}, {1, 0, 0}) == 8);
  // Both lights are mixed in a grid without walls.
  probes.walls.cell.clear();
  CHECK(std::abs(first_at(probes, {1.5f, 0, 0}, {1, 0, 0}) - (0.25f + 0.75f * 8)) < 1e-5f);
}

TEST_CASE("three planes have eight sides") {
  CellWalls walls;
  walls.plane = {WallPlane{{1, 0, 0}, -0.5f}, {{0, 1, 0}, -0.5f}, {{0, 0, 1}, -0.5f}};
  for (std::size_t side = 0; side < 8; ++side)
    CHECK(side_of(walls, {side & 1 ? 0.2f : 0.8f, side & 2 ? 0.2f : 0.8f, side & 4 ? 0.2f : 0.8f}) == side);
  CHECK(side_of(CellWalls{}, {1e30f, -1e30f, 0}) == 0);
  CHECK(side_of(walls, {std::numeric_limits<float>::quiet_NaN(), 1, 1}) == 0);
}

TEST_CASE("probes on one's own side keep their proportions where others have all the weight") {
  // Four probes along y and z at x = 0, hidden ones at x = 1, and a place at the hidden ones.
  Probes probes;
  probes.basis = harmonic_basis(1);
  probes.grid = {{2, 2, 2}, {0, 0, 0}, {1, 1, 1}};
  for (int p = 0; p < 8; ++p)
    for (int k = 0; k < 4; ++k) probes.coefficients.push_back(Vec3{1, 1, 1} * (p & 1 ? 100 : float(p & 6)));
  CellWalls walls;
  walls.counts.fill(0x55);
  probes.walls.cell.push_back(walls);
  // Linear in y with a slope of 2 and in z with one of 4.
  CHECK(std::abs(first_at(probes, {1, 0.25f, 0.5f}, {}) - 2.5f) < 1e-4f);
}

TEST_CASE("an open cell is interpolated as without walls") {
  Probes probes = test::sample_probes(harmonic_basis(2), {2, 3, 2});
  std::vector<Vec3> expected(9), found(9);
  interpolate(probes, {1.1f, 0.3f, 1.7f}, expected);
  probes.walls.cell.resize(probes.grid.cells());
  interpolate(probes, {1.1f, 0.3f, 1.7f}, {0, 0, 1}, found);
  CHECK(found == expected);
}

TEST_CASE("walls come back from their file, and grids without walls have version 1") {
  const Probes probes = test::sample_walls();
  const std::vector<std::byte> file = write_probes(probes, Packing::float32);
  CHECK(Container(file, probe_kind).version() == 2);
  const Probes read = read_probes(file);
  CHECK(read.walls.bias == probes.walls.bias);
  CHECK(std::equal(read.walls.cell.begin(), read.walls.cell.end(), probes.walls.cell.begin(),
                   probes.walls.cell.end()));
  Probes without = probes;
  without.walls.cell.clear();
  CHECK(Container(write_probes(without, Packing::float32), probe_kind).version() == 1);
}

TEST_CASE("walls out of range are refused") {
  const auto changed = [](auto change) {
    Probes probes = test::sample_walls();
    change(probes.walls);
    return check_result(probes);
  };
  CHECK(changed([](GridWalls&) {}) == NOOK_OK);
  CHECK(changed([](GridWalls& w) { w.cell.pop_back(); }) == NOOK_ERROR_BAD_FILE);
  CHECK(changed([](GridWalls& w) { w.bias = -1; }) == NOOK_ERROR_BAD_FILE);
  CHECK(changed([](GridWalls& w) { w.bias = std::numeric_limits<float>::quiet_NaN(); }) ==
        NOOK_ERROR_BAD_FILE);
  CHECK(changed([](GridWalls& w) { w.cell[0].counts[3] = 0; }) == NOOK_ERROR_BAD_FILE);
  CHECK(changed([](GridWalls& w) { w.cell[0].plane[1].offset = 2000; }) == NOOK_ERROR_BAD_FILE);
  CHECK(changed([](GridWalls& w) { w.cell[0].plane[1].normal.y = std::numeric_limits<float>::infinity(); }) ==
        NOOK_ERROR_BAD_FILE);
}
