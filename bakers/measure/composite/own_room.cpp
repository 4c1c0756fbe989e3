#include "bakers/measure/composite/own_room.h"

#include "bakers/import/static_scene.h"
#include "bakers/nnao/solids.h"

namespace nook::measure {
namespace {

using namespace bake;
using namespace bake::nnao;

constexpr float half_x_m = 3, half_z_m = 2.5f, height_m = 2.7f;

void add_walls(TriangleSoup& soup) {
  constexpr float thick = 0.2f;
  add_block(soup, {-half_x_m, -thick, -half_z_m}, {half_x_m, 0, half_z_m});
  add_block(soup, {-half_x_m, height_m, -half_z_m}, {half_x_m, height_m + thick, half_z_m});
  for (const float side : {-1.0f, 1.0f}) {
    add_block(soup, {side * (half_x_m + 0.5f * thick) - 0.5f * thick, 0, -half_z_m},
              {side * (half_x_m + 0.5f * thick) + 0.5f * thick, height_m, half_z_m});
    add_block(soup, {-half_x_m, 0, side * (half_z_m + 0.5f * thick) - 0.5f * thick},
              {half_x_m, height_m, side * (half_z_m + 0.5f * thick) + 0.5f * thick});
  }
}

void add_steps(TriangleSoup& soup) {
  for (int step = 0; step < 3; ++step)
    add_block(soup, {half_x_m - 0.9f + 0.3f * float(step), 0, -half_z_m},
              {half_x_m, 0.17f * float(step + 1), -half_z_m + 1.6f});
}

void add_table_with_legs(TriangleSoup& soup, Vec3 middle, Vec3 half, float height, float leg) {
  add_block(soup, {middle.x - half.x, height - 0.04f, middle.z - half.z},
            {middle.x + half.x, height, middle.z + half.z});
  for (const float x : {-1.0f, 1.0f})
    for (const float z : {-1.0f, 1.0f})
      add_rod(soup, {middle.x + x * (half.x - leg), 0, middle.z + z * (half.z - leg)},
              {middle.x + x * (half.x - leg), height - 0.04f, middle.z + z * (half.z - leg)}, leg);
}

void add_chair_with_back(TriangleSoup& soup, Vec3 middle, float side) {
  add_table_with_legs(soup, middle, {0.21f, 0, 0.21f}, 0.45f, 0.02f);
  add_block(soup, {middle.x - 0.21f, 0.45f, middle.z + side * 0.19f - 0.02f},
            {middle.x + 0.21f, 0.95f, middle.z + side * 0.19f + 0.02f});
}

void add_shelf(TriangleSoup& soup) {
  for (int board = 0; board < 5; ++board)
    add_block(soup, {-half_x_m, 0.45f * float(board), 0.2f},
              {-half_x_m + 0.32f, 0.45f * float(board) + 0.03f, 1.8f});
  for (const float z : {0.2f, 1.77f})
    add_block(soup, {-half_x_m, 0, z}, {-half_x_m + 0.32f, 1.83f, z + 0.03f});
}

}  // namespace

TriangleSoup own_room() {
  TriangleSoup soup;
  add_walls(soup);
  add_steps(soup);
  add_table_with_legs(soup, {-0.6f, 0, -0.8f}, {0.8f, 0, 0.45f}, 0.75f, 0.035f);
  add_chair_with_back(soup, {-0.9f, 0, 0.05f}, 1);
  add_chair_with_back(soup, {-0.3f, 0, -1.65f}, -1);
  add_shelf(soup);
  return soup;
}

bake::TriangleSoup room_of(const std::filesystem::path& file, float metres_per_unit) {
  StaticScene scene = import_static_scene(file);
  for (Vec3& p : scene.position) p = metres_per_unit * p;
  return {std::move(scene.position), std::move(scene.triangle)};
}

}  // namespace nook::measure
