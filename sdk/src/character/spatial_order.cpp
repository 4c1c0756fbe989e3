#include "sdk/src/character/spatial_order.h"

#include <algorithm>

namespace nook {
namespace {

std::size_t longest_side(std::span<const std::uint32_t> indices, const Vector<Place>& places) {
  Place low = places[indices[0]], high = low;
  for (const std::uint32_t v : indices)
    for (std::size_t a = 0; a < low.size(); ++a) {
      low[a] = std::min(low[a], places[v][a]);
      high[a] = std::max(high[a], places[v][a]);
    }
  std::size_t longest = 0;
  for (std::size_t a = 1; a < low.size(); ++a)
    if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
  return longest;
}

}  // namespace

// The recursion depth is the logarithm of the number of blocks.
void order_in_space(std::span<std::uint32_t> indices, std::size_t block, const Vector<Place>& places) {
  if (indices.size() <= block) return;
  const std::size_t blocks = (indices.size() + block - 1) / block;
  const std::size_t middle = blocks / 2 * block;
  const std::size_t side = longest_side(indices, places);
  std::nth_element(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(middle), indices.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return places[a][side] != places[b][side] ? places[a][side] < places[b][side] : a < b;
                   });
  order_in_space(indices.first(middle), block, places);
  order_in_space(indices.subspan(middle), block, places);
}

}  // namespace nook
