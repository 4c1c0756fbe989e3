#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tests/bakers/material/btf_writer.h"
#include "tests/fuzz/image_kinds.h"
#include "tests/fuzz/seeds.h"

namespace nook::test {
namespace {

std::vector<std::byte> written(const char* ending, int width, int height, int channels) {
  const auto path =
      std::filesystem::temp_directory_path() / ("nook_image_seed_" + std::to_string(getpid()) + "." + ending);
  const std::string kind = ending;
  OIIO::ImageSpec spec(width, height, channels,
                       kind == "exr"   ? OIIO::TypeDesc::HALF
                       : kind == "hdr" ? OIIO::TypeDesc::FLOAT
                                       : OIIO::TypeDesc::UINT8);
  std::vector<float> values(std::size_t(width * height * channels));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i * 7 % 16) / 16;
  const auto output = OIIO::ImageOutput::create(path.string());
  if (!output || !output->open(path.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, values.data()) || !output->close())
    throw std::runtime_error("an image could not be written: " + path.string());
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::filesystem::remove(path);
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  return {first, first + bytes.size()};
}

}  // namespace

std::vector<Seed> seeds() {
  std::vector<Seed> made;
  for (std::size_t k = 0; k < image_kinds.size(); ++k) {
    const bool alpha = k == 0 || k == 4;
    std::vector<std::byte> file = image_kinds[k].reader == ImageReader::measured_file
                                      ? write_btf_file(bake::material::test::small_btf())
                                      : written(image_kinds[k].ending, 8, 4, alpha ? 4 : 3);
    file.insert(file.begin(), std::byte(k));
    made.push_back({"image_" + std::to_string(k), file});
  }
  return made;
}

}  // namespace nook::test
