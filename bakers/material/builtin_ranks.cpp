#include "bakers/material/builtin_ranks.h"

namespace nook::bake::material {
namespace {

struct DefaultRanks {
  const char* material;
  std::uint32_t light, view, x, y, votf_x, votf_y;
};

// The paper's Table I for the first two, for 96 x 96 texels.
constexpr DefaultRanks builtin_ranks[] = {{"fiber", 16, 80, 64, 64, 80, 80},
                                          {"roughhole", 28, 44, 96, 96, 80, 80},
                                          {"weave", 20, 40, 48, 48, 48, 48}};

// Ranks that a smaller version of a built-in material allows, multiples of 4 where there is room.
std::uint32_t at_most(std::uint32_t rank, std::size_t size) {
  if (rank <= size) return rank;
  return size >= 4 ? std::uint32_t(size / 4 * 4) : std::uint32_t(size);
}

}  // namespace

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
