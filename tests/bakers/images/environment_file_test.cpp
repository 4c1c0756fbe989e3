// Image files as environment maps: what comes through, and what is refused with which words.
#include "bakers/images/scene_file.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::probe;

namespace {

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("nook maps " + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, int width, int height, int channels,
                              OIIO::TypeDesc type, const std::vector<float>& values) const {
    const std::filesystem::path path = path_ / name;
    const auto out = OIIO::ImageOutput::create(path.string());
    REQUIRE(out);
    REQUIRE(out->open(path.string(), OIIO::ImageSpec(width, height, channels, type)));
    REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    REQUIRE(out->close());
    return path;
  }
  std::filesystem::path write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  std::filesystem::path path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// 8 x 4 texels, each another value, a bright one and a negative one.
std::vector<float> values_of(int channels) {
  std::vector<float> values;
  for (int i = 0; i < 8 * 4 * channels; ++i) values.push_back(0.5f + 0.0625f * float(i % 16));
  values[5] = 3000;
  values[7] = -1;
  return values;
}

std::string failure_of(const std::filesystem::path& path) {
  try {
    read_environment(path);
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    return failure.what();
  }
  return "";
}

}  // namespace

TEST_CASE("radiance comes through .exr exactly and through .hdr to a 256th") {
  const Folder folder;
  std::vector<float> expected = values_of(3);
  expected[7] = 0;  // negative light does not exist
  for (OIIO::TypeDesc type : {OIIO::TypeDesc(OIIO::TypeDesc::FLOAT), OIIO::TypeDesc(OIIO::TypeDesc::HALF)}) {
    const nook::bake::Environment map = read_environment(folder.write("a.exr", 8, 4, 3, type, values_of(3)));
    CHECK(map.width() == 8);
    CHECK(map.height() == 4);
    CHECK(std::equal(expected.begin(), expected.end(), map.rgb().begin(), map.rgb().end()));
  }
  const nook::bake::Environment map =
      read_environment(folder.write("a.hdr", 8, 4, 3, OIIO::TypeDesc::FLOAT, expected));
  for (std::size_t t = 0; t < map.texel_count(); ++t) {
    // RGBE keeps 8 bits of the largest channel of each texel.
    float largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, expected[3 * t + c]);
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(std::abs(map.rgb()[3 * t + c] - expected[3 * t + c]) <= largest / 128);
  }
  CHECK(read_environment(folder.write("b.exr", 8, 4, 4, OIIO::TypeDesc::FLOAT, values_of(4))).width() == 8);
}

TEST_CASE("images that are not maps of radiance are refused") {
  const Folder folder;
  const std::vector<float> values = values_of(3);
  CHECK(failure_of(folder.write("a.png", 8, 4, 3, OIIO::TypeDesc::UINT8, values))
            .find("png image has uint8 values") != std::string::npos);
  CHECK(failure_of(folder.write("square.exr", 4, 4, 3, OIIO::TypeDesc::FLOAT, values)).find("4 x 4 pixels") !=
        std::string::npos);
  CHECK(failure_of(folder.write("grey.exr", 8, 4, 1, OIIO::TypeDesc::FLOAT, values)).find("1 channels") !=
        std::string::npos);
  std::vector<float> broken = values;
  broken[1] = std::nanf("");
  broken[2] = std::numeric_limits<float>::infinity();
  CHECK(failure_of(folder.write("nan.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, broken)).find("2 of its values") !=
        std::string::npos);
  // Beyond max_radiance sums of squares have no float; a map of negative values is none.
  std::vector<float> bright = values;
  bright[4] = 1e16f;
  CHECK(failure_of(folder.write("bright.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, bright))
            .find("1 of its values are not finite or above 1e+15") != std::string::npos);
  bright[4] = 0.9e15f;
  CHECK(failure_of(folder.write("fine.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, bright)).empty());
  std::vector<float> negative = values;
  for (float& value : negative) value = -value;
  CHECK(failure_of(folder.write("negative.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, negative))
            .find("sum of its negative values") != std::string::npos);
  CHECK(failure_of(folder.write_text("text.hdr", "not an image")).find("cannot be read as an image") !=
        std::string::npos);
  CHECK(
      failure_of(folder.write_text("tall.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2147483647 +X 1\n"))
          .find("1 x 2147483647 pixels") != std::string::npos);
  CHECK_FALSE(failure_of(folder.write_text("empty.exr", "")).empty());
  CHECK_FALSE(failure_of(folder.path() / "missing.hdr").empty());
  CHECK_FALSE(failure_of(folder.path()).empty());
}

TEST_CASE("the first bytes of an image choose its reader, and no other is tried") {
  const Folder folder;
  const std::vector<float> values = values_of(3);
  const auto misnamed = folder.path() / "misnamed.hdr", sgi = folder.path() / "sgi.hdr";
  std::filesystem::rename(folder.write("a.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, values), misnamed);
  CHECK(read_environment(misnamed).width() == 8);
  // OpenImageIO reads files of SGI, whatever their names are.
  std::filesystem::rename(folder.write("a.sgi", 8, 4, 3, OIIO::TypeDesc::UINT8, values), sgi);
  CHECK(OIIO::ImageInput::open(sgi.string()));
  CHECK(failure_of(sgi).find("cannot be read as an image") != std::string::npos);
  CHECK(failure_of(folder.write_text("a.txt", "text")).find("neither PNG") != std::string::npos);
}

TEST_CASE("damaged images are refused at any length") {
  const Folder folder;
  for (const char* name : {"a.exr", "a.hdr"}) {
    std::ifstream file(folder.write(name, 8, 4, 3, OIIO::TypeDesc::FLOAT, values_of(3)), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    for (std::size_t size = 0; size + 16 < whole.size(); size += 37)
      CHECK_FALSE(failure_of(folder.write_text(std::string("cut-") + name, whole.substr(0, size))).empty());
  }
}

TEST_CASE(
    "an EXR file whose head says more rows or bytes than it has is refused before memory is taken for them") {
  const Folder folder;
  const std::string name = "a.exr", extent = "dataWindow";
  std::ifstream file(folder.write(name, 8, 4, 3, OIIO::TypeDesc::FLOAT, values_of(3)), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  // Behind the name its type "box2i", its size, the left, the top and the right edge.
  const std::size_t bottom = bytes.find(extent) + extent.size() + 1 + 6 + 4 + 12;
  const auto with_rows = [&](std::uint32_t rows) {
    for (std::size_t i = 0; i < 4; ++i) bytes[bottom + i] = char((rows - 1) >> (8 * i) & 255);
    return failure_of(folder.write_text(name, bytes));
  };
  CHECK(with_rows(4).empty());
  CHECK(with_rows(1u << 30).find("says that it has 1073741824 rows, too many for its") != std::string::npos);
  CHECK(with_rows(4).empty());
  // OpenEXR reads one byte of a compression, and takes the rest for further attributes.
  bytes[bytes.find("compression", bytes.find("compression") + 1) + 12] = 2;
  CHECK(with_rows(4).find("has 2 bytes, which is not the size") != std::string::npos);
}

TEST_CASE("a map whose head says more than its file holds is refused before memory is taken for it") {
  const Folder folder;
  const auto path = folder.write_text("head.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n");
  std::string message;
  try {
    read_environment(path);
  } catch (const Failure& failure) {
    message = failure.what();
  }
  CHECK(message.find("16384 x 8192 texels, too many for its") != std::string::npos);
}

TEST_CASE("an EXR file whose head has an attribute longer than the file is refused before memory is taken") {
  const Folder folder;
  std::ifstream file(folder.write("whole.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, values_of(3)),
                     std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  // A string of 2 GB, before the attributes that the file has behind its 8 bytes of magic and version.
  const std::string attribute("owner\0string\0\xf0\xff\xff\x7f", 17);
  const std::string damaged = whole.substr(0, 8) + attribute + whole.substr(8);
  CHECK(failure_of(folder.write_text("long.exr", damaged))
            .find("its attribute \"owner\" should have 2147483632 bytes") != std::string::npos);
  // The same attribute with the bytes that it claims passes; the table of rows is then at another place,
  // which the reader may refuse.
  const std::string sound =
      whole.substr(0, 8) + std::string("owner\0string\0\x04\0\0\0nook", 21) + whole.substr(8);
  CHECK(failure_of(folder.write_text("sound.exr", sound)).find("owner") == std::string::npos);
}
