#include "bakers/images/environment_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bakers/images/exr_head.h"
#include "bakers/images/image_reader.h"
#include "bakers/images/image_size.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::probe {
namespace {

constexpr int most_columns = 16384, fewest_columns = 4;
constexpr double most_negative = 0.01;

void check_layout(const OIIO::ImageSpec& spec, const char* format) {
  if (spec.format != OIIO::TypeDesc::FLOAT && spec.format != OIIO::TypeDesc::HALF)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "a %s image of %s values holds no radiance (need floating point); give a .hdr or .exr file",
                  format, spec.format.c_str());
  if (spec.nchannels < 3)
    throw Failure(NOOK_ERROR_BAD_FILE, "an image of %d channels (need red, green and blue)", spec.nchannels);
  if (spec.depth > 1)
    throw Failure(NOOK_ERROR_BAD_FILE, "an image of %d layers is no map (need 1)", spec.depth);
  if (spec.width != 2 * std::int64_t{spec.height} || spec.width < fewest_columns || spec.width > most_columns)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "an image of %d x %d pixels is no latitude-longitude map (need twice as wide as high, %d to %d "
        "pixels wide)",
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
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "its negative values add up to %.3g of the positive ones (need at most %g, which filters leave); "
        "an image of differences is no map",
        light > 0 ? negative / light : 1.0, most_negative);
}

}  // namespace

Environment read_environment(const std::filesystem::path& path) {
  check_exr_head("the map", path);
  std::string why;
  const auto image = open_image(path, {}, why);
  if (!image) throw Failure(NOOK_ERROR_BAD_FILE, "cannot be read as an image (%s)", why.c_str());
  const OIIO::ImageSpec spec = image->spec();
  check_layout(spec, image->format_name());
  std::error_code unknown;  // the size is then the largest number
  check_image_size("the map", spec.width, spec.height, std::size_t{most_columns} * (most_columns / 2),
                   std::filesystem::file_size(path, unknown));
  std::vector<float> rgb(3 * std::size_t(spec.width) * std::size_t(spec.height));
  if (!read_pixels(*image, 3, OIIO::TypeDesc::FLOAT, rgb.data()))
    throw Failure(NOOK_ERROR_BAD_FILE, "a damaged image (%s)", image->geterror().c_str());
  check_radiance(rgb);
  for (float& value : rgb) value = std::max(value, 0.0f);
  return Environment(std::uint32_t(spec.width), std::uint32_t(spec.height), std::move(rgb));
}

}  // namespace nook::bake::probe
