#include "sdk/src/material/tables.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/half.h"
#include "sdk/src/core/hash.h"
#include "sdk/src/material/direction_mesh.h"
#include "sdk/src/material/low_light.h"
#include "sdk/src/material/spatial_modes.h"
#include "sdk/src/material/view_cells.h"

namespace nook::material {
namespace {

std::uint16_t finite_half(float value) {
  return to_half(std::clamp(value, -65504.0f, 65504.0f));
}

// Expands and packs the modes of one cluster, `batch` at a time.
class ClusterPacking {
 public:
  static constexpr std::uint32_t batch = 16;

  ClusterPacking(const ClusteredTensor& tensor, std::uint32_t cluster, float scale, TensorTables& tables,
                 Memory* memory)
      : tensor_(tensor),
        cluster_(cluster),
        scale_(scale),
        tables_(tables),
        expansion_(tensor, cluster, memory),
        texels_(std::size_t(tables.width) * tables.height),
        work_(batch * (expansion_.scratch_size() + 2 * texels_), memory) {}

  void run(const Parallel& parallel) {
    const TensorShape& s = tensor_.shape;
    const std::uint32_t modes = s.rank_light * s.rank_view;
    for (std::uint32_t first = 0; first < modes; first += batch) {
      auto body = [&](std::uint32_t i) noexcept { pack(first + i, i); };
      parallel_for(parallel, std::min(batch, modes - first), body);
    }
  }

 private:
  void pack(std::uint32_t mode, std::uint32_t place) noexcept {
    const std::uint32_t a = mode / tensor_.shape.rank_view, b = mode % tensor_.shape.rank_view;
    const std::size_t each = expansion_.scratch_size() + 2 * texels_;
    const std::span<float> work(work_.data() + place * each, each);
    std::span<float> image = work.subspan(0, texels_), other = work.subspan(texels_, texels_);
    expansion_.expand(a, b, work.subspan(2 * texels_), image);
    const std::size_t layer =
        (std::size_t(cluster_) * tables_.light_modes + a) * tables_.view_vec4_count + b / 4;
    for (std::uint32_t level = 0;; ++level) {
      const std::uint32_t w = level_size(tables_.width, level), h = level_size(tables_.height, level);
      const std::size_t texels = std::size_t(w) * h;
      std::uint16_t* const out = &tables_.spatial[tables_.level_offset(level) + layer * texels * 4 + b % 4];
      for (std::size_t i = 0; i < texels; ++i) out[4 * i] = finite_half(image[i] * scale_);
      if (level + 1 == tables_.levels) return;
      halve(image, w, h, other);
      std::swap(image, other);
    }
  }

  const ClusteredTensor& tensor_;
  std::uint32_t cluster_;
  float scale_;
  TensorTables& tables_;
  ModeExpansion expansion_;
  std::size_t texels_;
  Vector<float> work_;
};

// Returns the exponent that scales the largest bound of a spatial mode to [2^14, 2^15), which is within a
// half's range and far from its smallest numbers.
int spatial_exponent(const ClusteredTensor& tensor, Memory* memory) {
  float bound = 0;
  for (std::uint32_t c = 0; c < tensor.shape.clusters; ++c)
    bound = std::max(bound, ModeExpansion(tensor, c, memory).bound());
  // The exponent is limited to where the power of two and its inverse are floats.
  return bound > 0 ? std::clamp(14 - std::ilogb(bound), -100, 100) : 0;
}

// scale multiplies the coefficients.
void pack_cells(const ViewCells& cells, std::uint32_t rank, float scale, TensorTables& tables) {
  const std::size_t count = std::size_t(cells.side) * cells.side;
  tables.side = cells.side;
  tables.terms = cells.terms;
  tables.coefficients.resize(count * 4 * cells.terms * tables.view_vec4_count);
  if (tables.clusters > 1) tables.membership.resize(count * 4 * vec4_count(cells.terms));
  for (std::size_t cell = 0; cell < count; ++cell)
    for (std::uint32_t k = 0; k < cells.terms; ++k) {
      const std::size_t term = cell * cells.terms + k;
      for (std::uint32_t b = 0; b < rank; ++b)
        tables.coefficients[((std::size_t(k) * tables.view_vec4_count + b / 4) * count + cell) * 4 + b % 4] =
            finite_half(cells.rows.coefficients[term * rank + b] * scale);
      if (tables.clusters > 1)
        tables.membership[(k / 4 * count + cell) * 4 + k % 4] = cells.rows.membership[term];
    }
}

void make_spatial(const ClusteredTensor& tensor, std::uint32_t light_modes, int exponent,
                  const Parallel& parallel, TensorTables& tables, Memory* memory) {
  const TensorShape& s = tensor.shape;
  tables.width = s.width;
  tables.height = s.height;
  tables.levels = level_count(s.width, s.height);
  tables.light_modes = light_modes;
  tables.view_vec4_count = vec4_count(s.rank_view);
  tables.clusters = s.clusters;
  tables.spatial.resize(tables.level_offset(tables.levels));
  for (std::uint32_t c = 0; c < s.clusters; ++c)
    ClusterPacking(tensor, c, std::ldexp(1.0f, exponent), tables, memory).run(parallel);
}

void make_light_map(const Material& material, float scale, MaterialTables& tables, Memory* memory) {
  const std::uint32_t side = MaterialTables::light_side, rank = material.btf.shape.rank_light;
  const std::size_t count = std::size_t(side) * side, light_vec4_count = vec4_count(rank);
  const DirectionMesh mesh(material.lights, memory);
  tables.light.resize(3 * light_vec4_count * count * 4);
  std::size_t hint = 0;
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column) {
      const Vec3 direction = from_parabolic(cell_centre(column, row, side));
      const DirectionMix mix = mesh.locate(to_parabolic(direction), hint);
      const float share = low_light_share(material.lights, mix, direction.z);
      for (std::uint32_t channel = 0; channel < 3; ++channel)
        for (std::uint32_t a = 0; a < rank; ++a) {
          float sum = 0;
          for (int i = 0; i < 3; ++i)
            sum += mix.weight[i] * material.light_basis[(3 * std::size_t(mix.index[i]) + channel) * rank + a];
          const std::size_t layer = channel * light_vec4_count + a / 4;
          tables.light[((layer * side + row) * side + column) * 4 + a % 4] = sum * scale * share;
        }
    }
}

void add_floats(Hash64& hash, std::span<const float> values) {
  for (const float value : values) {
    const auto bits = bit_cast<std::uint32_t>(value);
    const std::byte bytes[4] = {std::byte(bits), std::byte(bits >> 8), std::byte(bits >> 16),
                                std::byte(bits >> 24)};
    hash.add(bytes);
  }
}

// The exponent scales the light map, and so belongs to what was baked with it.
std::uint64_t hash_of_light(const Material& material, int exponent) {
  Hash64 hash;
  const float scale = float(exponent);
  add_floats(hash, {&scale, 1});
  for (const Vec3 light : material.lights) {
    const float xyz[3] = {light.x, light.y, light.z};
    add_floats(hash, xyz);
  }
  add_floats(hash, material.light_basis);
  return hash.value();
}

std::uint64_t hash_of_votf(const Material& material) {
  Hash64 hash;
  const float mapping[3] = {float(material.visibility), material.mapping.threshold, material.mapping.weight};
  add_floats(hash, mapping);
  for (const auto* values : {&material.votf.cores, &material.votf.x_bases, &material.votf.y_bases,
                             &material.votf.rows.coefficients, &material.votf.map.rows.coefficients})
    add_floats(hash, *values);
  return std::max<std::uint64_t>(hash.value(), 1);
}

std::uint64_t tensor_bytes(const TensorTables& tables) {
  return 2 * (std::uint64_t(tables.spatial.size()) + tables.coefficients.size() + tables.membership.size());
}

}  // namespace

std::size_t TensorTables::level_offset(std::uint32_t level) const {
  std::size_t offset = 0;
  for (std::uint32_t l = 0; l < level; ++l)
    offset += std::size_t(level_size(width, l)) * level_size(height, l) * layers() * 4;
  return offset;
}

MaterialTables make_tables(const Material& material, const Parallel& parallel, Memory* memory,
                           std::uint32_t map_side) {
  MaterialTables tables(memory);
  const ClusteredTensor &btf = material.btf, &votf = material.votf;
  const int exponent = spatial_exponent(btf, memory);
  make_spatial(btf, 4 * vec4_count(btf.shape.rank_light), exponent, parallel, tables.btf, memory);
  pack_cells(view_cells(btf, material.views, map_side, memory), btf.shape.rank_view, 1, tables.btf);
  make_light_map(material, std::ldexp(1.0f, -exponent), tables, memory);
  tables.visibility = material.visibility;
  tables.mapping = material.mapping;
  tables.light_hash = hash_of_light(material, exponent);
  if (material.visibility == VisibilityForm::none) return tables;
  // The inverse power of two multiplies the coefficients, so that it is used only where a half would
  // overflow.
  tables.votf_hash = hash_of_votf(material);
  const int votf_exponent = std::min(spatial_exponent(votf, memory), 0);
  make_spatial(votf, 1, votf_exponent, parallel, tables.votf, memory);
  pack_cells(view_cells(votf, material.views, map_side, memory), votf.shape.rank_view,
             std::ldexp(1.0f, -votf_exponent), tables.votf);
  return tables;
}

std::uint64_t table_bytes(const MaterialTables& tables) {
  return tensor_bytes(tables.btf) + tensor_bytes(tables.votf) + 4 * std::uint64_t(tables.light.size());
}

}  // namespace nook::material
