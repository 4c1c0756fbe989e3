#include "bakers/measure/material/grazing.h"

#include <cmath>
#include <span>

#include "bakers/material/periodic_tile.h"
#include "bakers/measure/material/decoded_radiances.h"
#include "bakers/measure/material/table_error.h"
#include "bakers/raytrace/random.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/evaluate.h"

namespace nook::bake::material {
namespace {

using Eigen::Index;
using nook::material::MaterialTables;
using nook::material::Pixel;
using nook::material::TexturePlace;
using tensor::Matrix;

constexpr std::uint32_t fetch_counts[] = {1, 2, 3, 4, 8};
constexpr std::size_t pixels = 32;          // of a view
constexpr std::uint32_t texel_samples = 8;  // along a texel
// Cosines of the measured views: 60 to 85 degrees from the normal.
constexpr float highest_z = 0.5f, lowest_z = 0.0871f;

// The radiances of a pixel under all lights, three numbers each.
Matrix radiances(const RawMaterial& raw, const MaterialTables& tables, const Matrix& lights,
                 const Pixel& pixel) {
  return decoded_radiances(
      raw, tables, lights,
      [&](std::span<float> modes) { nook::material::decode_pixel_modes(tables, pixel, modes); },
      [&](std::span<float> sums) {
        const auto places = fetches_along(pixel.sides, tables.btf.width, tables.btf.height, pixel.fetches);
        decode_neural_places(tables.neural, places, pixel.view, sums);
      });
}

// Calls visit(place) at even places over a pixel, and returns how many they were.
template <class Visit>
std::size_t for_each_sample(const nook::material::PixelSides& sides, float length_texels,
                            const Visit& visit) {
  const auto along = texel_samples * std::uint32_t(std::ceil(length_texels));
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t j = 0; j < texel_samples; ++j) {
      const float y = (float(i) + 0.5f) / float(along) - 0.5f, x = (float(j) + 0.5f) / texel_samples - 0.5f;
      visit(TexturePlace{sides.middle.u + x * sides.dx.u + y * sides.dy.u,
                         sides.middle.v + x * sides.dx.v + y * sides.dy.v});
    }
  return std::size_t(along) * texel_samples;
}

// The means over a pixel: of what the file shows at its finest level, and of the raw images.
struct Means {
  Matrix file, raw;
};
Means means_of(const RawMaterial& raw, const MaterialTables& tables, const Matrix& lights, std::size_t view,
               const Pixel& pixel) {
  const auto rows = Index(raw.light_rows());
  Means means{Matrix::Zero(rows, 1), Matrix::Zero(rows, 1)};
  const std::size_t count = for_each_sample(pixel.sides, 1 / pixel.view.z, [&](const TexturePlace& place) {
    means.file += radiances(raw, tables, lights, {{place, {}, {}}, pixel.view, pixel.light, 1});
    const Taps taps = taps_at(raw.width, raw.height, place.u, place.v);
    for (Index row = 0; row < rows; ++row)
      means.raw(row, 0) +=
          mean_of(taps, &raw.btf[(std::size_t(row) * raw.views.size() + view) * raw.texels()]);
  });
  means.file /= float(count);
  means.raw /= float(count);
  return means;
}

// The sides of a pixel of a view, a texel across the tilt and longer along it.
nook::material::PixelSides grazing_sides(const RawMaterial& raw, Vec3 view, TexturePlace middle) {
  const float tilted = std::sqrt(view.x * view.x + view.y * view.y), x = view.x / tilted, y = view.y / tilted,
              w = float(raw.width), h = float(raw.height);
  return {middle, {-y / w, x / h}, {x / (view.z * w), y / (view.z * h)}};
}

// Sums over the pixels of a view.
std::vector<GrazingError> errors_of_view(const RawMaterial& raw, const MaterialTables& tables,
                                         const Matrix& lights, std::size_t view) {
  std::vector<GrazingError> errors;
  for (const std::uint32_t fetches : fetch_counts) errors.push_back({fetches, 0, 0});
  RandomFrom<MixedCounter> random(view + 1);
  for (std::size_t i = 0; i < pixels; ++i) {
    const float u = random.unit(), v = random.unit();
    Pixel pixel{grazing_sides(raw, raw.views[view], {u, v}), raw.views[view], {0, 0, 1}, 1};
    const Means means = means_of(raw, tables, lights, view, pixel);
    for (GrazingError& error : errors) {
      pixel.fetches = error.fetches;
      const Matrix drawn = radiances(raw, tables, lights, pixel);
      error.mse += double((drawn - means.file).squaredNorm());
      error.mse_raw += double((drawn - means.raw).squaredNorm());
    }
  }
  return errors;
}

}  // namespace

std::vector<GrazingError> measure_grazing(const RawMaterial& raw, const MaterialTables& tables) {
  if (tables.btf.width != raw.width || tables.btf.height != raw.height)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the material is of %u x %u texels, the raw material of %u x %u", tables.btf.width,
                  tables.btf.height, raw.width, raw.height);
  std::vector<std::size_t> views;
  for (std::size_t view = 0; view < raw.views.size(); ++view)
    if (raw.views[view].z >= lowest_z && raw.views[view].z < highest_z) views.push_back(view);
  if (views.empty()) return {};
  const Matrix lights = tables.neural.is_used() ? Matrix() : light_rows(raw, tables);
  std::vector<std::vector<GrazingError>> parts(views.size());
  tensor::for_each_block(views.size(), 1, [&](std::size_t i, std::size_t) {
    parts[i] = errors_of_view(raw, tables, lights, views[i]);
  });
  const double count = double(views.size()) * double(pixels) * double(raw.light_rows());
  std::vector<GrazingError> errors;
  for (std::size_t n = 0; n < std::size(fetch_counts); ++n) {
    GrazingError& sum = errors.emplace_back(GrazingError{fetch_counts[n], 0, 0});
    for (const std::vector<GrazingError>& part : parts) {
      sum.mse += part[n].mse / count;
      sum.mse_raw += part[n].mse_raw / count;
    }
  }
  return errors;
}

}  // namespace nook::bake::material
