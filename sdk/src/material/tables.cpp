#include "sdk/src/material/tables.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sdk/src/core/floats.h"
#include "sdk/src/core/hash.h"
#include "sdk/src/material/direction_mesh.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/spatial_modes.h"
#include "sdk/src/material/view_cells.h"

namespace nook::material {
namespace {

std::uint16_t finite_half(float value) {
  return to_half(std::clamp(value, -65504.0f, 65504.0f));
}

// Calls body(place, cluster, a, b, image, other, scratch) for all modes, `batch` modes at a time. `image`
// holds the expanded mode, and `other` is a buffer of the same size. Calls with different `place` run in
// parallel.
constexpr std::uint32_t batch = 16;

template <class Body>
void for_each_mode(const ClusteredTensor& tensor, const Parallel& parallel, Memory* memory, Body&& body) {
  const TensorShape& s = tensor.shape;
  const std::uint32_t modes = s.rank_light * s.rank_view;
  const std::size_t texels = std::size_t(s.width) * s.height;
  Vector<float> work(memory);
  for (std::uint32_t c = 0; c < s.clusters; ++c) {
    const ModeExpansion expansion(tensor, c, memory);
    const std::size_t each = expansion.scratch_size() + 2 * texels;
    work.resize(batch * each);
    for (std::uint32_t first = 0; first < modes; first += batch) {
      auto one = [&](std::uint32_t i) noexcept {
        const std::uint32_t a = (first + i) / s.rank_view, b = (first + i) % s.rank_view;
        const std::span<float> room(work.data() + i * each, each);
        const std::span<float> image = room.subspan(0, texels), other = room.subspan(texels, texels);
        expansion.expand(a, b, room.subspan(2 * texels), image);
        body(c, a, b, image, other);
      };
      parallel_for(parallel, std::min(batch, modes - first), one);
    }
  }
}

// Calls body(level, width, height, image) for all levels of a mode. Pass the finest level in `image`.
template <class Body>
void for_each_level(const TensorTables& tables, std::span<float> image, std::span<float> other, Body&& body) {
  for (std::uint32_t level = 0;; ++level) {
    const std::uint32_t w = level_size(tables.width, level), h = level_size(tables.height, level);
    body(level, w, h, image);
    if (level + 1 == tables.levels) return;
    halve(image, w, h, other);
    std::swap(image, other);
  }
}

// Calls write(texel, value) for all texels of all levels of a mode. `texel` is an index into `spatial`.
template <class Write>
void for_each_texel(const TensorTables& tables, std::uint32_t cluster, std::uint32_t a, std::uint32_t b,
                    std::span<float> image, std::span<float> other, Write&& write) {
  const std::size_t layer =
      (std::size_t(cluster) * tables.whole_modes() + a) * tables.view_vec4_count + b / 4;
  for_each_level(tables, image, other,
                 [&](std::uint32_t level, std::uint32_t w, std::uint32_t h, std::span<const float> texels) {
                   const std::size_t count = std::size_t(w) * h;
                   const std::size_t first =
                       tables.image_size().level_offset(level) + layer * count * 4 + b % 4;
                   for (std::size_t i = 0; i < count; ++i) write(first + 4 * i, texels[i]);
                 });
}

// Encodes an image. Writes every second block, beginning at `to`, because a layer of two channels interleaves
// the blocks of its channels.
template <class Scaled>
void encode_image(BlockForm form, std::uint32_t width, std::uint32_t height, std::span<const float> image,
                  Scaled&& scaled, std::uint8_t* to) {
  for (std::uint32_t y = 0; y < height; y += 4)
    for (std::uint32_t x = 0; x < width; x += 4, to += BlockSize::block_bytes) {
      float numbers[16];
      for (std::uint32_t i = 0; i < 16; ++i)
        numbers[i] = scaled(
            image[std::size_t(std::min(y + i / 4, height - 1)) * width + std::min(x + i % 4, width - 1)]);
      encode_block(form, numbers, to);
    }
}

// Encodes all levels of a mode into blocks. `a` is the index of the light mode, counted from the first light
// mode that is stored in blocks.
template <class Scaled>
void encode_mode(TensorTables& tables, std::uint32_t cluster, std::uint32_t a, std::uint32_t b,
                 std::span<float> image, std::span<float> other, Scaled&& scaled) {
  const BlockSize size = tables.block_size();
  const std::size_t pair = (std::size_t(cluster) * tables.packed_modes + a) * tables.view_vec4_count + b / 4;
  const std::size_t layer = 2 * pair + b % 4 / 2;
  for_each_level(tables, image, other,
                 [&](std::uint32_t level, std::uint32_t w, std::uint32_t h, std::span<const float> texels) {
                   const std::size_t at = size.level_offset(level) + layer * size.layer_bytes(level);
                   encode_image(tables.block_form, w, h, texels, scaled,
                                &tables.blocks[at + signed_block_bytes * (b % 2)]);
                 });
}

// Returns the exponent that scales the largest bound of a spatial mode to [2^14, 2^15). This range is below
// the maximum of a half float and far above its smallest values.
int spatial_exponent(const ClusteredTensor& tensor, Memory* memory) {
  float bound = 0;
  for (std::uint32_t c = 0; c < tensor.shape.clusters; ++c)
    bound = std::max(bound, ModeExpansion(tensor, c, memory).bound());
  // The limit ensures that a float can represent both the power of two and its inverse.
  return bound > 0 ? std::clamp(14 - std::ilogb(bound), -100, 100) : 0;
}

// The scale of a mode is p_c[b] r[a]. The coefficients of the view modes are multiplied by p_c[b], and the
// columns of the light map by r[a].
struct ModeScales {
  explicit ModeScales(Memory* memory) : p(memory), r(memory) {}
  Vector<float> p;  // clusters x R_v
  Vector<float> r;  // R_l
};

// Smaller magnitudes are treated as 0, so that no quotient overflows.
constexpr float smallest_scale = 1e-30f;

float quotient(float value, float scale) {
  return scale > smallest_scale ? value / scale : 0;
}

// Sets p to the smallest values for which every |mode| is at most p r.
void tighten(std::span<const float> largest, const TensorShape& s, ModeScales& scales) {
  std::fill(scales.p.begin(), scales.p.end(), 0.0f);
  for (std::uint32_t c = 0; c < s.clusters; ++c)
    for (std::uint32_t a = 0; a < s.rank_light; ++a)
      for (std::uint32_t b = 0; b < s.rank_view; ++b) {
        float& p = scales.p[std::size_t(c) * s.rank_view + b];
        p = std::max(p,
                     quotient(largest[(std::size_t(c) * s.rank_light + a) * s.rank_view + b], scales.r[a]));
      }
}

// Returns scales such that for each mode S_c[a, b], p_c[b] r[a] is close to its largest magnitude, and not
// below it. r starts as the mean of these magnitudes. `light` holds the largest magnitude of each column of
// the light basis. Rounding the light map causes the smallest error if all columns times r have the same
// magnitude. This error matters as much as the rounding error of the modes. So r is then moved half of the
// way to such values, on a logarithmic scale. The function uses only sums, products and square roots, which
// all machines round in the same way.
ModeScales mode_scales(const TensorShape& s, std::span<const float> largest, std::span<const float> light,
                       Memory* memory) {
  ModeScales scales(memory);
  scales.p.resize(std::size_t(s.clusters) * s.rank_view);
  scales.r.resize(s.rank_light);
  for (std::size_t i = 0; i < largest.size(); ++i) scales.r[i / s.rank_view % s.rank_light] += largest[i];
  tighten(largest, s, scales);
  std::fill(scales.r.begin(), scales.r.end(), 0.0f);
  for (std::size_t i = 0; i < largest.size(); ++i) {
    const std::size_t c = i / s.rank_view / s.rank_light, a = i / s.rank_view % s.rank_light,
                      b = i % s.rank_view;
    scales.r[a] = std::max(scales.r[a], quotient(largest[i], scales.p[c * s.rank_view + b]));
  }
  for (std::size_t a = 0; a < light.size(); ++a)
    if (light[a] > smallest_scale) scales.r[a] = std::sqrt(scales.r[a]) / std::sqrt(light[a]);
  tighten(largest, s, scales);
  return scales;
}

// Returns the largest magnitude of each mode, clusters x R_l x R_v.
Vector<float> largest_of_modes(const ClusteredTensor& tensor, const Parallel& parallel, Memory* memory) {
  const TensorShape& s = tensor.shape;
  Vector<float> largest(std::size_t(s.clusters) * s.rank_light * s.rank_view, memory);
  for_each_mode(tensor, parallel, memory,
                [&](std::uint32_t c, std::uint32_t a, std::uint32_t b, std::span<float> image,
                    std::span<float>) noexcept {
                  float& out = largest[(std::size_t(c) * s.rank_light + a) * s.rank_view + b];
                  for (const float value : image) out = std::max(out, std::abs(value));
                });
  return largest;
}

Vector<float> largest_of_columns(std::span<const float> matrix, std::size_t columns, Memory* memory) {
  Vector<float> largest(columns, memory);
  for (std::size_t i = 0; i < matrix.size(); ++i)
    largest[i % columns] = std::max(largest[i % columns], std::abs(matrix[i]));
  return largest;
}

// The coefficients are multiplied by scale(cluster, b).
template <class Scale>
void pack_cells(const ViewCells& cells, std::uint32_t rank, Scale&& scale, TensorTables& tables) {
  const std::size_t count = std::size_t(cells.side) * cells.side;
  tables.side = cells.side;
  tables.terms = cells.terms;
  tables.blended = !cells.neighbours.empty();
  tables.coefficients.resize(count * 4 * cells.terms * tables.view_vec4_count);
  const std::size_t bytes = tables.member_bytes();
  if (tables.has_membership()) tables.membership.resize(count * 4 * vec4_count(tables.memberships()) * bytes);
  const auto set_member = [&](std::size_t cell, std::uint32_t k, std::uint16_t value) {
    std::uint8_t* const at = &tables.membership[((k / 4 * count + cell) * 4 + k % 4) * bytes];
    if (bytes == 1)
      *at = std::uint8_t(value);
    else
      std::memcpy(at, &value, sizeof value);
  };
  for (std::size_t cell = 0; cell < count; ++cell) {
    for (std::uint32_t k = 0; k < cells.terms; ++k) {
      const std::size_t term = cell * cells.terms + k;
      const std::uint32_t cluster = cells.rows.membership[term];
      for (std::uint32_t b = 0; b < rank; ++b)
        tables.coefficients[((std::size_t(k) * tables.view_vec4_count + b / 4) * count + cell) * 4 + b % 4] =
            finite_half(cells.rows.coefficients[term * rank + b] * scale(cluster, b));
      if (tables.has_membership()) set_member(cell, k, std::uint16_t(cluster));
    }
    if (tables.blended) set_member(cell, cells.terms, cells.neighbours[cell]);
  }
}

// Returns true if modes are divided by scales, which is done for integers and blocks.
bool has_scales(const Material& material, const ModeForm& form) {
  return material.bits == 8 || form.blocks != BlockForm::none;
}

// Sets the sizes of the tables. If there is a block format, the light modes from index `whole` on are stored
// in blocks. If the blocks would take too many bytes, throws Failure before it allocates.
void set_sizes(const TensorShape& s, std::uint32_t light_modes, BlockForm form, std::uint32_t whole,
               TensorTables& tables) {
  tables.width = s.width;
  tables.height = s.height;
  tables.levels = level_count(s.width, s.height);
  tables.light_modes = light_modes;
  tables.view_vec4_count = vec4_count(s.rank_view);
  tables.clusters = s.clusters;
  if (form == BlockForm::none || whole >= light_modes) return;
  tables.block_form = form;
  tables.packed_modes = light_modes - whole;
  check_block_bytes(tables.block_size());
}

// Allocates the blocks. Modes that only pad the ranks to multiples of 4 are zero.
void make_blocks(TensorTables& tables) {
  if (tables.block_form == BlockForm::none) return;
  tables.blocks.resize(tables.block_size().level_offset(tables.levels));
  std::uint8_t zeros[signed_block_bytes];
  encode_block(tables.block_form, {}, zeros);
  for (std::size_t at = 0; at < tables.blocks.size(); at += signed_block_bytes)
    std::copy_n(zeros, signed_block_bytes, &tables.blocks[at]);
}

void make_spatial(const ClusteredTensor& tensor, float scale, const Parallel& parallel, TensorTables& tables,
                  Memory* memory) {
  tables.spatial.resize(tables.image_size().level_offset(tables.levels));
  for_each_mode(tensor, parallel, memory,
                [&](std::uint32_t c, std::uint32_t a, std::uint32_t b, std::span<float> image,
                    std::span<float> other) noexcept {
                  for_each_texel(tables, c, a, b, image, other, [&](std::size_t at, float value) {
                    tables.spatial[at] = finite_half(value * scale);
                  });
                });
}

std::int8_t as_integer(float value) {
  return std::int8_t(std::nearbyint(std::clamp(value, -1.0f, 1.0f) * 127));
}

// Converts the modes that have scales to integers and blocks.
void make_scaled_spatial(const ClusteredTensor& tensor, const ModeScales& scales, const Parallel& parallel,
                         TensorTables& tables, Memory* memory) {
  tables.bits = 8;
  tables.spatial_8.resize(tables.image_size().level_offset(tables.levels));
  make_blocks(tables);
  const std::uint32_t whole = tables.whole_modes();
  for_each_mode(tensor, parallel, memory,
                [&](std::uint32_t c, std::uint32_t a, std::uint32_t b, std::span<float> image,
                    std::span<float> other) noexcept {
                  const float p = scales.p[std::size_t(c) * tensor.shape.rank_view + b];
                  const auto scaled = [&](float value) { return quotient(quotient(value, p), scales.r[a]); };
                  if (a >= whole)
                    encode_mode(tables, c, a - whole, b, image, other, scaled);
                  else
                    for_each_texel(tables, c, a, b, image, other, [&](std::size_t at, float value) {
                      tables.spatial_8[at] = as_integer(scaled(value));
                    });
                });
}

// Column a of the light basis is multiplied by scale(a).
template <class Scale>
void make_light_map(const Material& material, Scale&& scale, MaterialTables& tables, Memory* memory) {
  const std::uint32_t side = tables.light_side, rank = material.btf.shape.rank_light;
  const std::size_t count = std::size_t(side) * side, light_vec4_count = vec4_count(rank);
  const DirectionMesh mesh(material.lights, memory);
  tables.light.assign(3 * light_vec4_count * count * 4, 0.0f);
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
          tables.light[((layer * side + row) * side + column) * 4 + a % 4] = sum * scale(a) * share;
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

// The hash includes the scales of the light map, because other bakes that use the map depend on them.
std::uint64_t hash_of_light(const Material& material, std::span<const float> columns, float scale) {
  Hash64 hash;
  add_floats(hash, {&scale, 1});
  add_floats(hash, columns);
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
  return tables.spatial_8.size() + tables.blocks.size() + tables.membership.size() +
         2 * (std::uint64_t(tables.spatial.size()) + tables.coefficients.size());
}

float largest_of(std::span<const float> values) {
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

// Replaces the light map by integers, where 127 represents the value `unit`.
void round_light_map(MaterialTables& tables, float unit, Memory* memory) {
  tables.light_8.resize(tables.light.size());
  for (std::size_t i = 0; i < tables.light.size(); ++i)
    tables.light_8[i] = as_integer(quotient(tables.light[i], unit));
  tables.light = Vector<float>(memory);
}

// Adjusts the texels around each light until linear filtering at the light's direction returns the light's
// row of the basis. A correction is distributed over the four texels in proportion to their filter weights
// (S. Kaczmarz, 1937).
template <class Scale>
void fit_light_map(const Material& material, Scale&& scale, MaterialTables& tables) {
  constexpr int sweeps = 8;
  const std::uint32_t side = tables.light_side, rank = material.btf.shape.rank_light;
  const std::size_t light_vec4_count = vec4_count(rank);
  for (std::size_t step = 0; step < sweeps * material.lights.size(); ++step) {
    const std::size_t light = step % material.lights.size();
    const ParabolicPoint p = to_parabolic(material.lights[light]);
    const Between x = edge_clamped(0.5f * p.x + 0.5f, side), y = edge_clamped(0.5f * p.y + 0.5f, side);
    const std::size_t at[4] = {y.low * side + x.low, y.low * side + x.high, y.high * side + x.low,
                               y.high * side + x.high};
    const float weight[4] = {(1 - x.t) * (1 - y.t), x.t * (1 - y.t), (1 - x.t) * y.t, x.t * y.t};
    float squares = 0;
    for (const float w : weight) squares += w * w;
    for (std::size_t i = 0; i < 3 * std::size_t(rank); ++i) {
      const std::size_t channel = i / rank, a = i % rank;
      float* const layer = &tables.light[(channel * light_vec4_count + a / 4) * side * side * 4 + a % 4];
      float rest = material.light_basis[(3 * light + channel) * rank + a] * scale(std::uint32_t(a));
      for (int k = 0; k < 4; ++k) rest -= weight[k] * layer[4 * at[k]];
      for (int k = 0; k < 4; ++k) layer[4 * at[k]] += rest * weight[k] / squares;
    }
  }
}

// Returns the size, in cells along a side, of a small light map. The map has at least eight cells per light
// for up to 512 lights, and four per light for 1,024, so that few lights share texels.
std::uint32_t small_light_side(std::size_t lights) {
  return lights <= 128 ? 32 : 64;
}

// Makes the light map of integers, and returns the value that 127 represents. This value is computed from the
// map of default size, because other bakes depend on it, and it must not change with the size. Fitted texels
// with larger values are clamped.
template <class Scale>
float make_light_map_8(const Material& material, Scale&& scale, bool is_small, MaterialTables& tables,
                       Memory* memory) {
  make_light_map(material, scale, tables, memory);
  const float unit = largest_of(tables.light);
  if (is_small) {
    tables.light_side = small_light_side(material.lights.size());
    make_light_map(material, scale, tables, memory);
    fit_light_map(material, scale, tables);
  }
  round_light_map(tables, unit, memory);
  return unit;
}

void make_btf(const Material& material, std::uint32_t map_side, const ModeForm& form,
              const Parallel& parallel, MaterialTables& tables, Memory* memory) {
  const ClusteredTensor& btf = material.btf;
  const ViewCells cells = view_cells(btf, material.views, map_side, memory);
  if (!has_scales(material, form)) {
    const int exponent = spatial_exponent(btf, memory);
    tables.light_hash = hash_of_light(material, {}, float(exponent));
    make_spatial(btf, std::ldexp(1.0f, exponent), parallel, tables.btf, memory);
    pack_cells(
        cells, btf.shape.rank_view, [](std::uint32_t, std::uint32_t) { return 1.0f; }, tables.btf);
    make_light_map(
        material, [scale = std::ldexp(1.0f, -exponent)](std::uint32_t) { return scale; }, tables, memory);
    return;
  }
  const ModeScales scales =
      mode_scales(btf.shape, largest_of_modes(btf, parallel, memory),
                  largest_of_columns(material.light_basis, btf.shape.rank_light, memory), memory);
  make_scaled_spatial(btf, scales, parallel, tables.btf, memory);
  const float unit = make_light_map_8(
      material, [&](std::uint32_t a) { return scales.r[a]; }, form.blocks != BlockForm::none, tables, memory);
  pack_cells(
      cells, btf.shape.rank_view,
      [&](std::uint32_t c, std::uint32_t b) {
        return scales.p[std::size_t(c) * btf.shape.rank_view + b] * unit;
      },
      tables.btf);
  tables.light_hash = hash_of_light(material, scales.r, unit);
}

void make_votf(const Material& material, std::uint32_t map_side, const ModeForm& form,
               const Parallel& parallel, MaterialTables& tables, Memory* memory) {
  const ClusteredTensor& votf = material.votf;
  const ViewCells cells = view_cells(votf, material.views, map_side, memory);
  tables.votf_hash = hash_of_votf(material);
  if (!has_scales(material, form)) {
    // The coefficients are multiplied by the inverse of this power of two, which costs them precision. So the
    // power of two differs from 1 only if a half float would overflow.
    const int exponent = std::min(spatial_exponent(votf, memory), 0);
    make_spatial(votf, std::ldexp(1.0f, exponent), parallel, tables.votf, memory);
    pack_cells(
        cells, votf.shape.rank_view,
        [scale = std::ldexp(1.0f, -exponent)](std::uint32_t, std::uint32_t) { return scale; }, tables.votf);
    return;
  }
  const ModeScales scales = mode_scales(votf.shape, largest_of_modes(votf, parallel, memory), {}, memory);
  make_scaled_spatial(votf, scales, parallel, tables.votf, memory);
  pack_cells(
      cells, votf.shape.rank_view,
      [&](std::uint32_t c, std::uint32_t b) {
        return scales.p[std::size_t(c) * votf.shape.rank_view + b] * scales.r[0];
      },
      tables.votf);
}

void make_neural(const Material& material, MaterialTables& tables, Memory* memory) {
  tables.neural = make_neural_tables(material.neural, material.views, material.lights, memory);
  tables.btf.width = tables.neural.size.width;
  tables.btf.height = tables.neural.size.height;
  tables.btf.levels = tables.neural.size.levels;
}

}  // namespace

MaterialTables make_tables(const Material& material, const Parallel& parallel, Memory* memory,
                           std::uint32_t map_side, const ModeForm& form) {
  MaterialTables tables(memory);
  const bool is_neural = material.neural.is_used(), has_votf = material.visibility != VisibilityForm::none;
  if (!is_neural)
    set_sizes(material.btf.shape, 4 * vec4_count(material.btf.shape.rank_light), form.blocks,
              4 * vec4_count(form.whole_light_modes), tables.btf);
  if (has_votf) set_sizes(material.votf.shape, 1, form.blocks, 0, tables.votf);
  if (is_neural)
    make_neural(material, tables, memory);
  else
    make_btf(material, map_side, form, parallel, tables, memory);
  tables.visibility = material.visibility;
  tables.mapping = material.mapping;
  tables.relief = make_relief_tables(material.relief, tables.btf.width, tables.btf.height, memory);
  if (has_votf) make_votf(material, map_side, form, parallel, tables, memory);
  return tables;
}

std::uint64_t table_bytes(const MaterialTables& tables) {
  return tables.neural.features.size() + tensor_bytes(tables.btf) + tensor_bytes(tables.votf) +
         2 * tables.relief.heights.size() + tables.light_8.size() + 4 * std::uint64_t(tables.light.size());
}

}  // namespace nook::material
