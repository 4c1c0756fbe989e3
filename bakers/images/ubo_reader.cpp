#include "bakers/images/ubo_reader.h"

#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <set>

#include "bakers/images/image_size.h"
#include "bakers/images/ubo_names.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

namespace fs = std::filesystem;

// Of one image: 32 million texels take 0.8 GB while they are read.
constexpr float max_half = 65504;  // the largest half float
constexpr std::size_t most_image_texels = std::size_t{1} << 25;

bool is_image(const fs::path& path) {
  static const std::set<std::string> endings{".png",  ".jpg", ".jpeg", ".exr", ".tif",
                                             ".tiff", ".bmp", ".hdr",  ".ppm"};
  std::string ending = path.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return endings.count(ending) != 0;
}

std::vector<fs::path> images_below(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file() && is_image(at->path())) found.push_back(at->path());
  if (error)
    throw Failure(NOOK_ERROR_BAD_FILE, "%.300s: cannot be read (%s)", folder.c_str(),
                  error.message().c_str());
  std::sort(found.begin(), found.end());
  return found;
}

float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

struct Pixels {
  int width = 0, height = 0;
  std::vector<float> rgb;  // linear, rows top first
};

Pixels read_image(const fs::path& path) {
  const auto fail = [&](const std::string& why) {
    throw Failure(NOOK_ERROR_BAD_FILE, "%.250s: cannot be read (%.150s)", path.c_str(), why.c_str());
  };
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) fail(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.nchannels < 1 || spec.depth > 1) fail("it is no flat image");
  std::error_code unknown;  // the size is then the largest number
  check_image_size(path.c_str(), spec.width, spec.height, most_image_texels, fs::file_size(path, unknown));
  // One channel stands for three; those above the third are not read.
  const std::size_t channels = spec.nchannels >= 3 ? 3 : 1,
                    texels = std::size_t(spec.width) * std::size_t(spec.height);
  const bool encoded = !spec.format.is_floating_point();
  std::vector<float> raw(channels * texels);
  if (!input->read_image(0, 0, 0, int(channels), OIIO::TypeDesc::FLOAT, raw.data())) fail(input->geterror());
  Pixels pixels{spec.width, spec.height, std::vector<float>(3 * texels)};
  for (std::size_t i = 0; i < texels; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = raw[i * channels + (channels == 3 ? c : 0)];
      // Raw materials hold half floats.
      if (!(std::abs(value) <= max_half))
        throw Failure(
            NOOK_ERROR_BAD_FILE,
            "%.250s: texel (%zu, %zu), counted from the upper left, is not a finite number of at most "
            "65504 in magnitude",
            path.c_str(), i % std::size_t(spec.width), i / std::size_t(spec.width));
      pixels.rgb[3 * i + c] = encoded ? linear_from_srgb(value) : value;
    }
  return pixels;
}

// Where the middle square begins; y counts from the bottom, images begin at the top.
struct Crop {
  std::uint32_t left = 0, top = 0;
};

void copy_image(const Pixels& pixels, Crop crop, std::size_t light, std::size_t view, RawMaterial& raw) {
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t x = 0; x < raw.width; ++x) {
      float* column = &raw.btf[((3 * light + c) * raw.views.size() + view) * raw.texels() + x * raw.height];
      for (std::size_t y = 0; y < raw.height; ++y) {
        const std::size_t row = crop.top + raw.height - 1 - y;
        column[y] = pixels.rgb[3 * (row * std::size_t(pixels.width) + crop.left + x) + c];
      }
    }
}

}  // namespace

RawMaterial read_ubo_folder(const fs::path& folder, std::uint32_t texels, const Progress& progress,
                            std::size_t most_bytes) {
  const std::vector<fs::path> paths = images_below(folder);
  std::vector<std::string> names;
  for (const fs::path& path : paths) names.push_back(path.filename().string());
  const UboGrid grid = arrange_ubo_names(names);

  RawMaterial raw;
  raw.name =
      folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
  raw.lights = grid.lights;
  raw.views = grid.views;
  const Pixels first = read_image(paths[grid.image[0]]);
  const auto width = std::uint32_t(first.width), height = std::uint32_t(first.height);
  if (texels > std::min(width, height))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a square of %u texels from images of %u x %u; use a smaller one", texels, width, height);
  raw.width = texels ? texels : width;
  raw.height = texels ? texels : height;
  const Crop crop{(width - raw.width) / 2, (height - raw.height) / 2};
  const std::size_t values = raw.light_rows() * raw.views.size() * raw.texels();
  if (values > most_bytes / sizeof(float))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%zu images of %u x %u texels are %.1f GiB of floats; take a smaller square (--texels)",
                  names.size(), raw.width, raw.height, double(values) * sizeof(float) / double(1 << 30));
  raw.btf.resize(values);

  // The fault of the first image is reported, for any order of threads.
  std::vector<std::string> fault(names.size());
  std::atomic<bool> failed{false}, stopped{false};
  std::mutex turn;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, grid.image.size(), [&](std::size_t cell) {
    const std::size_t i = grid.image[cell];
    if (stopped) return;
    try {
      const Pixels pixels = read_image(paths[i]);
      if (pixels.width != first.width || pixels.height != first.height)
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "%.200s: is of %d x %d texels, %.150s of %d x %d; all must be of one size",
                      paths[i].c_str(), pixels.width, pixels.height, names[grid.image[0]].c_str(),
                      first.width, first.height);
      copy_image(pixels, crop, cell / raw.views.size(), cell % raw.views.size(), raw);
    } catch (const Failure& e) {
      fault[i] = e.what();
      failed = true;
    }
    const std::lock_guard lock(turn);
    if (progress && !stopped && !progress(++done, names.size())) stopped = true;
  });
  if (stopped) throw Failure(NOOK_ERROR_CANCELLED, "stopped");
  if (failed)
    for (const std::string& text : fault)
      if (!text.empty()) throw Failure(NOOK_ERROR_BAD_FILE, "%s", text.c_str());
  round_to_halves(raw);
  return raw;
}

}  // namespace nook::bake::material
