// Gives bytes to the readers of image files: textures of glTF files, environment maps, folders of measured
// images, measured materials in one file. Nothing may crash or take more memory than the file can fill, and
// every number is finite, whatever the bytes. OpenImageIO is not instrumented: what guides the fuzzer is the
// code round it. Built for libFuzzer with clang; elsewhere image_fuzz_replay.cpp drives it.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>

#include "bakers/images/environment_file.h"
#include "bakers/images/texture_file.h"
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

// A folder of this process, gone when it ends.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("nook_image_fuzz_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  // The only file there, named as a measured image for one light and one view.
  fs::path write(const char* ending, std::span<const std::byte> bytes) const {
    fs::path file = path_ / (std::string("a_tl0_pl0_tv0_pv0.") + ending);
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    out.flush();
    return file;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void read_texture(std::span<const std::byte> bytes) {
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
  try {
    kind.reader == nook::test::ImageReader::environment
        ? read_map(file)
        : read_measured(material::read_ubo_folder(folder.path(), 0));
  } catch (const nook::Failure&) {
  }
  fs::remove(file);
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
