// Planted sets of maps of physically based materials.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

#include "bakers/images/pbr_reader.h"
#include "bakers/material/pbr_maps.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/images/temporary_folder.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;
namespace fs = std::filesystem;

namespace {

using Pixel = std::function<float(int x, int y, int channel)>;

void write_image(const fs::path& path, int width, int height, int channels, OIIO::TypeDesc type,
                 const Pixel& pixel) {
  std::vector<float> values;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) values.push_back(pixel(x, y, c));
  const auto out = OIIO::ImageOutput::create(path.string());
  REQUIRE(out);
  OIIO::ImageSpec spec(width, height, channels, type);
  spec["oiio:UnassociatedAlpha"] = 1;
  REQUIRE(out->open(path.string(), spec));
  REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  out->close();
}

float constant_colour(int, int, int c) {
  return c == 0 ? 1.0f : c == 1 ? 0.5f : 0.0f;
}

std::string refusal(const fs::path& folder) {
  try {
    read_pbr_folder(folder, 8);
  } catch (const Failure& e) {
    CHECK(e.code() == NOOK_ERROR_BAD_FILE);
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("names tell maps by their last word that stands for one") {
  const auto map = [](const char* name) { return parse_pbr_name(name).value().map; };
  CHECK(map("Bricks090_4K-PNG_Color.png") == PbrMap::base_colour);
  CHECK(map("rough_wood_diff_4k.jpg") == PbrMap::base_colour);
  CHECK(map("cloth_base_color.tif") == PbrMap::base_colour);
  CHECK(map("T_Rock_BaseColor.tga") == PbrMap::base_colour);
  CHECK(map("albedo.png") == PbrMap::base_colour);
  CHECK(map("rusty-metal-roughness.exr") == PbrMap::roughness);
  CHECK(map("color_tiles_rough_2k.png") == PbrMap::roughness);
  CHECK(map("tile_Glossiness.png") == PbrMap::gloss);
  CHECK(map("metal.png") == PbrMap::metalness);
  CHECK(map("plate_Metallic.png") == PbrMap::metalness);
  CHECK(map("bark_disp_4k.png") == PbrMap::height);
  CHECK(map("Ground037_2K_Displacement.jpg") == PbrMap::height);
  CHECK(map("cloth_arm_2k.jpg") == PbrMap::packed);
  for (const char* name : {"wood_nor_gl_4k.exr", "Wood_NormalGL.png", "wood-normal-ogl.png", "normal.png"}) {
    CHECK(map(name) == PbrMap::normal);
    CHECK_FALSE(parse_pbr_name(name)->green_down);
  }
  for (const char* name : {"wood_nor_dx_4k.exr", "Wood_NormalDX.png", "wood_normaldx.png"}) {
    CHECK(map(name) == PbrMap::normal);
    CHECK(parse_pbr_name(name)->green_down);
  }
  for (const char* name : {"Metal032_1K-PNG.png", "wood_ao_4k.jpg", "Wood_AmbientOcclusion.png",
                           "leaf_opacity.png", "readme.png", "", "....", "1234.exr", "rough_diff_spec.png"})
    CHECK_FALSE(parse_pbr_name(name));
}

TEST_CASE("of two maps for one purpose the better one is taken, and doubles are refused") {
  const std::vector<std::string> names{"a_NormalDX.png", "a_Gloss.png",     "a_arm.png",   "a_color.png",
                                       "a_NormalGL.png", "a_roughness.png", "a_height.png"};
  const PbrFiles files = arrange_pbr_names(names);
  CHECK(files.base_colour == 3);
  CHECK(files.normal == 4u);
  CHECK_FALSE(files.green_down);
  CHECK(files.roughness == 5u);
  CHECK_FALSE(files.roughness_is_gloss);
  CHECK(files.height == 6u);
  CHECK(files.packed == 2u);
  CHECK_FALSE(files.metalness);
  const PbrFiles down =
      arrange_pbr_names(std::vector<std::string>{"a_color.png", "a_NormalDX.png", "a_gloss.png"});
  CHECK(down.green_down);
  CHECK(down.roughness_is_gloss);
  CHECK_THROWS_AS(arrange_pbr_names(std::vector<std::string>{"albedo.png", "diffuse.png"}), Failure);
  CHECK_THROWS_AS(arrange_pbr_names(std::vector<std::string>{"normal.png"}), Failure);
  CHECK_THROWS_AS(arrange_pbr_names({}), Failure);
}

TEST_CASE("a planted set of other sizes and depths arrives as it was planted") {
  const TemporaryFolder folder;
  write_image(folder.path / "cloth_basecolor.png", 16, 16, 4, OIIO::TypeDesc::UINT8, [](int, int y, int c) {
    return c == 3 ? 0.25f : y < 8 ? constant_colour(0, 0, c) : 0.0f;
  });
  write_image(folder.path / "cloth_height.png", 64, 64, 1, OIIO::TypeDesc::UINT16,
              [](int x, int, int) { return (float(x) + 0.5f) / 64; });
  write_image(folder.path / "cloth_roughness.jpg", 8, 8, 1, OIIO::TypeDesc::UINT8,
              [](int, int, int) { return 0.6f; });
  write_image(folder.path / "cloth_normal.exr", 32, 32, 3, OIIO::TypeDesc::FLOAT, [](int x, int, int c) {
    const Vec3 n = normalised({x % 2 ? -0.5f : 0.1f, 0.4f, 1});
    return 0.5f + 0.5f * (c == 0 ? n.x : c == 1 ? n.y : n.z);
  });
  write_image(folder.path / "preview.png", 3, 5, 3, OIIO::TypeDesc::UINT8, constant_colour);
  const PbrFolder read = read_pbr_folder(folder.path, 8);
  CHECK(read.file_names == std::vector<std::string>{"cloth_basecolor.png", "cloth_normal.exr",
                                                    "cloth_height.png", "cloth_roughness.jpg"});
  const PbrMaps& maps = read.maps;
  REQUIRE(maps.base_colour.size() == 64);
  // Images begin at the top of the tile, which ends in y. 0.5 is a byte of 128, 0.2159 linear (IEC
  // 61966-2-1). Alpha does not darken it.
  CHECK(length(maps.base_colour[6 * 8 + 3] - Vec3{1, 0.2159f, 0}) < 1e-3f);
  CHECK(length(maps.base_colour[1 * 8 + 3]) < 1e-6f);
  for (std::size_t x = 1; x < 7; ++x)
    CHECK(maps.height[2 * 8 + x] == Approx((double(x) + 0.5) / 8).margin(1e-4));  // 16 bits
  for (const float w : maps.squared_width)
    // A byte of roughness 0.6 is right to 1/510; a fourth power has four times the relative error of 0.6.
    CHECK(double(w) == Approx(std::pow(0.6, 4)).epsilon(4.0 / 510 / 0.6));
  CHECK(maps.metalness.empty());
  for (const MapSlope& s : maps.slope) {
    // Slopes of -0.1 and 0.5 along x in turn: their mean is 0.2 and their variance 0.09, halved over both
    // axes.
    CHECK(s.x == Approx(0.2).margin(1e-4));
    CHECK(s.y == Approx(-0.4).margin(1e-4));
    CHECK(s.variance == Approx(0.045).margin(1e-4));
  }
}

TEST_CASE("an image of heights alone is read as the map of a set, its rows from the top") {
  const TemporaryFolder folder;
  const fs::path file = folder.path / "heights.tif";
  write_image(file, 8, 8, 1, OIIO::TypeDesc::FLOAT, [](int, int y, int) { return 2.0f + float(y); });
  PbrMaps maps;
  maps.side = 8;
  maps.height = read_height_map(file, maps.side);
  REQUIRE(maps.height.size() == 64);
  for (std::size_t y = 1; y < 7; ++y) CHECK(maps.height[y * 8 + 3] == Approx(9.0f - float(y)));
  const PbrMaps own = read_height_image(file);
  CHECK(own.side == 8);
  CHECK(own.height == maps.height);
  CHECK(heights_at(own, 2).height == read_height_map(file, 2));
  // 7 of the image's units of 0.05 m, on a tile of 2 m, around 0.
  const std::vector<float> tiles = heights_of_map(maps, 0.05f, 2);
  const auto [low, high] = std::minmax_element(tiles.begin(), tiles.end());
  CHECK(*low == Approx(-*high));
  CHECK(tiles[3] - tiles[11] == Approx(0.05f / 2 * (maps.height[3] - maps.height[11])));
  CHECK_THROWS_AS(heights_of_map(maps, 0.05f, 0), Failure);
  CHECK_THROWS_AS(heights_of_map(maps, 1, 2), Failure);  // higher than half a tile
  CHECK_THROWS_AS(read_height_map(folder.path / "none.tif", 8), Failure);
}

TEST_CASE("packed maps and gloss stand for roughness, and green may point down") {
  const TemporaryFolder folder;
  write_image(folder.path / "a_albedo.exr", 4, 4, 3, OIIO::TypeDesc::FLOAT, constant_colour);
  write_image(folder.path / "a_nor_dx.exr", 4, 4, 3, OIIO::TypeDesc::FLOAT, [](int, int, int c) {
    const Vec3 n = normalised({0, 0.5f, 1});
    return 0.5f + 0.5f * (c == 0 ? n.x : c == 1 ? n.y : n.z);
  });
  write_image(folder.path / "a_orm.exr", 4, 4, 3, OIIO::TypeDesc::FLOAT,
              [](int, int, int c) { return 0.3f * float(c + 1); });
  PbrMaps maps = read_pbr_folder(folder.path, 4).maps;
  CHECK(length(maps.base_colour[5] - Vec3{1, 0.5f, 0}) < 1e-6f);  // float images are linear
  CHECK(maps.slope[0].y == Approx(0.5).margin(1e-5));
  CHECK(maps.squared_width[0] == Approx(std::pow(0.6, 4)).epsilon(1e-5));
  CHECK(maps.metalness[0] == Approx(0.9).epsilon(1e-6));
  CHECK(maps.height.empty());
  write_image(folder.path / "a_smoothness.exr", 4, 4, 1, OIIO::TypeDesc::FLOAT,
              [](int, int, int) { return 0.8f; });
  maps = read_pbr_folder(folder.path, 4).maps;
  CHECK(maps.squared_width[0] == Approx(std::pow(0.2, 4)).epsilon(1e-5));
  CHECK(maps.metalness[0] == Approx(0.9).epsilon(1e-6));
}

TEST_CASE("folders that hold no set, and images that are not maps, are refused by name") {
  const TemporaryFolder folder;
  CHECK(refusal(folder.path).find("no image") != std::string::npos);
  CHECK(refusal(folder.path / "nothing").find("cannot be read") != std::string::npos);
  write_image(folder.path / "a_height.png", 4, 4, 1, OIIO::TypeDesc::UINT8, constant_colour);
  CHECK(refusal(folder.path).find("a_height.png") != std::string::npos);
  write_image(folder.path / "a_color.png", 4, 4, 3, OIIO::TypeDesc::UINT8, constant_colour);
  CHECK(refusal(folder.path).empty());
  write_image(folder.path / "a_rough.png", 4, 6, 1, OIIO::TypeDesc::UINT8, constant_colour);
  CHECK(refusal(folder.path).find("a_rough.png has 4 x 6") != std::string::npos);
  fs::remove(folder.path / "a_rough.png");
  write_image(folder.path / "a_normal.png", 4, 4, 1, OIIO::TypeDesc::UINT8, constant_colour);
  CHECK(refusal(folder.path).find("1 channels") != std::string::npos);
  fs::remove(folder.path / "a_normal.png");
  write_image(folder.path / "a_disp.exr", 4, 4, 1, OIIO::TypeDesc::FLOAT, [](int x, int y, int) {
    return x == 1 && y == 2 ? std::numeric_limits<float>::quiet_NaN() : 0;
  });
  CHECK(refusal(folder.path).find("have names of the same kind of map") != std::string::npos);
  fs::remove(folder.path / "a_height.png");
  CHECK(refusal(folder.path).find("texel (1, 2)") != std::string::npos);
  fs::remove(folder.path / "a_disp.exr");
  std::ofstream(folder.path / "a_gloss.png") << "no image";
  CHECK(refusal(folder.path).find("a_gloss.png") != std::string::npos);
}
