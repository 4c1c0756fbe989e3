#include "bakers/material/compression_settings.h"

#include <algorithm>

#include "bakers/material/visibility_values.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_check.h"

namespace nook::bake::material {
namespace {

using nook::material::VisibilityForm;

// Checks the limits of a file before hours of tracing and fitting, like check_shape() of sdk's
// material/material_check.h.
void check_file_limits(const CompressionSettings& s, const RawMaterial& raw) {
  const bool clustered = s.method != Method::n_svd;
  const std::uint64_t rank = clustered ? s.cluster_rank_view : s.rank_view;
  const std::uint64_t row = rank * (s.method == Method::k_cta ? s.mixture : 1);
  if (row > nook::material::max_row)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "each view has %llu coefficients (its clusters times their view "
                  "rank), but the file format allows only %u",
                  static_cast<unsigned long long>(row), nook::material::max_row);
  const auto round_up_to_4 = [](std::uint64_t n) { return (n + 3) / 4 * 4; };
  const std::uint64_t expanded = (clustered ? s.cluster_count() : 1) * round_up_to_4(s.rank_light) *
                                 round_up_to_4(rank) * raw.width * raw.height;
  if (expanded > nook::material::max_expanded)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the material has %llu expanded numbers (light rank times view rank times texels), but the "
                  "file format allows only %llu; use lower ranks or fewer texels",
                  static_cast<unsigned long long>(expanded),
                  static_cast<unsigned long long>(nook::material::max_expanded));
}

struct DefaultRanks {
  const char* material;
  std::uint32_t light, view, x, y, votf_x, votf_y;
};

// The first two are from the paper's Table I, for 96 x 96 texels.
constexpr DefaultRanks builtin_ranks[] = {{"fiber", 16, 80, 64, 64, 80, 80},
                                          {"roughhole", 28, 44, 96, 96, 80, 80},
                                          {"weave", 20, 40, 48, 48, 48, 48}};

// Returns the rank, limited to the size of its mode, for materials that are smaller than the built-in ones. A
// limited rank is a multiple of 4 if the size is at least 4.
std::uint32_t at_most(std::uint32_t rank, std::size_t size) {
  if (rank <= size) return rank;
  return size >= 4 ? std::uint32_t(size / 4 * 4) : std::uint32_t(size);
}

}  // namespace

nook::material::VisibilityMapping default_mapping(VisibilityForm form, std::uint32_t width,
                                                  std::uint32_t height) {
  if (form != VisibilityForm::distance) return nook::material::paper_mapping(form);
  const float threshold = saturated_distance(0.5f, std::max(width, height));
  return {threshold, 1 / threshold};
}

void check_neural(const CompressionSettings& s) {
  if (s.neural_channels < 4 || s.neural_channels > nook::material::max_neural_channels ||
      s.neural_channels % 4 != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the number of channels of a neural material is %u; need a multiple of 4 from 4 to %u",
                  s.neural_channels, nook::material::max_neural_channels);
  if (s.neural_steps < 1 || s.neural_steps > max_neural_steps)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the number of training steps is %u; need 1 to %u",
                  s.neural_steps, max_neural_steps);
  if (s.relief != ReliefSource::none)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a neural material cannot have a relief, because its network already learns an offset that "
                  "depends on the view; choose another method, or leave the relief out");
}

void check_settings(const CompressionSettings& s, const RawMaterial& raw) {
  check_settings(s, raw, !raw.mask.empty());
}

void check_settings(const CompressionSettings& s, const RawMaterial& raw, bool has_mask) {
  if (s.bits != 8 && s.bits != 16)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the numbers of the material have %u bits; need 8 or 16",
                  s.bits);
  if (s.method == Method::neural) {
    check_neural(s);
    if (will_have_votf(has_mask, s)) check_settings(votf_settings(s), raw, has_mask);
    return;
  }
  const auto check = [](std::size_t got, std::size_t most, const char* what, const char* of) {
    if (got < 1 || got > most)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is %zu; %s allows 1 to %zu", what, got, of, most);
  };
  const std::size_t views = raw.views.size();
  check(s.rank_light, raw.light_rows(), "the light rank", "three times the number of lights");
  check(s.rank_view, views, "the view rank", "the number of views");
  check(s.rank_x, raw.width, "the x rank", "the width in texels");
  check(s.rank_y, raw.height, "the y rank", "the height in texels");
  if (will_have_votf(has_mask, s)) {
    check(s.votf_rank_x, raw.width, "the VOTF's x rank", "the width in texels");
    check(s.votf_rank_y, raw.height, "the VOTF's y rank", "the height in texels");
  }
  if (s.mapping && !(s.mapping->threshold >= 0 && s.mapping->threshold <= nook::material::max_number &&
                     s.mapping->weight >= 0 && s.mapping->weight <= nook::material::max_number))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the visibility mapping has the threshold %g and the weight %g; need 0 to %g for each",
                  double(s.mapping->threshold), double(s.mapping->weight),
                  double(nook::material::max_number));
  check_file_limits(s, raw);
  if (s.method == Method::n_svd) return;
  check(s.cluster_rank_view, views, "the view rank of a cluster", "the number of views");
  check(s.cluster_count(), views, "the number of clusters", "the number of views");
  if (s.method == Method::k_cta)
    check(s.mixture, std::min(s.cluster_count(), nook::material::max_mixture), "the mixture K",
          "the number of clusters or the file format");
  if (s.map_side == 1 || s.map_side > nook::material::max_map_side)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the view map has %u cells along a side; need 2 to %u, or 0 for none", s.map_side,
                  nook::material::max_map_side);
}

void set_lowest_ranks(const RawMaterial& sizes, CompressionSettings& s) {
  s.rank_light = s.rank_x = s.rank_y = s.votf_rank_x = s.votf_rank_y = 1;
  s.rank_view = std::min(s.cluster_rank_view, std::uint32_t(sizes.views.size()));
}

bool set_builtin_ranks(const RawMaterial& raw, CompressionSettings& s) {
  for (const DefaultRanks& d : builtin_ranks) {
    if (raw.name != d.material) continue;
    s.rank_light = at_most(d.light, raw.light_rows());
    s.rank_view = at_most(d.view, raw.views.size());
    s.rank_x = at_most(d.x, raw.width);
    s.rank_y = at_most(d.y, raw.height);
    s.votf_rank_x = at_most(d.votf_x, raw.width);
    s.votf_rank_y = at_most(d.votf_y, raw.height);
    return true;
  }
  return false;
}

}  // namespace nook::bake::material
