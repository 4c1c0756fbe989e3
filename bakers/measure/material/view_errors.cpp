#include "bakers/measure/material/view_errors.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "bakers/material/btf_error.h"
#include "bakers/material/periodic_tile.h"
#include "bakers/measure/material/table_error.h"
#include "bakers/raytrace/random.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/parabolic.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::material {
namespace {

using nook::material::Material;
using nook::material::VisibilityForm;

// Compares the floats exactly. This works because all files compute their directions from the same spiral.
bool same_directions(const std::vector<Vec3>& a, const Vector<Vec3>& b) {
  return std::ranges::equal(a, b, [](Vec3 p, Vec3 q) { return length(p - q) < 1e-5f; });
}

using Eigen::Index;
using nook::material::MaterialTables;
using nook::material::Pixel;
using nook::material::TexturePlace;
using tensor::Matrix;

constexpr std::uint32_t fetch_counts[] = {1, 2, 3, 4, 8};
constexpr std::size_t pixels = 32;          // per view
constexpr std::uint32_t texel_samples = 8;  // per side of a texel
// Cosines of the measured views, which are 60 to 85 degrees from the normal.
constexpr float highest_z = 0.5f, lowest_z = 0.0871f;

// Returns the radiances of a pixel under all lights, three numbers per light.
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

// Calls visit(place) at evenly spaced places over a pixel. Returns the number of places.
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

// The radiances averaged over a pixel, once from the finest level of the file and once from the raw images.
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

// Returns the sides of a pixel in a view. The pixel is one texel wide across the tilt direction, and longer
// along it.
nook::material::PixelSides grazing_sides(const RawMaterial& raw, Vec3 view, TexturePlace middle) {
  const float tilted = std::sqrt(view.x * view.x + view.y * view.y), x = view.x / tilted, y = view.y / tilted,
              w = float(raw.width), h = float(raw.height);
  return {middle, {-y / w, x / h}, {x / (view.z * w), y / (view.z * h)}};
}

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

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t arcs = 64, steps = 60;
constexpr std::uint32_t grid = 16;  // texels per side
constexpr float radians = std::numbers::pi_v<float> / 180, most_tilt = 70 * radians;

// Returns the views along a random arc. The tilt at both ends is at most most_tilt.
std::vector<Vec3> arc_of(std::uint64_t seed) {
  RandomFrom<MixedCounter> random(seed);
  const float lowest = std::cos(most_tilt), arc = jump_step_deg * radians * float(steps);
  for (;;) {
    const float z = lowest + (1 - lowest) * random.unit(),
                azimuth = 2 * std::numbers::pi_v<float> * random.unit(), r = std::sqrt(1 - z * z);
    const Vec3 first{r * std::cos(azimuth), r * std::sin(azimuth), z};
    const Vec3 any{random.normal(), random.normal(), random.normal()};
    const Vec3 along = normalised(any - first * dot(any, first));
    if ((first * std::cos(arc) + along * std::sin(arc)).z < lowest) continue;
    std::vector<Vec3> views;
    for (std::size_t i = 0; i <= steps; ++i) {
      const float angle = arc * float(i) / float(steps);
      views.push_back(first * std::cos(angle) + along * std::sin(angle));
    }
    return views;
  }
}

// Writes the light modes of a sample. A neural material does not have modes, so its radiances under all
// lights are written instead.
void set_modes(const Material& material, const MaterialTables& tables, const nook::material::Sample& sample,
               std::span<float> modes) {
  if (!tables.neural.is_used()) return decode_modes(tables, sample, modes);
  std::vector<float> decoded(tables.neural.decoded_count());
  decode_neural(tables.neural, {sample.u, sample.v, 0}, sample.view, decoded);
  for (std::size_t light = 0; light < material.lights.size(); ++light) {
    const Vec3 radiance = neural_radiance(tables.neural, decoded, material.lights[light]);
    modes[3 * light] = radiance.x;
    modes[3 * light + 1] = radiance.y;
    modes[3 * light + 2] = radiance.z;
  }
}

Eigen::Index mode_count(const Material& material, const MaterialTables& tables) {
  return tables.neural.is_used() ? 3 * Eigen::Index(material.lights.size()) : tables.btf.light_modes;
}

// Returns the light modes of the grid's texels for a view, one row per texel.
Rows modes_of(const Material& material, const MaterialTables& tables, Vec3 view) {
  const std::uint32_t width = std::min(grid, tables.btf.width), height = std::min(grid, tables.btf.height);
  Rows out(Eigen::Index(width) * height, mode_count(material, tables));
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      // Uses texel centres, because filtering does not blur there.
      const auto middle = [](std::uint32_t i, std::uint32_t count, std::uint32_t size) {
        return (float(i * size / count) + 0.5f) / float(size);
      };
      const nook::material::Sample sample{
          middle(x, width, tables.btf.width), middle(y, height, tables.btf.height), 0, view, {0, 0, 1}};
      const Eigen::Index row = Eigen::Index(y) * width + x;
      set_modes(material, tables, sample, {out.row(row).data(), std::size_t(out.cols())});
    }
  return out;
}

// Returns the Gram matrix G = U^T U, where U is the light basis of the tables. For light modes m, the sum of
// the squares of all radiances is m^T G m.
Rows gram_of(const Material& material, const MaterialTables& tables) {
  const Eigen::Index modes = mode_count(material, tables);
  if (tables.neural.is_used()) return Rows::Identity(modes, modes);
  Rows basis(3 * Eigen::Index(material.lights.size()), modes);
  std::vector<float> rows(3 * std::size_t(modes));
  for (std::size_t light = 0; light < material.lights.size(); ++light) {
    nook::material::light_basis_at(tables, material.lights[light], rows);
    std::copy(rows.begin(), rows.end(), basis.data() + light * rows.size());
  }
  return basis.transpose() * basis;
}

double square(const Rows& modes, const Rows& gram) {
  return (modes * gram).cwiseProduct(modes).cast<double>().sum();
}

struct Jump {
  double size = 0;
  Vec3 before, after;
};

}  // namespace

UnseenError measure_unseen(const RawMaterial& unseen, const Material& material) {
  const bool is_neural = material.neural.is_used();
  Material seen = as_seen_from(material, unseen.views);
  if (!is_neural && !same_directions(unseen.lights, material.lights)) light_from(seen, unseen.lights);
  UnseenError error;
  error.se_db = measure_btf(unseen, is_neural ? material : seen).se_db();
  if (seen.visibility != VisibilityForm::none && !unseen.mask.empty())
    error.error_texels = count_error_texels(unseen, seen.votf, seen.visibility);
  return error;
}

std::vector<GrazingError> measure_grazing(const RawMaterial& raw, const MaterialTables& tables) {
  if (tables.btf.width != raw.width || tables.btf.height != raw.height)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the material has %u x %u texels, but the raw material has %u x %u", tables.btf.width,
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

ViewJumps measure_view_jumps(const Material& material, std::uint64_t seed) {
  const MaterialTables tables = make_tables(material, {}, default_memory());
  const Rows gram = gram_of(material, tables);
  std::vector<Jump> jumps(arcs * steps);
  tbb::parallel_for(std::size_t{0}, arcs, [&](std::size_t arc) {
    const std::vector<Vec3> views = arc_of(seed + arc);
    Rows before = modes_of(material, tables, views[0]);
    for (std::size_t i = 0; i < steps; ++i) {
      Rows after = modes_of(material, tables, views[i + 1]);
      const double change = square(after - before, gram), size = square(before, gram);
      jumps[arc * steps + i] = {size > 0 ? std::sqrt(change / size) : 0, views[i], views[i + 1]};
      before = std::move(after);
    }
  });
  std::sort(jumps.begin(), jumps.end(), [](const Jump& a, const Jump& b) { return a.size < b.size; });
  const Jump& largest = jumps.back();
  return {largest.size, jumps[jumps.size() * 99 / 100].size, largest.before, largest.after};
}

}  // namespace nook::bake::material
