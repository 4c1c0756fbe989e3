#include "bakers/measure/material/view_jumps.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "bakers/raytrace/random.h"
#include "sdk/src/material/reflectance.h"

namespace nook::bake::material {
namespace {

using nook::material::Material;
using nook::material::MaterialTables;
using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t arcs = 64, steps = 60;
constexpr std::uint32_t grid = 16;  // texels along a side
constexpr float radians = std::numbers::pi_v<float> / 180, most_tilt = 70 * radians;

// The views of an arc: both ends within the largest tilt.
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

// The light modes of a sample, or of a neural material, which has none, the radiances of all lights.
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

// The light modes of the grid's texels for a view, a row each.
Rows modes_of(const Material& material, const MaterialTables& tables, Vec3 view) {
  const std::uint32_t width = std::min(grid, tables.btf.width), height = std::min(grid, tables.btf.height);
  Rows out(Eigen::Index(width) * height, mode_count(material, tables));
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      // Middles of texels, which no filter blurs.
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

// Returns G = U^T U of the light basis of the tables, in which m^T G m is the sum of squares of all radiances
// of the modes m.
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
