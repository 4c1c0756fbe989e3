#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {

namespace {

struct Family {
  const char* name;
  TrainingScene (*make)(Random&);
};

constexpr Family families[family_count] = {
    {"room", make_room},       {"clutter", make_clutter},     {"railings", make_railings},
    {"foliage", make_foliage}, {"stairs", make_stairs},       {"machinery", make_machinery},
    {"people", make_people},   {"terrain", make_terrain},     {"dining room", make_dining_room},
    {"hull", make_hull},       {"arcade", make_arcade},       {"street", make_street},
    {"relief", make_relief},   {"furniture", make_furniture}, {"drapery", make_drapery},
    {"statues", make_statues}, {"armour", make_armour},       {"forest", make_forest},
    {"hall", make_hall},       {"parts", make_parts},         {"stacks", make_stacks},
    {"wires", make_wires},     {"terraces", make_terraces},   {"vehicles", make_vehicles}};

}  // namespace

const char* family_name(std::uint32_t family) {
  return families[family % family_count].name;
}

TrainingScene make_scene(std::uint64_t seed, std::uint32_t index) {
  Random random(mix_bits(seed) + index);
  TrainingScene scene = families[index % family_count].make(random);
  if (index < family_count) return scene;
  if (random.chance(0.45f)) {
    const TrainingScene guest = families[random.below(family_count)].make(random);
    for (int groups = random.whole(1, 4); groups > 0; --groups) add_guests(scene, guest, random);
  }
  if (random.chance(0.5f)) scale_scene(scene, random.log_between(0.2f, 5));
  return scene;
}

void add_floor(TriangleSoup& soup, float half_width) {
  const float w = half_width;
  add_quad(soup, {-w, 0, -w}, {w, 0, -w}, {w, 0, w}, {-w, 0, w});
}

}  // namespace nook::bake::nnao
