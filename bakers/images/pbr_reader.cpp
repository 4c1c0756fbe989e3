#include "bakers/images/pbr_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <memory>

#include "bakers/images/image_files.h"
#include "bakers/images/image_reader.h"
#include "bakers/images/srgb.h"
#include "bakers/material/periodic_tile.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

bool is_upper(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// Splits "Bricks090_4K_NormalGL" into bricks, k, normal, gl.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  char before = 0;
  for (const char c : name) {
    const bool starts = is_letter(c) && (!is_letter(before) || (is_upper(c) && !is_upper(before)));
    if (starts) words.emplace_back();
    if (is_letter(c)) words.back() += char(std::tolower(static_cast<unsigned char>(c)));
    before = c;
  }
  return words;
}

struct Word {
  std::string_view text;
  std::optional<PbrMap> map;  // none: a kind of map that we do not use
};

constexpr std::array words{Word{"albedo", PbrMap::base_colour},
                           Word{"basecolor", PbrMap::base_colour},
                           Word{"basecolour", PbrMap::base_colour},
                           Word{"color", PbrMap::base_colour},
                           Word{"colour", PbrMap::base_colour},
                           Word{"col", PbrMap::base_colour},
                           Word{"diffuse", PbrMap::base_colour},
                           Word{"diff", PbrMap::base_colour},
                           Word{"alb", PbrMap::base_colour},
                           Word{"normal", PbrMap::normal},
                           Word{"normals", PbrMap::normal},
                           Word{"nor", PbrMap::normal},
                           Word{"norm", PbrMap::normal},
                           Word{"nrm", PbrMap::normal},
                           Word{"normalgl", PbrMap::normal},
                           Word{"normaldx", PbrMap::normal},
                           Word{"roughness", PbrMap::roughness},
                           Word{"rough", PbrMap::roughness},
                           Word{"rgh", PbrMap::roughness},
                           Word{"gloss", PbrMap::gloss},
                           Word{"glossiness", PbrMap::gloss},
                           Word{"smoothness", PbrMap::gloss},
                           Word{"metalness", PbrMap::metalness},
                           Word{"metallic", PbrMap::metalness},
                           Word{"metal", PbrMap::metalness},
                           Word{"metallness", PbrMap::metalness},
                           Word{"height", PbrMap::height},
                           Word{"displacement", PbrMap::height},
                           Word{"disp", PbrMap::height},
                           Word{"bump", PbrMap::height},
                           Word{"arm", PbrMap::packed},
                           Word{"orm", PbrMap::packed},
                           Word{"ao", {}},
                           Word{"occlusion", {}},
                           Word{"ambientocclusion", {}},
                           Word{"opacity", {}},
                           Word{"alpha", {}},
                           Word{"emission", {}},
                           Word{"emissive", {}},
                           Word{"specular", {}},
                           Word{"spec", {}},
                           Word{"preview", {}}};

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string list_of(std::span<const std::string> names) {
  constexpr std::size_t most = 6;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    list += (i ? ", " : "") + names[i].substr(0, 60);
  return list + (names.size() > most ? ", ..." : "");
}

// A candidate file for each kind of map, before we choose between kinds.
struct Places {
  std::optional<std::size_t> base_colour, normal_up, normal_down, roughness, gloss, metalness, height, packed;

  std::optional<std::size_t>& of(const PbrName& name) {
    switch (name.map) {
      case PbrMap::base_colour:
        return base_colour;
      case PbrMap::normal:
        return name.green_down ? normal_down : normal_up;
      case PbrMap::roughness:
        return roughness;
      case PbrMap::gloss:
        return gloss;
      case PbrMap::metalness:
        return metalness;
      case PbrMap::height:
        return height;
      case PbrMap::packed:
        break;
    }
    return packed;
  }
};

}  // namespace

std::optional<PbrName> parse_pbr_name(std::string_view name) {
  if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) name = name.substr(0, dot);
  std::optional<PbrMap> map;
  bool green_down = false;
  std::vector<std::string> parts = words_of(name);
  // A preview picture such as "Metal032_1K.png" begins with the name of the material. There, "metal" does not
  // mean a metalness map.
  if (parts.size() > 1 && parts.front() == "metal") parts.erase(parts.begin());
  for (const std::string& word : parts) {
    const auto* const known =
        std::find_if(words.begin(), words.end(), [&](const Word& w) { return w.text == word; });
    if (known != words.end()) map = known->map;
    green_down = green_down || is_one_of(word, {"dx", "directx", "normaldx"});
  }
  if (!map) return std::nullopt;
  return PbrName{*map, *map == PbrMap::normal && green_down};
}

PbrFiles arrange_pbr_names(std::span<const std::string> names) {
  Places places;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto name = parse_pbr_name(names[i]);
    if (!name) continue;
    std::optional<std::size_t>& place = places.of(*name);
    if (place)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%.150s and %.150s have names of the same kind of map; remove or rename one of them",
                    names[*place].c_str(), names[i].c_str());
    place = i;
  }
  if (!places.base_colour)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "no image has the name of a base colour (got %s; need a name that "
                  "contains albedo, base color, color or diffuse)",
                  names.empty() ? "no image" : list_of(names).c_str());
  PbrFiles files;
  files.base_colour = *places.base_colour;
  files.normal = places.normal_up ? places.normal_up : places.normal_down;
  files.green_down = !places.normal_up;
  files.roughness = places.roughness ? places.roughness : places.gloss;
  files.roughness_is_gloss = !places.roughness && places.gloss;
  files.metalness = places.metalness;
  files.height = places.height;
  files.packed = places.packed;
  return files;
}

namespace {

namespace fs = std::filesystem;

// 8192 x 8192 texels. Three channels of floats take 0.8 GB.
constexpr std::size_t most_texels = std::size_t{1} << 26;
// The minimum cosine between a normal and the plane's normal. We treat a larger tilt as noise of the image.
constexpr float least_upright = 0.1f;

struct MapImage {
  fs::path path;
  std::uint32_t side = 0;
  bool is_float = false;
  std::size_t channels = 0;  // 1 or 3
  std::vector<float> texels;

  // Returns a channel of a texel. An image with one channel uses this channel for all three.
  float at(std::size_t texel, std::size_t channel) const {
    return texels[texel * channels + (channels == 3 ? channel : 0)];
  }
};

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw Failure(NOOK_ERROR_BAD_FILE, "%.250s: cannot be read (%.150s)", path.c_str(), why.c_str());
}

void check_finite(const MapImage& image) {
  for (std::size_t i = 0; i < image.texels.size(); ++i)
    if (!std::isfinite(image.texels[i]))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%.250s: texel (%zu, %zu), counted from the upper left, is not a finite number",
                    image.path.c_str(), i / image.channels % image.side, i / image.channels / image.side);
}

MapImage read_image(const fs::path& path, bool needs_colour) {
  check_exr_head(path.c_str(), path);
  std::string why;
  const auto input = open_image(path, platform::ImageAlpha::unassociated, why);
  if (!input) fail(path, why);
  const platform::ImageHead& spec = input->head();
  if (spec.channels < 1 || spec.depth > 1) fail(path, "it is not a flat image");
  std::error_code unknown;  // on an error, file_size returns the maximum value
  check_image_size(path.c_str(), spec.width, spec.height, most_texels, fs::file_size(path, unknown));
  if (spec.width != spec.height)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "%.250s has %d x %d texels, but must have as many columns as rows; crop it to one square tile",
        path.c_str(), spec.width, spec.height);
  if (needs_colour && spec.channels < 3)
    throw Failure(NOOK_ERROR_BAD_FILE, "%.250s has %d channels, need 3", path.c_str(), spec.channels);
  MapImage image{path,
                 std::uint32_t(spec.width),
                 spec.is_floating_point,
                 spec.channels >= 3 ? std::size_t{3} : std::size_t{1},
                 {}};
  image.texels.resize(image.channels * image.side * image.side);
  if (!input->read_rows(0, spec.height, int(image.channels), image.texels.data())) fail(path, input->why());
  check_finite(image);
  return image;
}

// Averages `count` values per texel over the cells of the grid.
std::vector<float> averages(const MapImage& image, std::uint32_t side, std::uint32_t count,
                            const std::function<void(std::size_t texel, float* numbers)>& numbers_of) {
  TileFilter filter(image.side, image.side, side, count);
  std::vector<float> row(std::size_t(image.side) * count);
  for (std::uint32_t y = 0; y < image.side; ++y) {
    for (std::uint32_t x = 0; x < image.side; ++x)
      numbers_of(std::size_t(y) * image.side + x, &row[std::size_t(x) * count]);
    filter.add_row(image.side - 1 - y, row);
  }
  return filter.result();
}

float unit(float value) {
  return std::clamp(value, 0.0f, 1.0f);
}

std::vector<Vec3> read_colours(const fs::path& path, std::uint32_t side) {
  const MapImage image = read_image(path, false);
  const std::vector<float> rgb = averages(image, side, 3, [&](std::size_t texel, float* numbers) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = unit(image.at(texel, c));
      numbers[c] = image.is_float ? value : linear_from_srgb(value);
    }
  });
  std::vector<Vec3> colours(rgb.size() / 3);
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
  return colours;
}

std::vector<MapSlope> read_slopes(const fs::path& path, bool green_down, std::uint32_t side) {
  const MapImage image = read_image(path, true);
  const std::vector<float> moments = averages(image, side, 4, [&](std::size_t texel, float* numbers) {
    const Vec3 n =
        normalised({2 * image.at(texel, 0) - 1, 2 * image.at(texel, 1) - 1, 2 * image.at(texel, 2) - 1});
    const float upright = std::max(n.z, least_upright);
    numbers[0] = -n.x / upright;
    numbers[1] = (green_down ? n.y : -n.y) / upright;
    numbers[2] = numbers[0] * numbers[0];
    numbers[3] = numbers[1] * numbers[1];
  });
  std::vector<MapSlope> slopes(moments.size() / 4);
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const float* m = &moments[4 * i];
    slopes[i] = {m[0], m[1], std::max(0.5f * (m[2] - m[0] * m[0] + m[3] - m[1] * m[1]), 0.0f)};
  }
  return slopes;
}

std::vector<float> squared_widths(const MapImage& image, std::size_t channel, bool is_gloss,
                                  std::uint32_t side) {
  return averages(image, side, 1, [&](std::size_t texel, float* number) {
    const float value = unit(image.at(texel, channel)), width = ggx_width(is_gloss ? 1 - value : value);
    *number = width * width;
  });
}

std::vector<float> shares(const MapImage& image, std::size_t channel, std::uint32_t side) {
  return averages(image, side, 1,
                  [&](std::size_t texel, float* number) { *number = unit(image.at(texel, channel)); });
}

}  // namespace

std::vector<float> read_height_map(const fs::path& file, std::uint32_t side) {
  const MapImage image = read_image(file, false);
  return averages(image, side, 1, [&](std::size_t texel, float* number) { *number = image.at(texel, 0); });
}

PbrMaps read_height_image(const fs::path& file) {
  const MapImage image = read_image(file, false);
  PbrMaps maps;
  maps.side = image.side;
  maps.height.resize(std::size_t(image.side) * image.side);
  for (std::size_t y = 0; y < image.side; ++y)
    for (std::size_t x = 0; x < image.side; ++x)
      maps.height[(image.side - 1 - y) * image.side + x] = image.at(y * image.side + x, 0);
  return maps;
}

PbrFolder read_pbr_folder(const fs::path& folder, std::uint32_t side) {
  const std::vector<fs::path> paths = images_in(folder);
  std::vector<std::string> names;
  for (const fs::path& path : paths) names.push_back(path.filename().string());
  const PbrFiles files = arrange_pbr_names(names);

  PbrFolder out;
  PbrMaps& maps = out.maps;
  maps.side = side;
  const auto take = [&](std::size_t index) -> const fs::path& {
    out.file_names.push_back(names[index]);
    return paths[index];
  };
  maps.base_colour = read_colours(take(files.base_colour), side);
  if (files.normal) maps.slope = read_slopes(take(*files.normal), files.green_down, side);
  if (files.height) maps.height = read_height_map(take(*files.height), side);
  if (files.roughness)
    maps.squared_width =
        squared_widths(read_image(take(*files.roughness), false), 0, files.roughness_is_gloss, side);
  if (files.metalness) maps.metalness = shares(read_image(take(*files.metalness), false), 0, side);
  if (files.packed && !(files.roughness && files.metalness)) {
    const MapImage image = read_image(take(*files.packed), true);
    if (!files.roughness) maps.squared_width = squared_widths(image, 1, false, side);
    if (!files.metalness) maps.metalness = shares(image, 2, side);
  }
  return out;
}

}  // namespace nook::bake::material
