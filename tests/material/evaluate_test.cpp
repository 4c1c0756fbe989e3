#include "sdk/src/material/reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "sdk/src/material/direction_mesh.h"
#include "sdk/src/material/view_cells.h"
#include "tests/catch.h"
#include "tests/material/equation.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::material;

namespace {

constexpr std::uint32_t side = 16;  // of view maps that the tables make

MaterialTables tables_of(const Material& material, const Parallel& parallel = {}) {
  return make_tables(material, parallel, nook::default_memory(), side);
}

// A host's jobs: every index on a thread of its own.
void on_threads(void*, std::uint32_t count, void (*run)(void*, std::uint32_t), void* user) {
  std::vector<std::thread> threads;
  for (std::uint32_t i = 0; i < count; ++i) threads.emplace_back(run, user, i);
  for (std::thread& thread : threads) thread.join();
}

struct Weighted {
  std::size_t row = 0;
  double weight = 0;
};

// Rows of the material's views that a cell stands for.
std::vector<Weighted> rows_of_cell(const Material& material, ParabolicPoint p) {
  const DirectionMesh mesh(material.views);
  std::size_t hint = 0;
  const DirectionMix mix = mesh.locate(p, hint);
  return {{mix.index[0], mix.weight[0]}, {mix.index[1], mix.weight[1]}, {mix.index[2], mix.weight[2]}};
}

std::set<std::uint16_t> clusters_of(const ClusteredTensor& tensor, std::size_t cell) {
  const auto first = tensor.map.rows.membership.begin() + std::ptrdiff_t(cell * tensor.shape.mixture);
  return {first, first + tensor.shape.mixture};
}

// Cells of a side that a map of `own` cells is refined to.
std::uint32_t refined_side(std::uint32_t own) {
  return own == 0 || side < own ? std::max(own, side) : side / own * own;
}

// Along either direction, linear from the centre of the map's cell to the next one's if that has the same
// clusters, else as it comes from the one before.
double expected_of_map(const ClusteredTensor& tensor, std::uint32_t column, std::uint32_t row,
                       std::span<const float> light, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t own = tensor.map.side, factor = refined_side(own) / own;
  const int at[2] = {int(column / factor), int(row / factor)};
  const auto cell = [&](int c, int r) { return std::size_t(r) * own + std::size_t(c); };
  const auto value = [&](int c, int r) {
    return test::value(tensor, tensor.map.rows, cell(c, r), light, x, y);
  };
  const auto has_same = [&](int c, int r) {
    return c >= 0 && r >= 0 && c < int(own) && r < int(own) &&
           clusters_of(tensor, cell(c, r)) == clusters_of(tensor, cell(at[0], at[1]));
  };
  const double centre = value(at[0], at[1]);
  double sum = centre;
  for (const int axis : {0, 1}) {
    const double offset = ((axis == 0 ? column : row) % factor + 0.5) / factor - 0.5;
    const int step = offset > 0 ? 1 : -1, dx = axis == 0 ? step : 0, dy = axis == 1 ? step : 0;
    if (has_same(at[0] + dx, at[1] + dy))
      sum += std::abs(offset) * (value(at[0] + dx, at[1] + dy) - centre);
    else if (has_same(at[0] - dx, at[1] - dy))
      sum -= std::abs(offset) * (value(at[0] - dx, at[1] - dy) - centre);
  }
  return sum;
}

double expected(const Material& material, const ClusteredTensor& tensor, std::uint32_t column,
                std::uint32_t row, std::span<const float> light, std::uint32_t x, std::uint32_t y) {
  if (tensor.map.side) return expected_of_map(tensor, column, row, light, x, y);
  double sum = 0;
  const ParabolicPoint p = to_parabolic(from_parabolic(cell_centre(column, row, side)));
  for (const auto& [view, weight] : rows_of_cell(material, p))
    sum += weight * test::value(tensor, tensor.rows, view, light, x, y);
  return sum;
}

// The light basis at a direction of the upper hemisphere, R_l numbers of one channel.
std::vector<float> light_modes(const Material& material, Vec3 light, std::uint32_t channel) {
  const DirectionMesh mesh(material.lights);
  std::size_t hint = 0;
  const DirectionMix mix = mesh.locate(to_parabolic(light), hint);
  const std::uint32_t rank = material.btf.shape.rank_light;
  std::vector<float> modes(rank);
  ParabolicPoint nearest{};
  for (int i = 0; i < 3; ++i) {
    const ParabolicPoint p = to_parabolic(material.lights[mix.index[i]]);
    nearest = {nearest.x + mix.weight[i] * p.x, nearest.y + mix.weight[i] * p.y};
  }
  for (int i = 0; i < 3; ++i)
    for (std::uint32_t a = 0; a < rank; ++a)
      modes[a] += mix.weight[i] * material.light_basis[(3 * std::size_t(mix.index[i]) + channel) * rank + a];
  // Beyond the lights, by the ratio of cosines.
  const float share = std::min(light.z / from_parabolic(nearest).z, 1.0f);
  for (float& mode : modes) mode *= share;
  return modes;
}

Sample at_texel(const TensorShape& s, std::uint32_t x, std::uint32_t y) {
  return {(float(x) + 0.5f) / float(s.width), (float(y) + 0.5f) / float(s.height), 0, {}, {}};
}

}  // namespace

TEST_CASE("decoding gives the sums of equations (24) and (25)") {
  for (const test::SampleSize& size : test::sample_forms) {
    const Material material = test::sample_material(11, size);
    const MaterialTables tables = tables_of(material);
    const std::uint32_t cells = refined_side(size.map_side);
    CHECK(tables.btf.side == (size.map_side ? size.map_side : side));
    const TensorShape& s = material.btf.shape;
    test::Numbers numbers(2);
    for (int i = 0; i < 40; ++i) {
      const std::uint32_t column = numbers.below(cells), row = numbers.below(cells);
      const std::uint32_t x = numbers.below(s.width), y = numbers.below(s.height);
      // Cells beyond the disc stand for the horizon and are nobody's nearest.
      if (const ParabolicPoint p = cell_centre(column, row, cells); std::hypot(p.x, p.y) > 1) continue;
      Sample sample = at_texel(s, x, y);
      sample.view = from_parabolic(cell_centre(column, row, cells));
      // A cell's centre of the light map, where its filter reads one texel.
      sample.light = from_parabolic(cell_centre(20 + numbers.below(24), 20 + numbers.below(24), 64));
      const Radiance got = evaluate_btf(tables, sample);
      const float channels[3] = {got.red, got.green, got.blue};
      // Two half floats, mode and coefficient, in each of some 40 products of size up to one. Integers are
      // within half of 1/127 of their scale, 0.002 rms in each of two factors: four times the sum's 0.02.
      const double bound = size.bits == 16 ? 4e-3 : 0.08;
      for (std::uint32_t channel = 0; channel < 3; ++channel)
        CHECK(std::abs(channels[channel] - expected(material, material.btf, column, row,
                                                    light_modes(material, sample.light, channel), x, y)) <
              bound);
      if (size.visibility == VisibilityForm::none)
        CHECK(evaluate_votf(tables, sample) == 1);
      else
        CHECK(std::abs(evaluate_votf(tables, sample) -
                       expected(material, material.votf, column, row, std::array{1.0f}, x, y)) < bound);
    }
  }
}

TEST_CASE("without a view map the clusters of the three nearest views are mixed, with one its own") {
  const Material k_cta = test::sample_material(4),
                 cta = test::sample_material(4, {.clusters = 5, .mixture = 1}),
                 n_svd = test::sample_material(4, {.clusters = 1, .mixture = 1});
  CHECK(cell_terms(k_cta.btf) == 3);  // of three clusters
  CHECK(cell_terms(test::sample_material(4, {.clusters = 8}).btf) == 6);
  CHECK(cell_terms(test::sample_material(4, {.map_side = 4}).btf) == 2);
  CHECK(cell_terms(cta.btf) == 3);
  CHECK(cell_terms(n_svd.btf) == 1);
  CHECK(cell_terms(test::sample_material(4, {.clusters = 2, .mixture = 1}).btf) == 2);
  const ViewCells cells = view_cells(cta.btf, cta.views, 32, nook::default_memory());
  std::size_t mixed = 0;
  for (std::size_t cell = 0; cell < 32 * 32; ++cell) {
    const std::uint16_t* const clusters = &cells.rows.membership[3 * cell];
    mixed += clusters[0] != clusters[1] && cells.rows.coefficients[(3 * cell + 1) * 4] != 0;
  }
  CHECK(mixed > 300);  // most triangles of nine views in five clusters
}

TEST_CASE("the smallest level decodes to the mean over the texture") {
  // Also of sizes that do not halve evenly.
  for (const auto& [width, height] : {std::pair{8u, 8u}, {7u, 5u}, {12u, 3u}}) {
    const Material material = test::sample_material(6, {.width = width, .height = height, .rank_y = 3});
    const MaterialTables tables = tables_of(material);
    Sample sample = at_texel(material.btf.shape, 0, 0);
    sample.view = normalised({0.3f, -0.2f, 0.8f});
    sample.light = normalised({-0.5f, 0.1f, 0.6f});
    double mean[3] = {}, mean_votf = 0;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        sample.u = at_texel(material.btf.shape, x, y).u;
        sample.v = at_texel(material.btf.shape, x, y).v;
        const Radiance near = evaluate_btf(tables, sample);
        mean[0] += near.red / (width * height);
        mean[1] += near.green / (width * height);
        mean[2] += near.blue / (width * height);
        mean_votf += evaluate_votf(tables, sample) / (width * height);
      }
    sample.level = 20;
    const Radiance far = evaluate_btf(tables, sample);
    // Half floats on both sides.
    CHECK(std::abs(far.red - mean[0]) < 1e-3);
    CHECK(std::abs(far.green - mean[1]) < 1e-3);
    CHECK(std::abs(far.blue - mean[2]) < 1e-3);
    CHECK(std::abs(evaluate_votf(tables, sample) - mean_votf) < 1e-3);
  }
}

TEST_CASE("texels, levels and tiles are interpolated linearly") {
  const Material material = test::sample_material(8, {.width = 8, .height = 8, .rank_x = 8});
  const MaterialTables tables = tables_of(material);
  const auto votf = [&](float u, float v, float level) {
    return evaluate_votf(tables, {u, v, level, {0, 0, 1}, {0, 0, 1}});
  };
  CHECK(std::abs(votf(1.0f / 8, 0.5f / 8, 0) -
                 0.5f * (votf(0.5f / 8, 0.5f / 8, 0) + votf(1.5f / 8, 0.5f / 8, 0))) < 1e-5f);
  CHECK(std::abs(votf(0, 0.5f / 8, 0) - 0.5f * (votf(0.5f / 8, 0.5f / 8, 0) + votf(7.5f / 8, 0.5f / 8, 0))) <
        1e-5f);
  CHECK(std::abs(votf(-3.4f, 5.7f, 0) - votf(0.6f, 0.7f, 0)) < 1e-4f);
  CHECK(std::abs(votf(0.3f, 0.3f, 0.25f) - (0.75f * votf(0.3f, 0.3f, 0) + 0.25f * votf(0.3f, 0.3f, 1))) <
        1e-5f);
}

TEST_CASE("light from below the horizon gives black, and a view from below counts as the horizon") {
  const MaterialTables tables = tables_of(test::sample_material());
  Sample sample{0.3f, 0.4f, 0, {0, 0, 1}, normalised({1, 0, -0.1f})};
  CHECK(evaluate_btf(tables, sample).red == 0);
  sample.light = {0, 0, 1};
  sample.view = {0.6f, 0.8f, 0};
  const Radiance horizon = evaluate_btf(tables, sample);
  sample.view = {0.6f, 0.8f, -1e-3f};
  CHECK(evaluate_btf(tables, sample).red == horizon.red);
}

TEST_CASE("beyond the lowest lights, light falls off as its cosine") {
  Material material = test::sample_material(4, {.lights = 6});
  for (std::size_t i = 0; i < 5; ++i) {
    const float phi = 1.2566371f * float(i);
    material.lights[i] = {std::sqrt(0.75f) * std::cos(phi), std::sqrt(0.75f) * std::sin(phi), 0.5f};
  }
  material.lights[5] = {0, 0, 1};
  const MaterialTables tables = tables_of(material);
  Sample sample{0.3f, 0.4f, 0, {0, 0, 1}, material.lights[0]};
  const float rim = evaluate_btf(tables, sample).red;
  REQUIRE(std::abs(rim) > 1e-3f);
  for (const float z : {0.4f, 0.25f, 0.1f, 0.01f}) {
    sample.light = {std::sqrt(1 - z * z), 0, z};
    // The map's cells are 1/32 wide, over which a share of 2 z changes by 0.06; between them it is linear.
    CHECK(std::abs(evaluate_btf(tables, sample).red / rim - 2 * z) < 0.03f);
  }
}

TEST_CASE("the visibility mapping is equation (26) with both sets of parameters") {
  const VisibilityMapping distance = paper_mapping(VisibilityForm::distance);
  CHECK(visibility_of(VisibilityForm::distance, distance, 0.05f) == 1);
  CHECK(std::abs(visibility_of(VisibilityForm::distance, distance, 0.02f) - 0.24f) < 1e-6f);
  CHECK(visibility_of(VisibilityForm::distance, distance, 0) == 0);
  CHECK(visibility_of(VisibilityForm::distance, distance, -0.4f) == 0);
  const VisibilityMapping binary = paper_mapping(VisibilityForm::binary);
  CHECK(visibility_of(VisibilityForm::binary, binary, 0.5f) == 1);
  CHECK(visibility_of(VisibilityForm::binary, binary, 0.3f) == 0.3f);
  CHECK(visibility_of(VisibilityForm::binary, binary, -0.1f) == 0);
  CHECK(visibility_of(VisibilityForm::none, {}, -1) == 1);
}

TEST_CASE("integers decode numbers of any size as half floats do") {
  // Sums of some 40 products of integers are within 8 per cent, as above, of the largest.
  for (const float size : {1e-9f, 1.0f, 1e9f}) {
    Material material = test::sample_material(12, {.map_side = 4});
    for (float& core : material.btf.cores) core *= size;
    for (float& light : material.light_basis) light /= size;
    const MaterialTables halves = tables_of(material);
    material.bits = 8;
    const MaterialTables integers = tables_of(material);
    CHECK(integers.btf.spatial.empty());
    CHECK(integers.light.empty());
    CHECK(2 * integers.btf.spatial_8.size() == 2 * halves.btf.spatial.size());
    const Sample sample{0.3f, 0.4f, 0, normalised({0.2f, 0.1f, 1}), normalised({0.1f, -0.3f, 1})};
    CHECK(std::abs(evaluate_btf(integers, sample).green - evaluate_btf(halves, sample).green) < 0.08f);
    CHECK(std::abs(evaluate_votf(integers, sample) - evaluate_votf(halves, sample)) < 0.08f);
  }
}

TEST_CASE("a view map decodes without steps where the clusters stay the same") {
  // One cluster: all cells blend, and coefficients that are linear over the map stay linear from rim to rim.
  Material material = test::sample_material(5, {.clusters = 1, .mixture = 1, .map_side = 4});
  for (std::size_t cell = 0; cell < 16; ++cell)
    for (std::size_t b = 0; b < 4; ++b)
      material.btf.map.rows.coefficients[4 * cell + b] =
          0.3f + float(b) * 0.2f * float(cell % 4) - 0.1f * float(cell / 4);
  const MaterialTables tables = tables_of(material);
  Sample sample{0.3f, 0.4f, 0, {}, {0, 0, 1}};
  float before = 0, largest = 0, total = 0;
  constexpr int steps = 4000;
  for (int i = 0; i <= steps; ++i) {
    const float at = 1.6f * float(i) / float(steps) - 0.8f;
    sample.view = from_parabolic({at, 0.3f * at + 0.1f});
    const float now = evaluate_btf(tables, sample).green;
    if (i > 0) largest = std::max(largest, std::abs(now - before)), total += std::abs(now - before);
    before = now;
  }
  REQUIRE(total > 0.1f);
  // The way of 3.2 cells is a straight line on the map, so that all steps have the same size, up to half
  // floats of 11 bits.
  CHECK(largest < 1.2f * total / float(steps) + 1e-4f);
}

TEST_CASE("tables are the same on any number of threads") {
  for (const std::uint32_t bits : {8u, 16u}) {
    const Material material = test::sample_material(9, {.rank_view = 8, .clusters = 2, .bits = bits});
    const MaterialTables alone = tables_of(material), together = tables_of(material, {on_threads, nullptr});
    CHECK(alone.btf.spatial == together.btf.spatial);
    CHECK(alone.btf.coefficients == together.btf.coefficients);
    CHECK(alone.btf.membership == together.btf.membership);
    CHECK(alone.votf.spatial == together.votf.spatial);
    CHECK(alone.light == together.light);
    CHECK(alone.btf.spatial_8 == together.btf.spatial_8);
    CHECK(alone.votf.spatial_8 == together.votf.spatial_8);
    CHECK(alone.light_8 == together.light_8);
  }
}

TEST_CASE("numbers beyond a half float's range decode correctly") {
  Material material = test::sample_material(12);
  const MaterialTables plain = tables_of(material);
  for (float& core : material.btf.cores) core *= 0x1p20f;
  for (float& light : material.light_basis) light *= 0x1p-20f;
  const Sample sample{0.3f, 0.4f, 0, {0, 0, 1}, {0, 0, 1}};
  // Powers of two change no digit.
  CHECK(evaluate_btf(tables_of(material), sample).green == evaluate_btf(plain, sample).green);
  for (float& core : material.btf.cores) core *= 0x1p-140f;
  for (float& core : material.votf.cores) core *= 0x1p-120f;
  CHECK(std::abs(evaluate_btf(tables_of(material), sample).green) < 1e-6f);
  CHECK(std::abs(evaluate_votf(tables_of(material), sample)) < 1e-6f);
  for (float& core : material.btf.cores) core = 0;
  CHECK(evaluate_btf(tables_of(material), sample).green == 0);
}

TEST_CASE("a view meets the relief where its ray does") {
  const float height = 0.05f;
  const Material bumpy =
      test::sample_material(1, {.width = 64, .height = 64, .relief_height = height, .relief_steps = 16});
  const ReliefTables relief = make_relief_tables(bumpy.relief, 64, 64, nook::default_memory());
  // Texels' heights, in closed form at the middle of texel (0, 0), which is the origin of the waves.
  const auto height_at = [&](TexturePlace at) {
    const float x = at.u - 0.5f / 64, y = at.v - 0.5f / 64, turn = 6.2831853f;
    return height * 0.5f * (std::cos(turn * x) + std::sin(turn * y));
  };
  test::Numbers numbers(3);
  for (int i = 0; i < 200; ++i) {
    const TexturePlace through{numbers.between(-2, 2), numbers.between(-2, 2)};
    const Vec3 view = normalised({numbers.between(-1, 1), numbers.between(-1, 1), numbers.between(0.8f, 1)});
    const TexturePlace at = relief_place(relief, through, 0, view);
    const float z = height_at(at);
    // A 255th of 0.1 tiles for the levels, and as much for the chord of a 16th of the range on the waves.
    CHECK(std::abs(at.u - through.u - z * view.x / view.z) < 1e-3f);
    CHECK(std::abs(at.v - through.v - z * view.y / view.z) < 1e-3f);
  }
  // The smallest level is the mean height, 0, but for the rounding of levels.
  const TexturePlace far = relief_place(relief, {0.3f, 0.4f}, 20, normalised({0.6f, 0, 0.6f}));
  CHECK((std::abs(far.u - 0.3f) < 5e-4f && far.v == 0.4f));
}

TEST_CASE("a plane of relief moves texels by its height, and steep views no further than its slope") {
  const Material flat = test::sample_material(5), plane = test::sample_material(5, {.relief_height = 0.1f});
  const MaterialTables still = tables_of(flat), moving = tables_of(plane);
  Sample sample{0.3f, 0.6f, 0, normalised({0.5f, -0.25f, 0.5f}), {0, 0, 1}};
  Sample there = sample;
  there.u += 0.1f;
  there.v -= 0.05f;
  CHECK(std::abs(evaluate_btf(moving, sample).green - evaluate_btf(still, there).green) < 1e-4f);
  CHECK(evaluate_votf(moving, sample) == evaluate_votf(still, sample));
  for (const Vec3 view : {normalised({1, 0, 0.1f}), Vec3{1, 0, 0}, normalised({1, 0, -0.5f})}) {
    const TexturePlace at = relief_place(moving.relief, {0.3f, 0.6f}, 0, view);
    CHECK((std::abs(at.u - 0.5f) < 1e-6f && at.v == 0.6f));
  }
}

TEST_CASE("places of a pixel lie along the longer axis of its footprint and cover it") {
  test::Numbers numbers(5);
  for (int i = 0; i < 300; ++i) {
    // The footprint turned by `axis` in texels, seen through pixels turned by `screen`: J = R(axis) S
    // R(screen).
    const std::uint32_t width = 3 + numbers.below(60), height = 3 + numbers.below(60),
                        count = 1 + numbers.below(max_fetches);
    const float shorter = numbers.between(0.1f, 4), longer = shorter * numbers.between(1, 12),
                axis = numbers.between(0, 6.3f), screen = numbers.between(0, 6.3f);
    const auto turned = [&](float along, float across) {
      return TexturePlace{(std::cos(axis) * along - std::sin(axis) * across) / float(width),
                          (std::sin(axis) * along + std::cos(axis) * across) / float(height)};
    };
    const PixelSides pixel{{numbers.between(-1, 2), numbers.between(-1, 2)},
                           turned(longer * std::cos(screen), shorter * std::sin(screen)),
                           turned(-longer * std::sin(screen), shorter * std::cos(screen))};
    const Fetches at = fetches_along(pixel, width, height, count);
    REQUIRE(at.count == count);
    const float square = std::max(shorter, longer / float(count)), reach = 0.5f * (longer - square);
    const float first_x = (at.place[0].u - pixel.middle.u) * float(width),
                first_y = (at.place[0].v - pixel.middle.v) * float(height);
    const float forward = first_x * std::cos(axis) + first_y * std::sin(axis) > 0 ? 1.0f : -1.0f;
    for (std::uint32_t n = 0; n < count; ++n) {
      const float share = count > 1 ? 1 - 2 * float(n) / float(count - 1) : 0;
      const float x = (at.place[n].u - pixel.middle.u) * float(width),
                  y = (at.place[n].v - pixel.middle.v) * float(height);
      // Texels; squares of up to 2,300 in floats, and roots of the difference of two that may be nearly
      // equal.
      CHECK(std::abs(x - forward * share * reach * std::cos(axis)) < 5e-3f);
      CHECK(std::abs(y - forward * share * reach * std::sin(axis)) < 5e-3f);
      CHECK(std::abs(at.place[n].level - std::log2(square)) < 5e-3f);
    }
  }
}

TEST_CASE("a round pixel is decoded as a sample, and sides that are not numbers give the coarsest level") {
  const float infinite = std::numeric_limits<float>::infinity(), no_number = std::nanf("");
  for (const test::SampleSize& size :
       {test::SampleSize{.width = 16, .height = 8, .map_side = 5},
        {.width = 16, .height = 8, .bits = 8, .relief_height = 0.05f, .relief_steps = 8},
        {.width = 16, .height = 8, .channels = 8}}) {
    const MaterialTables tables = tables_of(test::sample_material(12, size));
    const Vec3 view = normalised({0.6f, -0.3f, 0.5f}), light = normalised({-0.2f, 0.3f, 0.7f});
    const auto check_equal = [&](const PixelSides& sides, std::uint32_t fetches, float level) {
      const Sample sample{sides.middle.u, sides.middle.v, level, view, light};
      const Pixel pixel{sides, view, light, fetches};
      const Radiance want = evaluate_btf(tables, sample), got = evaluate_btf_pixel(tables, pixel);
      CHECK((got.red == want.red && got.green == want.green && got.blue == want.blue));
      CHECK(evaluate_votf_pixel(tables, pixel) == evaluate_votf(tables, sample));
    };
    const TexturePlace middle{0.3f, -1.4f};
    for (const std::uint32_t fetches : {1u, 2u, 3u, 8u}) {
      for (const float texels : {0.25f, 1.0f, 3.0f, 4.0f, 64.0f})
        check_equal({middle, {texels / 16, 0}, {0, texels / 8}}, fetches, 0.5f * std::log2(texels * texels));
      check_equal({middle, {}, {}}, fetches, 0);
      for (const float number : {infinite, -infinite, no_number, 3e38f})
        for (const PixelSides& sides : {PixelSides{middle, {number, 0}, {0, 0.1f}},
                                        {middle, {0.1f, number}, {0.2f, 0.1f}},
                                        {middle, {0.1f, 0}, {number, number}}})
          check_equal(sides, fetches, 30);
    }
  }
}

TEST_CASE("fetches along a pixel come nearer to supersampling than one fetch") {
  // Images without any order, which no filter is made for; sums of squares over pixels of all directions.
  const Material material =
      test::sample_material(13, {.width = 32, .height = 32, .rank_x = 32, .rank_y = 32, .map_side = 5});
  const MaterialTables tables = tables_of(material);
  const Vec3 view = normalised({0.5f, 0.2f, 0.4f}), light = normalised({0.3f, 0.3f, 0.7f});
  test::Numbers numbers(4);
  double errors[3] = {}, votf_errors[3] = {};
  for (int i = 0; i < 60; ++i) {
    const float angle = numbers.between(0, 3.14f), longer = numbers.between(2, 6) / 32, shorter = 1.0f / 32;
    const PixelSides sides{{numbers.between(0, 1), numbers.between(0, 1)},
                           {-shorter * std::sin(angle), shorter * std::cos(angle)},
                           {longer * std::cos(angle), longer * std::sin(angle)}};
    double mean = 0, votf_mean = 0;
    for (int x = 0; x < 6; ++x)
      for (int y = 0; y < 36; ++y) {
        const float across = (float(x) + 0.5f) / 6 - 0.5f, along = (float(y) + 0.5f) / 36 - 0.5f;
        const Sample sample{sides.middle.u + across * sides.dx.u + along * sides.dy.u,
                            sides.middle.v + across * sides.dx.v + along * sides.dy.v, 0, view, light};
        mean += double(evaluate_btf(tables, sample).green) / 216;
        votf_mean += double(evaluate_votf(tables, sample)) / 216;
      }
    for (const std::uint32_t fetches : {1u, 2u, 4u}) {
      const Pixel pixel{sides, view, light, fetches};
      errors[fetches / 2] += std::pow(double(evaluate_btf_pixel(tables, pixel).green) - mean, 2);
      votf_errors[fetches / 2] += std::pow(double(evaluate_votf_pixel(tables, pixel)) - votf_mean, 2);
    }
  }
  // The bound that the filter is made to keep, also of noise.
  CHECK(errors[1] < 0.5 * errors[0]);
  CHECK(votf_errors[1] < 0.5 * votf_errors[0]);
  CHECK(errors[2] < errors[1]);
  CHECK(votf_errors[2] < votf_errors[1]);
}
