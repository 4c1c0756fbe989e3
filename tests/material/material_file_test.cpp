#include "sdk/src/material/material_file.h"

#include <cmath>
#include <string>

#include "sdk/src/core/failure.h"
#include "sdk/src/material/map_rows.h"
#include "sdk/src/material/material_check.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::material;

namespace {

struct Outcome {
  nook_result code = NOOK_OK;
  std::string text;
  bool says(const char* part) const { return text.find(part) != std::string::npos; }
};

template <class Body>
Outcome outcome_of(Body&& body) {
  try {
    body();
  } catch (const Failure& failure) {
    return {failure.code(), failure.what()};
  }
  return {};
}
Outcome read_outcome(std::span<const std::byte> bytes) {
  return outcome_of([&] { read_material(bytes); });
}

// Counts the bytes that a reader allocates.
class CountingMemory final : public nook::Memory {
 public:
  std::size_t total = 0;

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override {
    total += size;
    return nook::default_memory()->allocate(size, alignment);
  }
  void do_deallocate(void* memory, std::size_t size, std::size_t alignment) override {
    nook::default_memory()->deallocate(memory, size, alignment);
  }
};

// A half float has 11 digits: half a step of the number itself, or of the smallest number that keeps all its
// digits, 2^-28 of the largest.
void check_near(const nook::Vector<float>& got, const nook::Vector<float>& want) {
  REQUIRE(got.size() == want.size());
  float largest = 0;
  for (const float value : want) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < got.size(); ++i)
    CHECK(std::abs(got[i] - want[i]) <= std::max(std::abs(want[i]), 0x1p-28f * largest) * 0x1p-11f);
}

// Integers: 511 steps make the largest number of an array, and steps have at most four digits fewer; cores
// have the step whose squares are `share` of the cores' mean square: half a step is sqrt(3 share) of its
// root.
void check_rounded(const nook::Vector<float>& got, const nook::Vector<float>& want, float share) {
  REQUIRE(got.size() == want.size());
  float largest = 0;
  double square = 0;
  for (const float value : want) {
    largest = std::max(largest, std::abs(value));
    square += double(value) * value;
  }
  const double step = share > 0 ? std::sqrt(12 * share * square / double(want.size())) : largest / 511;
  // The largest number may be rounded down instead of to the nearest.
  for (std::size_t i = 0; i < got.size(); ++i)
    REQUIRE(std::abs(got[i] - want[i]) <= (std::abs(want[i]) > largest - step ? 1.0 : 0.5) * step * 1.0001);
}

void check_rounded(const ClusteredTensor& got, const ClusteredTensor& want, float share) {
  CHECK(got.shape == want.shape);
  check_rounded(got.cores, want.cores, share);
  check_rounded(got.x_bases, want.x_bases, 0);
  check_rounded(got.y_bases, want.y_bases, 0);
  CHECK(got.rows.membership == want.rows.membership);
  check_rounded(got.rows.coefficients, want.rows.coefficients, 0);
  const ViewRows map = sorted_rows(want.map.rows, want.shape);
  CHECK(got.map.rows.membership == map.membership);
  check_rounded(got.map.rows.coefficients, map.coefficients, 0);
}

void check_near(const ClusteredTensor& got, const ClusteredTensor& want) {
  CHECK(got.shape == want.shape);
  check_near(got.cores, want.cores);
  check_near(got.x_bases, want.x_bases);
  check_near(got.y_bases, want.y_bases);
  CHECK(got.rows.membership == want.rows.membership);
  check_near(got.rows.coefficients, want.rows.coefficients);
  CHECK(got.map.side == want.map.side);
  CHECK(got.map.rows.membership == want.map.rows.membership);
  check_near(got.map.rows.coefficients, want.map.rows.coefficients);
}

// Of both forms of numbers, and a neural one.
constexpr test::SampleSize damaged_forms[] = {
    {.map_side = 3, .bits = 8, .relief_height = 0.1f, .relief_steps = 8},
    {.map_side = 3, .bits = 16, .relief_height = 0.1f, .relief_steps = 8},
    {.visibility = VisibilityForm::none, .channels = 4, .units = 4, .layers = 2}};

}  // namespace

TEST_CASE("a material comes back from its file within a half float's step") {
  for (const test::SampleSize& size : test::sample_forms) {
    const Material material = test::sample_material(7, size);
    const Material read = quantise(material);
    CHECK(read.lights == material.lights);
    CHECK(read.views == material.views);
    CHECK(read.visibility == material.visibility);
    CHECK(read.mapping.threshold == material.mapping.threshold);
    CHECK(read.mapping.weight == material.mapping.weight);
    CHECK(read.recipe == material.recipe);
    CHECK(read.bits == size.bits);
    CHECK(write_material(read) == write_material(quantise(read)));
    // Rounded again, to the same steps.
    CHECK(write_material(read) == write_material(material));
    if (size.bits == 8) {
      check_rounded(read.light_basis, material.light_basis, 0);
      check_rounded(read.btf, material.btf, material.core_rounding);
      check_rounded(read.votf, material.votf, 0x1p-16f);
      continue;
    }
    check_near(read.light_basis, material.light_basis);
    check_near(read.btf, material.btf);
    check_near(read.votf, material.votf);
  }
}

TEST_CASE("numbers of any size keep a half float's digits in the file") {
  Material material = test::sample_material(3);
  for (float& core : material.btf.cores) core *= 1e6f;
  for (float& core : material.votf.cores) core *= 1e-9f;
  const Material read = quantise(material);
  check_near(read.btf.cores, material.btf.cores);
  check_near(read.votf.cores, material.votf.cores);
  // The limits themselves are not rounded beyond the limits.
  material.btf.cores[0] = max_core;
  material.light_basis[0] = -max_number;
  CHECK(quantise(material).btf.cores[0] == max_core);
}

TEST_CASE("a file is as long as the formula says, but for directions, heads and the view maps") {
  for (const test::SampleSize& size : test::sample_forms) {
    if (size.bits == 8) continue;  // as long as its numbers need
    const Material material = test::sample_material(1, size);
    const std::size_t tensors = size.visibility == VisibilityForm::none ? 1 : 2;
    const std::size_t sections = 5 + tensors - 1 + (size.map_side ? tensors : 0);
    // Container, section table, HEAD, directions, recipe; of each tensor a head of 15 bytes and an exponent
    // for each of four arrays; one exponent more for the light basis.
    std::size_t around = 40 + 24 * sections + 14 + 12 * (material.lights.size() + material.views.size()) +
                         material.recipe.size() + 19 * tensors + 1;
    if (size.map_side)
      around +=
          tensors * (3 + view_rows_bytes(material.btf.shape, std::size_t(size.map_side) * size.map_side));
    CHECK(write_material(material).size() == compressed_bytes(material) + around);
  }
}

TEST_CASE("integers take the bits that their sizes need") {
  // Numbers as of a normal distribution, in steps of a quarter of their deviation: an entropy of 2.05 -
  // log2(1/4) = 4.05 bits, which Rice's code may exceed by 0.3.
  Material material =
      test::sample_material(1, {.width = 48, .height = 48, .rank_x = 48, .rank_y = 48, .bits = 8});
  test::Numbers numbers(3);
  for (float& core : material.btf.cores) {
    core = 0;
    for (int i = 0; i < 12; ++i) core += numbers.between(-0.5f, 0.5f);
  }
  material.core_rounding = 1.0f / (12 * 16);
  Material none = material;
  std::fill(none.btf.cores.begin(), none.btf.cores.end(), 0.0f);
  // Zeros take a bit each.
  const double bits = 8 * double(write_material(material).size() - write_material(none).size()) /
                          double(material.btf.cores.size()) +
                      1;
  CHECK(bits > 4);
  CHECK(bits < 4.4);
}

TEST_CASE("a material of the first version loads") {
  const Material material = test::sample_material(1, {.map_side = 3});
  const std::vector<std::byte> file = write_material(material);
  const Container now(file, material_kind);
  std::vector<ContainerSection> sections;
  const auto add = [&](const char(&name)[5], std::size_t left_out) {
    ByteReader in = now.section(name);
    const std::string_view text = in.text(in.remaining() - left_out);
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    sections.push_back({four_letters(name), {first, first + text.size()}});
  };
  add("HEAD", 1);  // without the form of numbers
  add("DIRS", 0);
  add("LGHT", 0);
  add("BTF_", 0);
  add("BMAP", 0);
  add("VOTF", 0);
  add("VMAP", 0);
  add("RECP", 0);
  const Material read = read_material(write_container({material_kind.kind, "material", 1, 1}, sections));
  CHECK(read.bits == 16);
  CHECK(write_material(read) == file);
}

TEST_CASE("a form of numbers that is neither 8 nor 16 is refused") {
  Material material = test::sample_material();
  material.bits = 9;
  CHECK(outcome_of([&] { write_material(material); }).says("got 9 bits, need 8 or 16"));
}

TEST_CASE("a file cut at any byte is refused") {
  for (const test::SampleSize& form : damaged_forms) {
    const std::vector<std::byte> good = write_material(test::sample_material(1, form));
    REQUIRE(read_outcome(good).code == NOOK_OK);
    for (std::size_t size = 0; size < good.size(); ++size) {
      // An exact copy on the heap, so that the address sanitizer sees one byte too far.
      const std::vector<std::byte> cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
      REQUIRE(read_outcome(cut).code == NOOK_ERROR_BAD_FILE);
    }
  }
}

TEST_CASE("a file flipped at any byte is refused, or with its checksum repaired loads soundly") {
  for (const test::SampleSize& form : damaged_forms) {
    const std::vector<std::byte> good = write_material(test::sample_material(1, form));
    std::size_t refused = 0;
    for (std::size_t i = 0; i < good.size(); ++i)
      for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
        auto file = good;
        file[i] ^= std::byte(flip);
        REQUIRE(read_outcome(file).code != NOOK_OK);
        repair_checksum(file);
        const Outcome outcome = outcome_of([&] { check_material(read_material(file), NOOK_ERROR_INTERNAL); });
        refused += outcome.code != NOOK_OK;
        REQUIRE((outcome.code == NOOK_OK || outcome.code == NOOK_ERROR_BAD_FILE ||
                 outcome.code == NOOK_ERROR_FILE_VERSION));
      }
    // Heads, directions and memberships are a part of so small a file; features and weights may be almost
    // anything.
    CHECK(refused > good.size() / (form.channels > 0 ? 8 : 4));
  }
}

TEST_CASE("memory for a hostile file is bounded by its size") {
  for (const std::uint32_t bits : {8u, 16u}) {
    const std::vector<std::byte> good = write_material(test::sample_material(1, {.bits = bits}));
    for (std::size_t i = 40; i < good.size(); ++i) {
      auto file = good;
      file[i] ^= std::byte{0xff};
      repair_checksum(file);
      CountingMemory memory;
      try {
        read_material(file, &memory);
      } catch (const Failure&) {
      }
      // Half floats become floats, a byte of membership two. Of integers a bit becomes a float.
      REQUIRE(memory.total < (bits == 8 ? 33 : 3) * file.size());
    }
  }
}

TEST_CASE("files of another kind and version are refused by name") {
  const std::vector<std::byte> good = write_material(test::sample_material());
  auto file = good;
  file[12] = std::byte{'X'};
  CHECK(read_outcome(file).says("need \"MATL\""));
  file = good;
  file[8] = std::byte{9};
  CHECK(read_outcome(file).code == NOOK_ERROR_FILE_VERSION);
}

TEST_CASE("a relief comes back from its file, and a file without one is of the version before") {
  const Material bumpy = test::sample_material(1, {.relief_height = 0.1f, .relief_steps = 8});
  const std::vector<std::byte> file = write_material(bumpy);
  CHECK(file[8] == std::byte{3});
  const Relief read = read_material(file).relief;
  CHECK((read.low == -0.1f && read.high == 0.1f && read.max_slope == 2 && read.steps == 8));
  CHECK(read.levels == bumpy.relief.levels);

  // Heights of zero everywhere are not a relief: the same bits as without.
  const Material flat = test::sample_material();
  Material zero = bumpy;
  zero.relief.low = zero.relief.high = 0;
  CHECK(write_material(zero) == write_material(flat));
  CHECK(write_material(flat)[8] == std::byte{2});
}

TEST_CASE("a material with a fault is not written, and the message names it") {
  const auto refusal = [](auto&& damage, const test::SampleSize& size = {}) {
    Material material = test::sample_material(1, size);
    damage(material);
    const Outcome outcome = outcome_of([&] { write_material(material); });
    CHECK(outcome.code == NOOK_ERROR_INVALID_ARGUMENT);
    return outcome;
  };
  CHECK(refusal([](Material& m) { m.lights.clear(); }).says("number of directions of the lights"));
  CHECK(refusal([](Material& m) { m.lights[3].z = -0.5f; }).says("direction 3 of the lights"));
  CHECK(refusal([](Material& m) { m.views[2].x = NAN; }).says("direction 2 of the views"));
  CHECK(refusal([](Material& m) { m.views[4] = m.views[1]; }).says("directions 1 and 4 of the views"));
  CHECK(refusal([](Material& m) { m.btf.shape.views = 8; }).says("number of views of the BTF"));
  CHECK(refusal([](Material& m) { m.btf.shape.rank_x = 7; }).says("x rank of the BTF"));
  CHECK(refusal([](Material& m) { m.btf.shape.rank_light = 16; }).says("light rank of the BTF"));
  CHECK(refusal([](Material& m) { m.btf.shape.rank_view = 10; }).says("view rank of the BTF"));
  CHECK(refusal([](Material& m) { m.votf.shape.rank_light = 2; }).says("light rank of the VOTF"));
  CHECK(refusal([](Material& m) { m.btf.shape.clusters = 10; }).says("number of clusters of the BTF"));
  CHECK(refusal([](Material& m) { m.btf.shape.mixture = 4; }).says("mixture clusters of the BTF"));
  CHECK(refusal([](Material& m) { m.btf.shape.width = 1025; }).says("width"));
  CHECK(refusal([](Material& m) { m.btf.cores.pop_back(); }).says("cores of the BTF"));
  CHECK(refusal([](Material& m) { m.btf.cores[5] = INFINITY; }).says("element 5 of the cores of the BTF"));
  CHECK(refusal([](Material& m) { m.votf.y_bases.push_back(0); }, {.rank_y = 3}).says("y bases of the VOTF"));
  CHECK(refusal([](Material& m) { m.btf.rows.membership[3] = 3; }).says("memberships 3 of the BTF"));
  CHECK(refusal([](Material& m) { m.btf.rows.membership[3] = m.btf.rows.membership[2]; }).says("row 1"));
  CHECK(refusal([](Material& m) { m.btf.rows.coefficients[9] = NAN; }).says("element 9 of the coefficients"));
  CHECK(refusal([](Material& m) { m.btf.map.side = 6; }, {.map_side = 5}).says("map memberships of the BTF"));
  CHECK(refusal([](Material& m) { m.light_basis.pop_back(); }).says("basis of the light mode"));
  CHECK(refusal([](Material& m) { m.visibility = VisibilityForm::none; }).says("cores of the VOTF"));
  CHECK(refusal([](Material& m) { m.mapping.weight = -1; }).says("visibility mapping"));
  const test::SampleSize bumpy = {.relief_height = 0.1f, .relief_steps = 8};
  CHECK(refusal([](Material& m) { m.relief.low = NAN; }, bumpy).says("height of the relief"));
  CHECK(refusal([](Material& m) { m.relief.high = 1e9f; }, bumpy).says("height of the relief"));
  CHECK(refusal([](Material& m) { m.relief.low = 0.2f; }, bumpy).says("lowest height 0.2 is above"));
  CHECK(refusal([](Material& m) { m.relief.max_slope = 1e3f; }, bumpy).says("slope of the relief's views"));
  CHECK(refusal([](Material& m) { m.relief.steps = 65; }, bumpy).says("steps of the relief"));
  CHECK(refusal([](Material& m) { m.relief.steps = 0; }, bumpy).says("levels of the relief"));
  CHECK(refusal([](Material& m) { m.relief.levels.pop_back(); }, bumpy).says("levels of the relief"));
  CHECK(refusal([](Material& m) { m.relief.low = 0; }, {.relief_height = 0.1f})
            .says("0 steps, but its heights"));
  CHECK(refusal([](Material& m) {
          m.btf.shape = {9, 1024, 1024, 15, 9, 1, 1, 9, 1};
        }).says("expanded size of the BTF"));
}
