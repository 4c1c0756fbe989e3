// Gives bytes to the readers of image files: textures of glTF files, environment maps, folders of measured
// images, measured materials in one file. Nothing may crash or take more memory than the file can fill, and
// every number is finite, whatever the bytes. OpenImageIO is not instrumented: what guides the fuzzer is the
// code round it. Built for libFuzzer with clang; elsewhere image_fuzz_replay.cpp drives it.
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>

#include "bakers/images/image_files.h"
#include "bakers/images/image_reader.h"
#include "bakers/images/scene_file.h"
#include "bakers/images/ubo_reader.h"
#include "bakers/material/btf_file.h"
#include "sdk/src/core/failure.h"
#include "tests/fuzz/image_kinds.h"

namespace {

namespace fs = std::filesystem;
using namespace nook::bake;
using nook::test::ImageKind;

void require(bool sound, const char* what) {
  if (sound) return;
  std::fprintf(stderr, "image_fuzz: %s\n", what);
  std::abort();
}

// A folder of this process, gone when it ends, with a folder for each ending. Files are written over: making
// and removing one takes longer than reading it.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("nook_image_fuzz_" + std::to_string(getpid()))) {
    for (const ImageKind& kind : nook::test::image_kinds) fs::create_directories(path_ / kind.ending);
    // Images of a few texels are read faster without others to hand work to.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  // The only file in its folder, named as a measured image for one light and one view.
  fs::path write(const char* ending, std::span<const std::byte> bytes) const {
    fs::path file = path_ / ending / (std::string("a_tl0_pl0_tv0_pv0.") + ending);
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    out.flush();
    return file;
  }

 private:
  fs::path path_;
};

// A file of a few bytes may say millions of texels before its reader finds out; 16384 for each byte are
// believed. Such images take a tenth of a second, and are not read.
bool takes_long(const std::unique_ptr<platform::ImageSource>& image, std::size_t file_bytes) {
  if (!image) return false;
  const platform::ImageHead& spec = image->head();
  const auto texels = std::uint64_t(std::max(spec.width, 0)) * std::uint64_t(std::max(spec.height, 0));
  return texels > 1 << 14 && texels >> 14 <= file_bytes;
}

bool takes_long(std::span<const std::byte> bytes) {
  const char* format = image_format_of(bytes);
  // Textures are of these two; others are refused before they are opened.
  if (!format || (format != std::string("png") && format != std::string("jpg"))) return false;
  std::string why;
  return takes_long(platform::image_codec().open(format, bytes, platform::ImageAlpha::unassociated, why),
                    bytes.size());
}

void read_texture(std::span<const std::byte> bytes) {
  if (takes_long(bytes)) return;
  const Texture texture = decode_texture({"image 0", {bytes.begin(), bytes.end()}});
  TextureUse use;
  use.image = 0;
  const TextureColour colour = texture.at(use, {0.3f, 0.6f});
  require(colour.rgb.x >= 0 && colour.rgb.x <= 1 && colour.alpha >= 0 && colour.alpha <= 1,
          "a texture's colour is outside of 0 to 1");
}

void read_map(const fs::path& file) {
  const Environment map = probe::read_environment(file);
  require(map.width() == 2 * map.height(), "a map is not twice as wide as high");
  for (std::size_t i = 0; i < map.texel_count(); ++i) {
    const nook::Vec3 radiance = map.texel(i);
    require(radiance.x >= 0 && std::isfinite(radiance.x + radiance.y + radiance.z),
            "a radiance is negative or not finite");
  }
}

void read_measured(const material::RawMaterial& raw) {
  require(raw.btf.size() == raw.light_rows() * raw.views.size() * raw.texels(),
          "a measured material has another size than its heads say");
  for (const float value : raw.btf) require(std::isfinite(value), "a measured value is not finite");
}

void read(const ImageKind& kind, std::span<const std::byte> bytes) {
  static const Folder folder;
  if (kind.reader == nook::test::ImageReader::texture) return read_texture(bytes);
  constexpr std::size_t most_bytes = 16u << 20;
  if (kind.reader == nook::test::ImageReader::measured_file)
    return read_measured(material::read_btf_file(bytes, 0, most_bytes));
  const fs::path file = folder.write(kind.ending, bytes);
  check_exr_head("the image", file);
  std::string why;
  if (takes_long(open_image(file, platform::ImageAlpha::associated, why), bytes.size())) return;
  kind.reader == nook::test::ImageReader::environment
      ? read_map(file)
      : read_measured(material::read_ubo_folder(file.parent_path(), 0));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size));
  try {
    read(nook::test::image_kinds[data[0] % nook::test::image_kinds.size()], bytes.subspan(1));
  } catch (const nook::Failure&) {
  }
  return 0;
}
