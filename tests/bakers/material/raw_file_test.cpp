#include "bakers/material/raw_material.h"

#include <cmath>
#include <limits>
#include <string>

#include "bakers/raytrace/hemisphere.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;

namespace {

RawMaterial small_raw() {
  RawMaterial raw;
  raw.name = "small";
  raw.lights = spiral_directions(4);
  raw.views = spiral_directions(5);
  raw.width = 3;
  raw.height = 7;
  raw.btf.resize(raw.light_rows() * raw.views.size() * raw.texels());
  for (std::size_t i = 0; i < raw.btf.size(); ++i) raw.btf[i] = unit_float(mix_bits(i));
  raw.mask.resize(raw.views.size() * raw.texels());
  for (std::size_t i = 0; i < raw.mask.size(); ++i) raw.mask[i] = float(mix_bits(i) & 1);
  round_to_halves(raw);
  return raw;
}

std::string refusal(std::span<const std::byte> bytes) {
  try {
    read_raw_material(bytes);
  } catch (const Failure& e) {
    CHECK(e.code() == NOOK_ERROR_BAD_FILE);
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a raw material comes back from its file bit by bit") {
  RawMaterial raw = small_raw();
  RawMaterial back = read_raw_material(write_raw_material(raw));
  CHECK(back.name == raw.name);
  CHECK(back.btf == raw.btf);
  CHECK(back.mask == raw.mask);
  CHECK((back.width == 3 && back.height == 7));
  REQUIRE(back.views.size() == 5);
  CHECK(back.views[3] == raw.views[3]);
  raw.mask.clear();
  CHECK(read_raw_material(write_raw_material(raw)).mask.empty());
}

TEST_CASE("a texel that is not finite is named by light, channel, view and place") {
  RawMaterial raw = small_raw();
  raw.btf[(((3 * 2 + 1) * 5 + 4) * 3 + 2) * 7 + 6] = std::nanf("");
  raw.btf[(((3 * 3 + 0) * 5 + 0) * 3 + 0) * 7 + 0] = std::numeric_limits<float>::infinity();
  CHECK(refusal(write_raw_material(raw)).find("light 2, channel 1, view 4: texel (2, 6)") !=
        std::string::npos);
}

TEST_CASE("truncated, enlarged and foreign files are refused") {
  const std::vector<std::byte> good = write_raw_material(small_raw());
  for (const std::size_t size : {std::size_t{0}, std::size_t{39}, good.size() / 2, good.size() - 1})
    CHECK(!refusal(std::span(good).first(size)).empty());
  // Sizes that the sections do not hold, behind a right checksum.
  const Container file(good, raw_kind);
  const std::size_t head = good.size() - file.section("HEAD").remaining() - file.section("DIRS").remaining() -
                           file.section("BTF_").remaining() - file.section("MASK").remaining();
  for (const std::size_t field : {0, 4, 8, 12}) {
    std::vector<std::byte> bad = good;
    bad[head + field + 1] = std::byte{0x7f};
    repair_checksum(bad);
    CHECK(!refusal(bad).empty());
  }
  RawMaterial twice = small_raw();
  twice.views[2] = twice.views[1];
  CHECK(refusal(write_raw_material(twice)).find("view directions 1 and 2") != std::string::npos);
}
