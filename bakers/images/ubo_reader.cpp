#include "bakers/images/ubo_reader.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>

#include "bakers/images/exr_head.h"
#include "bakers/images/image_files.h"
#include "bakers/images/image_reader.h"
#include "bakers/images/image_size.h"
#include "bakers/images/srgb.h"
#include "bakers/images/ubo_names.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

namespace fs = std::filesystem;

constexpr float max_half = 65504;  // the largest half float
// Of one image: 32 million texels take 0.8 GB while all of them are read.
constexpr std::size_t most_image_texels = std::size_t{1} << 25;

struct Size {
  int width = 0, height = 0;

  bool operator==(const Size&) const = default;
};

// A part of an image, texels from the upper left.
struct Region {
  int left = 0, top = 0;
  Size size;
};

// One image of the set, whose head is read when it is opened.
class UboImage {
 public:
  UboImage(const fs::path& path, FloatColours colours) : path_(path) {
    check_exr_head(path.c_str(), path);
    std::string why;
    input_ = open_image(path, {}, why);
    if (!input_) fail(why);
    const OIIO::ImageSpec& spec = input_->spec();
    if (spec.nchannels < 1 || spec.depth > 1) fail("it is no flat image");
    std::error_code unknown;  // the size is then the largest number
    check_image_size(path.c_str(), spec.width, spec.height, most_image_texels, fs::file_size(path, unknown));
    find_channels(spec, colours);
  }

  Size size() const { return {input_->spec().width, input_->spec().height}; }

  // Returns the texels of a region, linear, rows top first. Only the rows or the tiles that hold it are kept
  // in memory.
  std::vector<float> read(const Region& region) {
    const Region held = held_region(region);
    std::vector<float> raw(channels_read_ * std::size_t(held.size.width) * std::size_t(held.size.height));
    read_held(held, raw.data());
    std::vector<float> rgb;
    rgb.reserve(3 * std::size_t(region.size.width) * std::size_t(region.size.height));
    for (int y = region.top; y < region.top + region.size.height; ++y)
      for (int x = region.left; x < region.left + region.size.width; ++x) {
        const std::size_t texel =
            std::size_t(y - held.top) * std::size_t(held.size.width) + std::size_t(x - held.left);
        const Vec3 colour = linear_rgb(&raw[texel * channels_read_], x, y);
        rgb.insert(rgb.end(), {colour.x, colour.y, colour.z});
      }
    return rgb;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Failure(NOOK_ERROR_BAD_FILE, "%.250s: cannot be read (%.150s)", path_.c_str(), why.c_str());
  }

  // One channel stands for three; those above the third are not read, unless X, Y and Z are among them.
  void find_channels(const OIIO::ImageSpec& spec, FloatColours colours) {
    if (spec.nchannels < 3) return;
    channel_ = {0, 1, 2};
    if (spec.format.is_floating_point()) {
      const auto place = [&](const char* name) {
        const auto& names = spec.channelnames;
        return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
      };
      constexpr std::size_t most_channels = 8;  // those before X, Y and Z are held in memory too
      const std::array<std::size_t, 3> xyz{place("X"), place("Y"), place("Z")};
      const bool has_xyz = std::ranges::max(xyz) < std::min(spec.channelnames.size(), most_channels);
      if (has_xyz) channel_ = xyz;
      is_xyz_ = has_xyz || colours == FloatColours::xyz;
    }
    channels_read_ = std::ranges::max(channel_) + 1;
  }

  // The rows or the tiles that hold a region.
  Region held_region(const Region& region) const {
    const OIIO::ImageSpec& spec = input_->spec();
    if (spec.tile_width == 0) return {0, region.top, {spec.width, region.size.height}};
    const auto from = [](int begin, int tile) { return begin / tile * tile; };
    const auto to = [](int end, int tile, int whole) {
      return std::min((end + tile - 1) / tile * tile, whole);
    };
    const int left = from(region.left, spec.tile_width), top = from(region.top, spec.tile_height);
    const int right = to(region.left + region.size.width, spec.tile_width, spec.width);
    const int bottom = to(region.top + region.size.height, spec.tile_height, spec.height);
    return {left, top, {right - left, bottom - top}};
  }

  void read_held(const Region& held, float* raw) {
    const OIIO::ImageSpec& spec = input_->spec();
    const int left = spec.x + held.left, right = left + held.size.width;
    const int top = spec.y + held.top, bottom = top + held.size.height;
    const bool read = spec.tile_width == 0
                          ? read_rows(*input_, top, bottom, int(channels_read_), OIIO::TypeDesc::FLOAT, raw)
                          : input_->read_tiles(0, 0, left, right, top, bottom, spec.z, spec.z + 1, 0,
                                               int(channels_read_), OIIO::TypeDesc::FLOAT, raw);
    if (!read) fail(input_->geterror());
  }

  Vec3 linear_rgb(const float* texel, int x, int y) const {
    Vec3 colour{texel[channel_[0]], texel[channel_[1]], texel[channel_[2]]};
    if (!input_->spec().format.is_floating_point())
      colour = {linear_from_srgb(colour.x), linear_from_srgb(colour.y), linear_from_srgb(colour.z)};
    if (is_xyz_) colour = linear_rgb_from_xyz(colour);
    for (const float value : {colour.x, colour.y, colour.z})
      // Raw materials hold half floats.
      if (!(std::abs(value) <= max_half))
        throw Failure(
            NOOK_ERROR_BAD_FILE,
            "%.250s: texel (%d, %d), counted from the upper left, is not a finite number of at most "
            "65504 in magnitude",
            path_.c_str(), x, y);
    return colour;
  }

  fs::path path_;
  std::unique_ptr<OIIO::ImageInput> input_;
  std::array<std::size_t, 3> channel_{};  // of red, green and blue, or X, Y and Z
  std::size_t channels_read_ = 1;
  bool is_xyz_ = false;
};

// Of the raw material, y counts from the bottom; images begin at the top.
void copy_image(const std::vector<float>& rgb, std::size_t light, std::size_t view, RawMaterial& raw) {
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t x = 0; x < raw.width; ++x) {
      float* column = &raw.btf[((3 * light + c) * raw.views.size() + view) * raw.texels() + x * raw.height];
      for (std::size_t y = 0; y < raw.height; ++y)
        column[y] = rgb[3 * ((raw.height - 1 - y) * raw.width + x) + c];
    }
}

}  // namespace

RawMaterial read_ubo_folder(const fs::path& folder, std::uint32_t texels, const Progress& progress,
                            std::size_t most_bytes, FloatColours colours) {
  const std::vector<fs::path> paths = images_below(folder);
  std::vector<std::string> names;
  for (const fs::path& path : paths) names.push_back(path.filename().string());
  const UboGrid grid = arrange_ubo_names(names);

  RawMaterial raw;
  raw.name =
      folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
  raw.lights = grid.lights;
  raw.views = grid.views;
  const Size first = UboImage(paths[grid.image[0]], colours).size();
  const auto width = std::uint32_t(first.width), height = std::uint32_t(first.height);
  if (texels > std::min(width, height))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a square of %u texels from images of %u x %u; use a smaller one", texels, width, height);
  raw.width = texels ? texels : width;
  raw.height = texels ? texels : height;
  const Region middle{
      int((width - raw.width) / 2), int((height - raw.height) / 2), {int(raw.width), int(raw.height)}};
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
      UboImage image(paths[i], colours);
      const Size size = image.size();
      if (size != first)
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "%.200s: is of %d x %d texels, %.150s of %d x %d; all must be of one size",
                      paths[i].c_str(), size.width, size.height, names[grid.image[0]].c_str(), first.width,
                      first.height);
      copy_image(image.read(middle), cell / raw.views.size(), cell % raw.views.size(), raw);
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
