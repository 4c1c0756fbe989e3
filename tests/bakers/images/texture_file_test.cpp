// Encoded images to textures.
#include "bakers/images/scene_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cmath>

#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

EncodedImage encoded(const char* format, int width, int height, int channels,
                     const std::vector<std::uint8_t>& values) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput writer(bytes);
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  spec["oiio:UnassociatedAlpha"] = 1;
  const auto output = OIIO::ImageOutput::create(format, &writer);
  REQUIRE(output);
  REQUIRE(output->open(format, spec));
  REQUIRE(output->write_image(OIIO::TypeDesc::UINT8, values.data()));
  output->close();
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  return {"image 3 (\"wood\")", {first, first + bytes.size()}};
}

std::string failure_of(const EncodedImage& image) {
  try {
    decode_texture(image);
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    return failure.what();
  }
  return "";
}

}  // namespace

TEST_CASE("PNG and JPEG images become textures, of any number of channels") {
  TextureUse use;
  use.image = 0;
  use.nearest = true;
  const Texture rgba = decode_texture(encoded("t.png", 2, 1, 4, {255, 0, 128, 64, 255, 255, 255, 0}));
  const TextureColour left = rgba.at(use, {0.1f, 0.5f}), right = rgba.at(use, {0.9f, 0.5f});
  CHECK(left.rgb.x == 1);  // not multiplied by alpha
  CHECK(left.rgb.y == 0);
  CHECK(std::abs(left.rgb.z - 0.21586f) < 1e-5f);
  CHECK(std::abs(left.alpha - 64.0f / 255) < 1e-6f);
  CHECK(right.alpha == 0);
  const Texture grey = decode_texture(encoded("t.png", 1, 2, 1, {255, 0}));
  CHECK(grey.at(use, {0.5f, 0.1f}).rgb == Vec3{1, 1, 1});  // rows from the top
  CHECK(grey.at(use, {0.5f, 0.9f}).rgb == Vec3{0, 0, 0});
  CHECK(grey.at(use, {0.5f, 0.9f}).alpha == 1);
  const Texture photo = decode_texture(encoded("t.jpg", 8, 8, 3, std::vector<std::uint8_t>(192, 255)));
  CHECK(photo.at(use, {0.5f, 0.5f}).rgb.x > 0.97f);
}

TEST_CASE("images that are damaged or of other formats are refused by name") {
  EncodedImage image = encoded("t.png", 16, 16, 3, std::vector<std::uint8_t>(768, 7));
  image.bytes.resize(image.bytes.size() / 2);
  CHECK(failure_of(image).find("image 3 (\"wood\")") == 0);
  image.bytes.resize(20);
  CHECK(failure_of(image).find("image 3 (\"wood\")") == 0);
  image.bytes.assign(64, std::byte{'x'});
  CHECK(failure_of(image).find("neither PNG nor JPEG") != std::string::npos);
  image.bytes.clear();
  CHECK_FALSE(failure_of(image).empty());
}
