#include "bakers/measure/nnao/mover_stage.h"

#include <numbers>

#include "bakers/nnao/scene_families.h"

namespace nook::measure {

using namespace bake::nnao;

bake::TriangleSoup mover_stage() {
  bake::TriangleSoup soup;
  bake::Random random(1);
  constexpr float wall_z = -0.8f, far = 20;
  add_quad(soup, {-far, 0, far}, {far, 0, far}, {far, 0, wall_z}, {-far, 0, wall_z});
  add_quad(soup, {-far, 0, wall_z}, {far, 0, wall_z}, {far, 3, wall_z}, {-far, 3, wall_z});
  add_block(soup, {-far, 0, wall_z}, {far, 0.1f, wall_z + 0.02f});
  add_block(soup, {-1.5f, 0, wall_z + 0.05f}, {-1.1f, 0.4f, wall_z + 0.4f});
  add_block(soup, {-1.05f, 0, wall_z + 0.1f}, {-0.8f, 0.25f, wall_z + 0.35f});
  add_table(soup, standing_frame({2.2f, 0, wall_z + 0.5f}, 0), random);
  add_chair(soup, standing_frame({0.75f, 0, wall_z + 0.3f}, 0.3f), random);
  add_rod(soup, {0.35f, 0, 0.7f}, {0.35f, 3, 0.7f}, 0.03f, 16);
  return soup;
}

std::array<MoverShot, 4> mover_shots() {
  constexpr float right = std::numbers::pi_v<float> / 2, degree = std::numbers::pi_v<float> / 180;
  return {{{"whole", {0.6f, 1.4f, 3.6f}, {0, 0.85f, 0}, 40 * degree, right},
           {"feet", {0.5f, 0.5f, 1.5f}, {0, 0.25f, 0}, 45 * degree, right},
           {"above", {-1.4f, 2.4f, 2.0f}, {0, 0.7f, 0}, 50 * degree, right},
           {"towards", {-0.5f, 1.3f, 3.0f}, {0, 0.8f, 0}, 45 * degree, 0}}};
}

}  // namespace nook::measure
