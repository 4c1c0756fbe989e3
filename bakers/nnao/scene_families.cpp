#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {

TrainingScene make_scene(std::uint64_t seed, std::uint32_t index) {
  using Make = TrainingScene (*)(Random&);
  constexpr Make families[family_count] = {make_room,        make_clutter,   make_railings, make_foliage,
                                           make_stairs,      make_machinery, make_people,   make_terrain,
                                           make_dining_room, make_hull};
  Random random(mix_bits(seed) + index);
  return families[index % family_count](random);
}

void add_floor(TriangleSoup& soup, float half_width) {
  const float w = half_width;
  add_quad(soup, {-w, 0, -w}, {w, 0, -w}, {w, 0, w}, {-w, 0, w});
}

}  // namespace nook::bake::nnao
