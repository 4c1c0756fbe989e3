#include <OpenImageIO/imageio.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "bakers/images/ubo_reader.h"
#include "bakers/material/raw_material.h"
#include "platform/peak_memory.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/images/temporary_folder.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;
namespace fs = std::filesystem;

namespace {

void write_image(const fs::path& path, int width, int height, const std::vector<float>& rgb) {
  const auto out = OIIO::ImageOutput::create(path.string());
  REQUIRE(out);
  OIIO::ImageSpec spec(width, height, 3,
                       path.extension() == ".exr" ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  REQUIRE(out->open(path.string(), spec));
  REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, rgb.data()));
  out->close();
}

std::string name_of(int tl, int pl, int tv, int pv, const char* ending = ".exr") {
  char text[80];
  std::snprintf(text, sizeof text, "00007_tl%03d_pl%03d_tv%03d_pv%03d%s", tl, pl, tv, pv, ending);
  return text;
}

// Two lights, three views; every texel has a value of its own.
constexpr int light_angles[2][2] = {{0, 0}, {30, 120}}, view_angles[3][2] = {{0, 0}, {30, 60}, {60, 180}};
void write_small_set(const fs::path& folder) {
  for (int l = 0; l < 2; ++l)
    for (int v = 0; v < 3; ++v) {
      const fs::path place = folder / ("tv" + std::to_string(v));
      fs::create_directories(place);
      std::vector<float> rgb;
      for (int i = 0; i < 4 * 6; ++i)
        for (int c = 0; c < 3; ++c)
          rgb.push_back(0.01f * float(i) + 0.25f * float(c) + float(l) + 2 * float(v));
      write_image(
          place / name_of(light_angles[l][0], light_angles[l][1], view_angles[v][0], view_angles[v][1]), 4, 6,
          rgb);
    }
}

std::string refusal(const fs::path& folder, std::uint32_t texels = 0) {
  try {
    read_ubo_folder(folder, texels);
  } catch (const Failure& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("names tell directions in any order, and those that do not are refused") {
  const auto a = parse_ubo_name("00012_tl015_pl060_tv030_pv090.png");
  REQUIRE(a);
  CHECK((a->light_tilt == 15 && a->light_azimuth == 60 && a->view_tilt == 30 && a->view_azimuth == 90));
  const auto b = parse_ubo_name("wool pv1.5 tv 2 tl3 pl4.exr");
  CHECK(!b);  // no number behind tv
  const auto c = parse_ubo_name("wool-pv1.5-tv2-tl3-pl4.exr");
  REQUIRE(c);
  CHECK((c->view_azimuth == 1.5f && c->light_azimuth == 4));
  CHECK(!parse_ubo_name("tl1_pl2_tv3.png"));
  CHECK(!parse_ubo_name("tl1_tl2_pl2_tv3_pv4.png"));
  CHECK(!parse_ubo_name("xtl1_pl2_tv3_pv4.png"));
}

TEST_CASE("a grid of names is ordered by tilt and azimuth; gaps and doubles are named") {
  std::vector<std::string> names;
  for (const auto& v : view_angles)
    for (const auto& l : light_angles) names.push_back(name_of(l[0], l[1], v[0], v[1]));
  const UboGrid grid = arrange_ubo_names(names);
  REQUIRE(grid.lights.size() == 2);
  REQUIRE(grid.views.size() == 3);
  CHECK(grid.image[1 * 3 + 2] == 5);
  CHECK(length(grid.views[1] - direction_from_angles(30, 60)) < 1e-6f);

  const auto message = [](const std::vector<std::string>& list) {
    try {
      arrange_ubo_names(list);
    } catch (const Failure& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  std::vector<std::string> gap = names;
  gap.erase(gap.begin() + 3);
  CHECK(message(gap).find("tl 30, pl 120, tv 30, pv 60 (1 of 6") != std::string::npos);
  std::vector<std::string> twice = names;
  twice.push_back(name_of(0, 90, 60, 180));  // an azimuth at tilt 0 is not a direction of its own
  CHECK(message(twice).find("same directions") != std::string::npos);
  std::vector<std::string> odd = names;
  odd.push_back("readme_first.png");
  CHECK(message(odd).find("readme_first.png") != std::string::npos);
  CHECK(message({}).find("no images") != std::string::npos);
}

TEST_CASE("lights that are moved out of the camera stand for those in its direction") {
  // UTIA's list moves such lights by some degrees.
  constexpr int three[3][2] = {{0, 0}, {30, 60}, {60, 180}};
  std::vector<std::string> names;
  for (const auto& v : three)
    for (const auto& l : three) {
      const bool moved = l[0] == v[0] && l[1] == v[1];
      names.push_back(name_of(l[0] + (moved ? 5 : 0), l[1], v[0], v[1]));
    }
  const UboGrid grid = arrange_ubo_names(names);
  REQUIRE((grid.lights.size() == 3 && grid.views.size() == 3));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(grid.image[i * 3 + i] == i * 3 + i);
    CHECK(length(grid.lights[i] - direction_from_angles(float(three[i][0]), float(three[i][1]))) < 1e-6f);
  }
  names[4] = name_of(50, 60, 30, 60);  // a light of its own
  CHECK_THROWS_AS(arrange_ubo_names(names), Failure);
}

TEST_CASE("XYZ of float images becomes linear RGB") {
  // The white point of D65 and the red primary, by IEC 61966-2-1; its matrix has four digits, a half float
  // eleven bits.
  const std::vector<float> xyz{0.9505f, 1.0f, 1.089f, 0.4124f, 0.2126f, 0.0193f};
  const float rgb[] = {1, 1, 1, 1, 0, 0};
  const auto matches = [&](const RawMaterial& raw) {
    for (std::size_t x = 0; x < 2; ++x)
      for (std::size_t c = 0; c < 3; ++c) CHECK(raw.btf[c * 2 + x] == Approx(rgb[3 * x + c]).margin(1e-3));
  };
  const TemporaryFolder folder;
  const fs::path path = folder.path / name_of(0, 0, 0, 0);
  write_image(path, 2, 1, xyz);
  matches(read_ubo_folder(folder.path, 0, {}, std::size_t{1} << 20, FloatColours::xyz));
  CHECK(read_ubo_folder(folder.path, 0).btf[0] == Approx(xyz[0]).margin(1e-3));
  // Channels by name, in an order of their own.
  const auto out = OIIO::ImageOutput::create(path.string());
  OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"A", "Z", "Y", "X"};
  REQUIRE(out->open(path.string(), spec));
  const std::vector<float> turned{1, xyz[2], xyz[1], xyz[0], 1, xyz[5], xyz[4], xyz[3]};
  REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, turned.data()));
  out->close();
  matches(read_ubo_folder(folder.path, 0));
}

TEST_CASE("a measured folder becomes a raw material, y up, linear") {
  const TemporaryFolder folder;
  write_small_set(folder.path);
  const RawMaterial raw = read_ubo_folder(folder.path, 0);
  REQUIRE((raw.width == 4 && raw.height == 6 && raw.lights.size() == 2 && raw.views.size() == 3 &&
           raw.mask.empty()));
  for (std::size_t l = 0; l < 2; ++l)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t v = 0; v < 3; ++v)
        for (std::size_t x = 0; x < 4; ++x)
          for (std::size_t y = 0; y < 6; ++y) {
            const std::size_t pixel = (5 - y) * 4 + x;  // images begin at the top
            const float wanted = 0.01f * float(pixel) + 0.25f * float(c) + float(l) + 2 * float(v);
            // Half floats of up to 8.
            REQUIRE(raw.btf[(((3 * l + c) * 3 + v) * 4 + x) * 6 + y] == Approx(wanted).margin(0.003));
          }
  const RawMaterial square = read_ubo_folder(folder.path, 2);
  REQUIRE((square.width == 2 && square.height == 2));
  CHECK(square.btf[0] == Approx(0.01f * float(3 * 4 + 1)).margin(1e-3));
}

TEST_CASE("the square of tiled images is the middle of them") {
  const TemporaryFolder folder;
  constexpr int side = 70, square = 20, tile = 16, left = (side - square) / 2;
  std::vector<float> rgb;
  for (int i = 0; i < side * side; ++i)
    for (int c = 0; c < 3; ++c) rgb.push_back(float(i % side) + 0.25f * float(i / side));
  const fs::path path = folder.path / name_of(0, 0, 0, 0, ".exr");
  const auto out = OIIO::ImageOutput::create(path.string());
  OIIO::ImageSpec spec(side, side, 3, OIIO::TypeDesc::FLOAT);
  spec.tile_width = spec.tile_height = tile;
  REQUIRE(out->open(path.string(), spec));
  REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, rgb.data()));
  out->close();
  const RawMaterial raw = read_ubo_folder(folder.path, square);
  REQUIRE((raw.width == square && raw.height == square));
  for (int x = 0; x < square; ++x)
    for (int y = 0; y < square; ++y) {
      const float wanted = float(left + x) + 0.25f * float(left + square - 1 - y);
      REQUIRE(raw.btf[std::size_t(x * square + y)] ==
              Approx(wanted).margin(0.02));  // half floats of up to 64
    }
}

TEST_CASE("a small square of a large image takes little memory") {
  const TemporaryFolder folder;
  constexpr int side = 5000;
  const fs::path path = folder.path / name_of(0, 0, 0, 0, ".png");
  // Row by row, so that the writing takes little memory as well.
  const auto out = OIIO::ImageOutput::create(path.string());
  OIIO::ImageSpec spec(side, side, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", 1);
  REQUIRE(out->open(path.string(), spec));
  const std::vector<std::uint8_t> row(3 * side, 255);
  for (int y = 0; y < side; ++y) REQUIRE(out->write_scanline(y, 0, OIIO::TypeDesc::UINT8, row.data()));
  out->close();
  const std::size_t before = platform::peak_bytes();
  const RawMaterial raw = read_ubo_folder(folder.path, 16);
  CHECK(raw.btf[0] == Approx(1));
  // All texels are 300 MB of floats.
  CHECK(platform::peak_bytes() - before < 100'000'000);
}

TEST_CASE("a texel beside the square may be anything") {
  const TemporaryFolder folder;
  std::vector<float> rgb(3 * 24, 0.5f);
  rgb[0] = std::nanf("");
  write_image(folder.path / name_of(0, 0, 0, 0), 4, 6, rgb);
  CHECK(refusal(folder.path).find("texel (0, 0)") != std::string::npos);
  CHECK(read_ubo_folder(folder.path, 2).btf[0] == 0.5f);
}

TEST_CASE("8-bit images are taken as sRGB") {
  const TemporaryFolder folder;
  const std::vector<float> grey(3 * 4, 128 / 255.0f);
  write_image(folder.path / name_of(0, 0, 0, 0, ".png"), 2, 2, grey);
  // IEC 61966-2-1: 128 / 255 is 0.2159 linear.
  CHECK(read_ubo_folder(folder.path, 0).btf[0] == Approx(0.2159).margin(2e-4));
}

TEST_CASE("faults of a measured folder are named") {
  const TemporaryFolder folder;
  CHECK(refusal(folder.path / "nowhere").find("cannot be read") != std::string::npos);
  CHECK(refusal(folder.path).find("no images") != std::string::npos);
  write_small_set(folder.path);
  CHECK(refusal(folder.path, 5).find("5 texels") != std::string::npos);
  const fs::path target = folder.path / "tv1" / name_of(30, 120, 30, 60);
  SECTION("another size") {
    write_image(target, 4, 5, std::vector<float>(3 * 20, 0.5f));
    const std::string text = refusal(folder.path);
    CHECK(text.find(target.filename().string()) != std::string::npos);
    CHECK(text.find("4 x 5") != std::string::npos);
  }
  SECTION("not a number") {
    std::vector<float> rgb(3 * 24, 0.5f);
    rgb[3 * (2 * 4 + 3) + 1] = std::nanf("");
    write_image(target, 4, 6, rgb);
    const std::string text = refusal(folder.path);
    CHECK(text.find(target.filename().string()) != std::string::npos);
    CHECK(text.find("texel (3, 2)") != std::string::npos);
  }
  SECTION("no image inside") {
    std::ofstream(target) << "not an image";
    CHECK(refusal(folder.path).find(target.filename().string()) != std::string::npos);
  }
  SECTION("missing") {
    fs::remove(target);
    CHECK(refusal(folder.path).find("tl 30, pl 120, tv 30, pv 60") != std::string::npos);
  }
  SECTION("too large") {
    CHECK_THROWS_AS(read_ubo_folder(folder.path, 0, {}, 1000), Failure);
  }
  SECTION("stopped") {
    CHECK_THROWS_AS(read_ubo_folder(folder.path, 0, [](std::size_t, std::size_t) { return false; }), Failure);
  }
}

TEST_CASE("an image whose head says more than its file holds is refused before memory is taken for it") {
  const TemporaryFolder folder;
  const fs::path image = folder.path / "00000_tl000_pl000_tv000_pv000.ppm";
  std::ofstream(image) << "P6\n5000 5000\n255\nabc";
  CHECK(refusal(folder.path).find("too many for its") != std::string::npos);
  std::ofstream(image) << "P6\n40000 40000\n255\nabc";
  CHECK(refusal(folder.path).find("40000 x 40000 texels") != std::string::npos);
}
