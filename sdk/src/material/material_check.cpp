#include "sdk/src/material/material_check.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"

namespace nook::material {
namespace {

struct Check {
  nook_result code;
  const char* name;  // "BTF"

  void range(const char* what, std::uint64_t got, std::uint64_t low, std::uint64_t high) const {
    if (got < low || got > high)
      throw Failure(code,
                    "%s of the %s is out of range (got %llu, need %llu to %llu); bake the material again",
                    what, name, static_cast<unsigned long long>(got), static_cast<unsigned long long>(low),
                    static_cast<unsigned long long>(high));
  }
  void sized(const char* what, std::size_t got, std::size_t need) const {
    if (got != need)
      throw Failure(code, "the array of %s of the %s has the wrong length (got %zu, need %zu)", what, name,
                    got, need);
  }
  void numbers(const char* what, const Vector<float>& values, float limit) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(std::abs(values[i]) <= limit))
        throw Failure(code, "element %zu of the %s of the %s is out of range (got %g, need at most %g)", i,
                      what, name, double(values[i]), double(limit));
  }
};

void check_directions(const Vector<Vec3>& directions, const Check& check) {
  check.range("the number of directions", directions.size(), 1, max_directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3 d = directions[i];
    // The tolerance of 1e-3 is far above rounding errors. A vector that was not normalised usually differs by
    // far more.
    if (!(std::abs(length(d) - 1) <= 1e-3f) || !(d.z >= 0))
      throw Failure(check.code,
                    "direction %zu of the %s is not a unit vector of the upper hemisphere (got %g %g %g)", i,
                    check.name, double(d.x), double(d.y), double(d.z));
    for (std::size_t j = 0; j < i; ++j)
      if (length(directions[j] - d) < min_distance)
        throw Failure(check.code, "directions %zu and %zu of the %s are the same (%g %g %g); leave one out",
                      j, i, check.name, double(d.x), double(d.y), double(d.z));
  }
}

void check_rows(const ViewRows& rows, const TensorShape& shape, std::size_t count, const char* members,
                const char* coefficients, const Check& check) {
  check.sized(members, rows.membership.size(), count * shape.mixture);
  check.sized(coefficients, rows.coefficients.size(), coefficient_count(shape, count));
  check.numbers(coefficients, rows.coefficients, max_number);
  for (std::size_t row = 0; row < count; ++row) {
    const std::uint16_t* const first = &rows.membership[row * shape.mixture];
    for (std::uint32_t k = 0; k < shape.mixture; ++k) {
      if (first[k] >= shape.clusters)
        throw Failure(check.code,
                      "%s %zu of the %s refers to a cluster that does not exist (got %u, need less than %u)",
                      members, row * shape.mixture + k, check.name, first[k], shape.clusters);
      if (std::find(first, first + k, first[k]) != first + k)
        throw Failure(check.code, "%s of row %zu of the %s contain cluster %u twice", members, row,
                      check.name, first[k]);
    }
  }
}

void check_tensor(const ClusteredTensor& tensor, std::size_t lights, std::size_t views, const char* name,
                  nook_result code) {
  check_shape(tensor.shape, lights, views, name, code);
  const TensorShape& shape = tensor.shape;
  const Check check{code, name};
  check.sized("cores", tensor.cores.size(), shape.clusters * core_size(shape));
  check.sized("x bases", tensor.x_bases.size(), shape.clusters * x_basis_size(shape));
  check.sized("y bases", tensor.y_bases.size(), shape.clusters * y_basis_size(shape));
  check.numbers("cores", tensor.cores, max_core);
  check.numbers("x bases", tensor.x_bases, max_number);
  check.numbers("y bases", tensor.y_bases, max_number);
  check_rows(tensor.rows, shape, views, "memberships", "coefficients", check);
  if (tensor.map.side != 0) check.range("the side of the view map", tensor.map.side, 2, max_map_side);
  check_rows(tensor.map.rows, shape, std::size_t(tensor.map.side) * tensor.map.side, "map memberships",
             "map coefficients", check);
}

void check_relief(const Relief& relief, const TensorShape& btf, nook_result code) {
  const Check check{code, "relief"};
  for (const float height : {relief.low, relief.high})
    if (!(std::abs(height) <= max_relief_height))
      throw Failure(code, "a height of the relief is out of range (got %g, need at most %g tiles)",
                    double(height), double(max_relief_height));
  if (!(relief.low <= relief.high))
    throw Failure(code, "the relief's lowest height %g is above its highest %g", double(relief.low),
                  double(relief.high));
  check_range("the slope of the relief's views", relief.max_slope, 0, max_relief_slope, code);
  const bool is_plane = relief.steps == 0;
  check.range("the number of steps", relief.steps, 0, max_relief_steps);
  check.sized("levels", relief.levels.size(), is_plane ? 0 : std::size_t(btf.width) * btf.height);
  if (is_plane && relief.low != relief.high)
    throw Failure(code, "the relief has 0 steps, but its heights reach from %g to %g", double(relief.low),
                  double(relief.high));
}

void check_neural(const Material& material, nook_result code) {
  const Neural& neural = material.neural;
  check_neural_shape(neural.shape, code);
  const Check check{code, "neural material"};
  check.sized("blocks", neural.blocks.size(), neural_block_bytes_of(neural.shape));
  check.sized("weights", neural.weights.size(), NeuralLayout(neural.shape).count);
  for (std::size_t i = 0; i < neural.blocks.size(); i += neural_block_bytes) {
    const int upper = std::int8_t(neural.blocks[i]), lower = std::int8_t(neural.blocks[i + 1]);
    if (upper < lower || lower < -neural_feature_steps)
      throw Failure(code,
                    "the end values of block %zu of the neural material are out of range (got %d and %d, "
                    "need the upper value first, and both at least -127)",
                    i / neural_block_bytes, upper, lower);
  }
  for (std::size_t i = 0; i < neural.weights.size(); ++i)
    if ((neural.weights[i] & 0x7c00u) == 0x7c00u)
      throw Failure(code, "weight %zu of the neural material is not finite", i);
  check.sized("cores", material.btf.cores.size(), 0);
  check.sized("the light basis", material.light_basis.size(), 0);
  check.sized("the view map's side", material.btf.map.side, 0);
  if (material.relief.moves())
    throw Failure(code, "the material is neural and has a relief; its features already have an offset");
}

void check_btf(const Material& material, nook_result code) {
  const std::size_t lights = material.lights.size();
  check_tensor(material.btf, lights, material.views.size(), "BTF", code);
  check_relief(material.relief, material.btf.shape, code);
  const Check light{code, "light mode"};
  light.sized("the basis", material.light_basis.size(), 3 * lights * material.btf.shape.rank_light);
  light.numbers("basis", material.light_basis, max_number);
}

}  // namespace

void check_neural_shape(const NeuralShape& s, nook_result code) {
  const Check check{code, "neural material"};
  check.range("the width in texels", s.width, 1, max_texels);
  check.range("the height in texels", s.height, 1, max_texels);
  check.range("the number of layers", s.layers, 1, max_neural_layers);
  const struct {
    const char* what;
    std::uint32_t got, most;
  } sizes[] = {{"the number of channels", s.channels, max_neural_channels},
               {"the number of units", s.units, max_neural_units},
               {"the number of channels of the offset", s.offset_channels, max_neural_channels},
               {"the number of units of the offset", s.offset_units, max_neural_units}};
  for (const auto& size : sizes) {
    check.range(size.what, size.got, 4, size.most);
    if (size.got % 4 != 0)
      throw Failure(code, "%s of the neural material is not a multiple of 4 (got %u)", size.what, size.got);
  }
}

void check_block_bytes(const BlockSize& size) {
  // 64 bits, because size_t may have only 32.
  std::uint64_t bytes = 0;
  for (std::uint32_t level = 0; level < size.levels; ++level)
    bytes += std::uint64_t(size.layer_bytes(level)) * size.layers;
  if (bytes > max_block_bytes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the material's modes of %u x %u texels take too many bytes in blocks (got %llu, need at "
                  "most %llu); load it with NOOK_MATERIAL_BLOCKS_NONE",
                  size.width, size.height, static_cast<unsigned long long>(bytes),
                  static_cast<unsigned long long>(max_block_bytes));
}

void refuse_neural(bool is_neural, const char* what) {
  if (is_neural)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the material is neural, so its radiance is not a sum of light modes, which %s needs; bake "
                  "it with the method k-cta",
                  what);
}

void check_shape(const TensorShape& shape, std::size_t lights, std::size_t views, const char* name,
                 nook_result code) {
  const Check check{code, name};
  check.range("the number of views", shape.views, views, views);
  check.range("the width in texels", shape.width, 1, max_texels);
  check.range("the height in texels", shape.height, 1, max_texels);
  check.range("the light rank", shape.rank_light, 1, lights ? 3 * lights : 1);
  check.range("the view rank", shape.rank_view, 1, shape.views);
  check.range("the x rank", shape.rank_x, 1, shape.width);
  check.range("the y rank", shape.rank_y, 1, shape.height);
  check.range("the number of clusters", shape.clusters, 1, shape.views);
  check.range("the number of mixture clusters", shape.mixture, 1, std::min(shape.clusters, max_mixture));
  check.range("mixture clusters times view rank", std::uint64_t(shape.mixture) * shape.rank_view, 1, max_row);
  // Decoding rounds both ranks of a BTF up to multiples of 4. For a VOTF, it rounds only the view rank.
  const std::uint64_t light_modes = lights ? (shape.rank_light + 3) / 4 * 4 : 1;
  const std::uint64_t view_modes = (shape.rank_view + 3) / 4 * 4;
  check.range("the expanded size", shape.clusters * light_modes * view_modes * shape.width * shape.height, 1,
              max_expanded);
}

void check_material(const Material& material, nook_result code) {
  if (material.bits != 8 && material.bits != 16)
    throw Failure(code, "the number format is unknown (got %u bits, need 8 or 16)", material.bits);
  check_fits("the rounding of cores", material.core_rounding,
             material.core_rounding > 0 && material.core_rounding < 1, "more than 0 and less than 1", code);
  check_directions(material.lights, {code, "lights"});
  check_directions(material.views, {code, "views"});
  material.neural.is_used() ? check_neural(material, code) : check_btf(material, code);
  const Check votf{code, "VOTF"};
  votf.range("the form of visibility", std::uint64_t(material.visibility), 0,
             std::uint64_t(VisibilityForm::distance));
  if (material.visibility == VisibilityForm::none) {
    votf.sized("cores", material.votf.cores.size(), 0);
    return;
  }
  check_tensor(material.votf, 0, material.views.size(), "VOTF", code);
  const auto [threshold, weight] = material.mapping;
  if (!(threshold >= 0 && threshold <= max_number && weight >= 0 && weight <= max_number))
    throw Failure(code, "the visibility mapping is out of range (got threshold %g, weight %g, need 0 to %g)",
                  double(threshold), double(weight), double(max_number));
}

}  // namespace nook::material
