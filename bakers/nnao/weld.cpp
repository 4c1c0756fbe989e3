#include "bakers/nnao/weld.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace nook::bake::nnao {

Places weld(std::span<const Vec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::tuple(positions[i].x, positions[i].y, positions[i].z);
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  Places places;
  places.of.resize(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    places.count += i == 0 || key(order[i - 1]) != key(order[i]);
    places.of[order[i]] = places.count - 1;
  }
  return places;
}

}  // namespace nook::bake::nnao
