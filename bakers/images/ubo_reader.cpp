#include "bakers/images/ubo_reader.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include "bakers/images/image_files.h"
#include "bakers/images/image_reader.h"
#include "bakers/images/srgb.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

using Angles = std::pair<float, float>;  // tilt, azimuth

struct Pair {
  Angles light, view;
};

// The database moves a light by less than the angle between neighbouring light directions.
constexpr float most_moved_deg = 15;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Returns the number after a two-letter key. A key after another letter does not count.
std::optional<float> number_behind(std::string_view text, std::string_view key) {
  std::optional<float> found;
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    if (at > 0 && is_letter(text[at - 1])) continue;
    const char* first = text.data() + at + key.size();
    float value = 0;
    const auto [end, error] =
        std::from_chars(first, text.data() + text.size(), value, std::chars_format::fixed);
    if (error != std::errc() || end == first) continue;
    if (found) return std::nullopt;
    found = value;
  }
  return found;
}

// At a tilt of 0, all azimuths give the same direction.
Angles canonical(float tilt, float azimuth) {
  return {tilt, tilt == 0 ? 0 : azimuth};
}

std::vector<Vec3> directions_of(const std::map<Angles, std::size_t>& set) {
  std::vector<Vec3> directions;
  for (const auto& [angles, index] : set)
    directions.push_back(direction_from_angles(angles.first, angles.second));
  return directions;
}

void number(std::map<Angles, std::size_t>& set) {
  std::size_t next = 0;
  for (auto& [angles, index] : set) index = next++;
}

bool near(Angles a, Angles b) {
  const float cosine =
      dot(direction_from_angles(a.first, a.second), direction_from_angles(b.first, b.second));
  return cosine > std::cos(most_moved_deg * 3.14159265f / 180);
}

std::vector<Pair> read_pairs(std::span<const std::string> names) {
  std::vector<Pair> pairs;
  for (const std::string& name : names) {
    const auto angles = parse_ubo_name(name);
    if (!angles || angles->light_tilt < 0 || angles->light_tilt >= 90 || angles->view_tilt < 0 ||
        angles->view_tilt >= 90)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "the file name %.200s does not give the directions; it needs tl, pl, tv and pv once "
                    "each, followed by degrees, with tilts below 90",
                    name.c_str());
    pairs.push_back({canonical(angles->light_tilt, angles->light_azimuth),
                     canonical(angles->view_tilt, angles->view_azimuth)});
  }
  return pairs;
}

// Puts moved lights back to their original directions. The lamp cannot be at the camera's position, so the
// database moves the light if light and view directions are equal. A moved light exists for only one view.
// Its image replaces the missing image of the equal directions.
void put_moved_lights_back(std::vector<Pair>& pairs) {
  std::map<Angles, std::set<Angles>> views_of;
  for (const Pair& p : pairs) views_of[p.light].insert(p.view);
  for (Pair& p : pairs) {
    const auto camera = views_of.find(p.view);
    if (views_of[p.light].size() == 1 && camera != views_of.end() && camera->second.size() > 1 &&
        !camera->second.contains(p.view) && near(p.light, p.view))
      p.light = p.view;
  }
}

[[noreturn]] void fail_of_missing(const UboGrid& grid, const std::map<Angles, std::size_t>& lights,
                                  const std::map<Angles, std::size_t>& views, std::size_t none) {
  const auto missing = std::size_t(std::count(grid.image.begin(), grid.image.end(), none));
  const auto first = std::size_t(std::find(grid.image.begin(), grid.image.end(), none) - grid.image.begin());
  const Angles light = std::next(lights.begin(), std::ptrdiff_t(first / views.size()))->first;
  const Angles view = std::next(views.begin(), std::ptrdiff_t(first % views.size()))->first;
  throw Failure(NOOK_ERROR_BAD_FILE,
                "there is no image for tl %g, pl %g, tv %g, pv %g (%zu of %zu images are missing); you need "
                "one image for each pair of a light and a view direction",
                double(light.first), double(light.second), double(view.first), double(view.second), missing,
                grid.image.size());
}

}  // namespace

std::optional<UboAngles> parse_ubo_name(std::string_view name) {
  // The extension's dot must not count as a decimal point.
  if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) name = name.substr(0, dot);
  const auto tl = number_behind(name, "tl"), pl = number_behind(name, "pl");
  const auto tv = number_behind(name, "tv"), pv = number_behind(name, "pv");
  if (!tl || !pl || !tv || !pv) return std::nullopt;
  return UboAngles{*tl, *pl, *tv, *pv};
}

UboGrid arrange_ubo_names(std::span<const std::string> names) {
  if (names.empty())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "there are no images; you need one for each pair of a light and a view direction");
  std::vector<Pair> pairs = read_pairs(names);
  put_moved_lights_back(pairs);
  std::map<Angles, std::size_t> lights, views;
  for (const Pair& p : pairs) {
    lights[p.light];
    views[p.view];
  }
  number(lights);
  number(views);
  UboGrid grid{directions_of(lights), directions_of(views), {}};
  const std::size_t none = names.size();
  grid.image.assign(lights.size() * views.size(), none);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::size_t& cell = grid.image[lights[pairs[i].light] * views.size() + views[pairs[i].view]];
    if (cell != none)
      throw Failure(NOOK_ERROR_BAD_FILE, "%.150s and %.150s have the same directions; remove one of them",
                    names[cell].c_str(), names[i].c_str());
    cell = i;
  }
  if (grid.image.size() != names.size()) fail_of_missing(grid, lights, views, none);
  return grid;
}

namespace {

namespace fs = std::filesystem;

constexpr float max_half = 65504;  // the largest half float
// The maximum size of an image. Reading 32 million texels at once takes 0.8 GB.
constexpr std::size_t most_image_texels = std::size_t{1} << 25;

struct Size {
  int width = 0, height = 0;

  bool operator==(const Size&) const = default;
};

// A part of an image. Texels are counted from the upper left corner.
struct Region {
  int left = 0, top = 0;
  Size size;
};

// One image of the set. The constructor opens the file and reads its header.
class UboImage {
 public:
  UboImage(const fs::path& path, FloatColours colours) : path_(path) {
    check_exr_head(path.c_str(), path);
    std::string why;
    input_ = open_image(path, platform::ImageAlpha::associated, why);
    if (!input_) fail(why);
    const platform::ImageHead& spec = input_->head();
    if (spec.channels < 1 || spec.depth > 1) fail("it is not a flat image");
    std::error_code unknown;  // on an error, file_size returns the maximum value
    check_image_size(path.c_str(), spec.width, spec.height, most_image_texels, fs::file_size(path, unknown));
    find_channels(spec, colours);
  }

  Size size() const { return {input_->head().width, input_->head().height}; }

  // Returns the texels of a region as linear values. The first row is the top. Only the rows or tiles that
  // contain the region are kept in memory.
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

  // An image with one channel uses this channel for all three. Channels after the third are not read, unless
  // X, Y and Z are among them.
  void find_channels(const platform::ImageHead& spec, FloatColours colours) {
    if (spec.channels < 3) return;
    channel_ = {0, 1, 2};
    if (spec.is_floating_point) {
      const auto place = [&](const char* name) {
        const auto& names = spec.channel_names;
        return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
      };
      constexpr std::size_t most_channels = 8;  // channels before X, Y and Z also take memory
      const std::array<std::size_t, 3> xyz{place("X"), place("Y"), place("Z")};
      const bool has_xyz = std::ranges::max(xyz) < std::min(spec.channel_names.size(), most_channels);
      if (has_xyz) channel_ = xyz;
      is_xyz_ = has_xyz || colours == FloatColours::xyz;
    }
    channels_read_ = std::ranges::max(channel_) + 1;
  }

  // Returns the rows or tiles that contain a region.
  Region held_region(const Region& region) const {
    const platform::ImageHead& spec = input_->head();
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
    const int right = held.left + held.size.width, bottom = held.top + held.size.height;
    const int channels = int(channels_read_);
    const bool read = input_->head().tile_width == 0
                          ? input_->read_rows(held.top, bottom, channels, raw)
                          : input_->read_tiles(held.left, right, held.top, bottom, channels, raw);
    if (!read) fail(input_->why());
  }

  Vec3 linear_rgb(const float* texel, int x, int y) const {
    Vec3 colour{texel[channel_[0]], texel[channel_[1]], texel[channel_[2]]};
    if (!input_->head().is_floating_point)
      colour = {linear_from_srgb(colour.x), linear_from_srgb(colour.y), linear_from_srgb(colour.z)};
    if (is_xyz_) colour = linear_rgb_from_xyz(colour);
    for (const float value : {colour.x, colour.y, colour.z})
      // Raw materials store half floats.
      if (!(std::abs(value) <= max_half))
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "%.250s: texel (%d, %d), counted from the upper left, is "
                      "not finite or exceeds 65504 in magnitude",
                      path_.c_str(), x, y);
    return colour;
  }

  fs::path path_;
  std::unique_ptr<platform::ImageSource> input_;
  std::array<std::size_t, 3> channel_{};  // index of red, green and blue, or X, Y and Z
  std::size_t channels_read_ = 1;
  bool is_xyz_ = false;
};

// Copies an image to the raw material and flips it: the first row is the bottom in a raw material, and the
// top in an image.
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
                  "a square of %u texels is larger than the images (%u x %u); use a smaller one", texels,
                  width, height);
  raw.width = texels ? texels : width;
  raw.height = texels ? texels : height;
  const Region middle{
      int((width - raw.width) / 2), int((height - raw.height) / 2), {int(raw.width), int(raw.height)}};
  const std::size_t values = raw.light_rows() * raw.views.size() * raw.texels();
  if (values > most_bytes / sizeof(float))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%zu images of %u x %u texels take %.1f GiB as floats, which is "
                  "too much; choose a smaller square (--texels)",
                  names.size(), raw.width, raw.height, double(values) * sizeof(float) / double(1 << 30));
  raw.btf.resize(values);

  // Reports the error of the first faulty image, in whatever order the threads run.
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
                      "%.200s has %d x %d texels, but %.150s has %d x %d; all images need the same size",
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
