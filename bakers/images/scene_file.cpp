#include "bakers/images/scene_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "bakers/images/image_files.h"
#include "bakers/images/image_reader.h"
#include "bakers/import/static_scene.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t most_texels = std::size_t{1} << 26;

// Returns the format of an image, or null if glTF does not allow it.
const char* format_of(const std::vector<std::byte>& bytes) {
  const char* format = image_format_of(bytes);
  return format && (format == "png"sv || format == "jpg"sv) ? format : nullptr;
}

}  // namespace

Texture decode_texture(const EncodedImage& image) {
  const char* format = format_of(image.bytes);
  if (!format)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s is neither PNG nor JPEG; convert it", image.name.c_str());
  std::string why;
  const auto input =
      platform::image_codec().open(format, image.bytes, platform::ImageAlpha::unassociated, why);
  if (!input)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s cannot be decoded (%s)", image.name.c_str(), why.c_str());
  const platform::ImageHead& spec = input->head();
  check_image_size(image.name.c_str(), spec.width, spec.height, most_texels, image.bytes.size());
  if (spec.channels < 1) throw Failure(NOOK_ERROR_BAD_FILE, "%s has no channels", image.name.c_str());
  const std::size_t texels = std::size_t(spec.width) * std::size_t(spec.height);
  const auto channels = std::size_t(std::min(spec.channels, 4));
  std::vector<std::uint8_t> read(channels * texels);
  if (!input->read_rows(0, spec.height, int(channels), read.data()))
    throw Failure(NOOK_ERROR_BAD_FILE, "%s is a damaged image (%s)", image.name.c_str(),
                  input->why().c_str());
  const bool grey = channels < 3;
  std::vector<std::uint8_t> rgba(4 * texels, 255);
  for (std::size_t i = 0; i < texels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba[4 * i + c] = read[channels * i + (grey ? 0 : c)];
    if (channels % 2 == 0) rgba[4 * i + 3] = read[channels * i + channels - 1];
  }
  return Texture(std::uint32_t(spec.width), std::uint32_t(spec.height), std::move(rgba));
}

}  // namespace nook::bake

namespace nook::bake::probe {
namespace {

constexpr int most_columns = 16384, fewest_columns = 4;
constexpr double most_negative = 0.01;

void check_layout(const platform::ImageHead& spec, const char* format) {
  if (spec.value_type != "float" && spec.value_type != "half")
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the %s image has %s values, but radiance needs floating point; give a .hdr or .exr file",
                  format, spec.value_type.c_str());
  if (spec.channels < 3)
    throw Failure(NOOK_ERROR_BAD_FILE, "the image has %d channels (need red, green and blue)", spec.channels);
  if (spec.depth > 1)
    throw Failure(NOOK_ERROR_BAD_FILE, "the image has %d layers, but a map has only one", spec.depth);
  if (spec.width != 2 * std::int64_t{spec.height} || spec.width < fewest_columns || spec.width > most_columns)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "an image of %d x %d pixels is not a latitude-longitude map (need twice as wide as high, "
                  "%d to %d pixels wide)",
                  spec.width, spec.height, fewest_columns, most_columns);
}

void check_radiance(const std::vector<float>& rgb) {
  std::size_t out_of_range = 0;
  double light = 0, negative = 0;
  for (const float value : rgb) {
    out_of_range += !(std::abs(double(value)) <= max_radiance);
    (value < 0 ? negative : light) += std::abs(double(value));
  }
  if (out_of_range > 0)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "%zu of its values are not finite or above %g in magnitude; clamp them in an image editor or scale "
        "the light down",
        out_of_range, max_radiance);
  if (negative > most_negative * light)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the sum of its negative values is %.3g times the sum of its positive values (need at most "
                  "%g, which filters can cause); a difference image is not a map",
                  light > 0 ? negative / light : 1.0, most_negative);
}

}  // namespace

Environment read_environment(const std::filesystem::path& path) {
  check_exr_head("the map", path);
  std::string why;
  const auto image = open_image(path, platform::ImageAlpha::associated, why);
  if (!image) throw Failure(NOOK_ERROR_BAD_FILE, "cannot be read as an image (%s)", why.c_str());
  const platform::ImageHead& spec = image->head();
  check_layout(spec, image->format_name());
  std::error_code unknown;  // on an error, file_size returns the maximum value
  check_image_size("the map", spec.width, spec.height, std::size_t{most_columns} * (most_columns / 2),
                   std::filesystem::file_size(path, unknown));
  std::vector<float> rgb(3 * std::size_t(spec.width) * std::size_t(spec.height));
  if (!image->read_rows(0, spec.height, 3, rgb.data()))
    throw Failure(NOOK_ERROR_BAD_FILE, "the image is damaged (%s)", image->why().c_str());
  check_radiance(rgb);
  for (float& value : rgb) value = std::max(value, 0.0f);
  return Environment(std::uint32_t(spec.width), std::uint32_t(spec.height), std::move(rgb));
}

}  // namespace nook::bake::probe

namespace nook::bake {

LitTriangles read_lit_triangles(const std::filesystem::path& path, bool textures,
                                const ImportOptions& options, std::vector<std::string>& warnings) {
  StaticScene scene =
      import_static_scene(path, textures ? SceneTextures::read : SceneTextures::skip, options);
  warnings.insert(warnings.end(), scene.warnings.begin(), scene.warnings.end());
  std::vector<Texture> decoded;
  for (const EncodedImage& image : scene.image) decoded.push_back(decode_texture(image));
  return lit_triangles(std::move(scene), std::move(decoded));
}

ProbeScene make_probe_scene(LitTriangles triangles, Environment light) {
  ProbeScene scene;
  scene.soup = triangles.soup;
  const std::vector<Vec3>& points = scene.soup.position;
  scene.low_ws = scene.high_ws = points.front();
  scene.origin_offset = ray_origin_offset(points);
  for (const Vec3 p : points) {
    scene.low_ws = {std::min(scene.low_ws.x, p.x), std::min(scene.low_ws.y, p.y),
                    std::min(scene.low_ws.z, p.z)};
    scene.high_ws = {std::max(scene.high_ws.x, p.x), std::max(scene.high_ws.y, p.y),
                     std::max(scene.high_ws.z, p.z)};
  }
  scene.lit = std::make_unique<LitScene>(std::move(triangles), std::move(light));
  return scene;
}

}  // namespace nook::bake
