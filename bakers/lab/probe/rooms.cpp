#include "bakers/lab/probe/rooms.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::lab {
namespace {

using bake::LitTriangles;
using bake::Surface;

constexpr float door_height = 2.1f;
constexpr float into = 0.02f;  // overlap of walls in metres, so that no ray passes through a seam

// The space between the outer walls reaches from 0 to this size. All lengths are in metres.
struct Building {
  float width, height, depth;
  float thickness;  // thickness of the walls between rooms
  float shell;      // thickness of outer walls, floor and ceiling
};
constexpr Building six_rooms{12, 2.8f, 9.5f, 0.1f, 0.2f}, house{8.2f, 2.5f, 4.9f, 0.06f, 0.06f};

class Builder {
 public:
  Builder(const Building& building, LitTriangles& scene, std::vector<AxisBox>& solids)
      : building_(building), scene_(scene), solids_(solids) {}

  std::uint32_t surface(Vec3 base_colour, Vec3 emission = {}) {
    Surface made;
    made.base_colour = base_colour;
    made.emission = emission;
    scene_.surface.push_back(made);
    return std::uint32_t(scene_.surface.size() - 1);
  }

  // Adds a box whose faces point outwards.
  void box(Vec3 low, Vec3 high, std::uint32_t surface) {
    solids_.push_back({low, high});
    const auto first = std::uint32_t(scene_.soup.position.size());
    for (int i = 0; i < 8; ++i)
      scene_.soup.position.push_back(
          {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    constexpr std::uint32_t corner[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                             {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                             {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& c : corner) {
      scene_.soup.triangle.push_back({first + c[0], first + c[1], first + c[2]});
      scene_.triangle_surface.push_back(surface);
    }
  }

  // Add a wall from floor to ceiling, along x or along z. Its side with the lower coordinate is at `z` or
  // `x`.
  void along_x(float x0, float x1, float z, std::uint32_t surface, float from = 0) {
    box({x0 - into, from - (from > 0 ? 0 : into), z},
        {x1 + into, building_.height + into, z + building_.thickness}, surface);
  }
  void along_z(float x, float z0, float z1, std::uint32_t surface) {
    box({x, -into, z0 - into}, {x + building_.thickness, building_.height + into, z1 + into}, surface);
  }
  void lamp(float x, float z, float size, Vec3 emission) {
    const std::uint32_t made = surface({0.5f, 0.5f, 0.5f}, emission);
    const float top = building_.height;
    box({x - size / 2, top - 0.01f, z - size / 2}, {x + size / 2, top + into, z + size / 2}, made);
  }

  const Building& building() const { return building_; }

 private:
  Building building_;
  LitTriangles& scene_;
  std::vector<AxisBox>& solids_;
};

// An opening in the outer wall at z = 0.
struct Window {
  float left, right, sill, top;
};

void build_shell(Builder& b, std::optional<Window> window = {}) {
  const auto [width, height, depth, thickness, shell] = b.building();
  const std::uint32_t floor = b.surface({0.5f, 0.45f, 0.4f}), ceiling = b.surface({0.8f, 0.8f, 0.8f}),
                      wall = b.surface({0.7f, 0.7f, 0.68f});
  b.box({-shell, -shell, -shell}, {width + shell, 0, depth + shell}, floor);
  b.box({-shell, height, -shell}, {width + shell, height + shell, depth + shell}, ceiling);
  b.box({-shell, -into, -shell}, {0, height + into, depth + shell}, wall);
  b.box({width, -into, -shell}, {width + shell, height + into, depth + shell}, wall);
  if (window) {
    b.box({-into, -into, -shell}, {window->left, height + into, 0}, wall);
    b.box({window->right, -into, -shell}, {width + into, height + into, 0}, wall);
    b.box({window->left - into, -into, -shell}, {window->right + into, window->sill, 0}, wall);
    b.box({window->left - into, window->top, -shell}, {window->right + into, height + into, 0}, wall);
  } else {
    b.box({-into, -into, -shell}, {width + into, height + into, 0}, wall);
  }
  b.box({-into, -into, depth}, {width + into, height + into, depth + shell}, wall);
}

void build_partitions(Builder& b) {
  const float width = b.building().width, depth = b.building().depth;
  const std::uint32_t wall = b.surface({0.7f, 0.68f, 0.65f});
  b.along_x(0, 10.2f, 3.9f, wall);
  b.along_x(10.2f, 11.1f, 3.9f, wall, door_height);
  b.along_x(11.1f, width, 3.9f, wall);
  b.along_z(3.9f, 0, 3.9f, wall);
  b.along_z(8.0f, 0, 3.9f, wall);
  b.along_x(0, 1.0f, 5.5f, wall);
  b.along_x(1.0f, 1.9f, 5.5f, wall, door_height);
  b.along_x(1.9f, width, 5.5f, wall);
  b.along_z(4.95f, 5.6f, depth, wall);
  b.along_z(8.5f, 5.6f, depth, wall);
}

void build_furniture(Builder& b) {
  const std::uint32_t wood = b.surface({0.5f, 0.35f, 0.2f}), cloth = b.surface({0.2f, 0.3f, 0.5f}),
                      white = b.surface({0.75f, 0.75f, 0.75f});
  b.box({1.0f, 0.7f, 1.0f}, {2.4f, 0.75f, 1.9f}, wood);  // top of a table
  b.box({1.6f, 0, 1.35f}, {1.8f, 0.7f, 1.55f}, wood);
  b.box({3.3f, 0, 0.2f}, {3.88f, 1.9f, 1.4f}, white);  // a cabinet at the wall of the sealed room
  b.box({4.5f, 0, 0.3f}, {5.6f, 0.9f, 0.9f}, wood);
  b.box({9.0f, 0, 0.2f}, {10.8f, 0.45f, 1.1f}, cloth);
  b.box({9.0f, 0.45f, 0.2f}, {10.8f, 0.9f, 0.4f}, cloth);
  b.box({0.02f, 0, 6.6f}, {0.42f, 2.1f, 8.6f}, wood);  // shelves
  b.box({3.0f, 0, 7.4f}, {4.9f, 0.5f, 9.3f}, cloth);   // a bed
  b.box({6.6f, 0, 8.2f}, {7.4f, 1.0f, 8.9f}, white);   // a block with a probe in it
  b.box({9.4f, 0.7f, 6.8f}, {10.8f, 0.75f, 7.8f}, wood);
  b.box({10.0f, 0, 7.2f}, {10.2f, 0.7f, 7.4f}, wood);
}

void build_lamps(Builder& b) {
  b.lamp(1.9f, 1.9f, 1.2f, {12, 11, 10});
  b.lamp(10.0f, 2.0f, 1.0f, {2, 3, 6});
  b.lamp(2.4f, 7.5f, 1.2f, {1.6f, 1.4f, 1});
  b.lamp(6.8f, 7.4f, 1.2f, {8, 2, 1});
  b.lamp(10.3f, 7.5f, 1.2f, {0.4f, 0.5f, 0.8f});
  b.lamp(3.0f, 4.75f, 0.7f, {3, 3, 3});
  b.lamp(9.0f, 4.75f, 0.7f, {3, 3, 3});
}

void build_house(Builder& b) {
  const auto [width, height, depth, thickness, shell] = b.building();
  build_shell(b, Window{1.0f, 2.8f, 0.9f, 2.1f});
  const std::uint32_t wall = b.surface({0.7f, 0.68f, 0.65f}), wood = b.surface({0.5f, 0.35f, 0.2f}),
                      cloth = b.surface({0.5f, 0.2f, 0.2f});
  // The corridor's wall has a door to the room with the window.
  b.along_x(0, 0.6f, 3.6f, wall);
  b.along_x(0.6f, 1.5f, 3.6f, wall, door_height);
  b.along_x(1.5f, width, 3.6f, wall);
  b.along_z(4.5f, 0, 3.6f, wall);
  // The cupboard in a corner of the room with the lamp.
  b.along_x(4.5f, 6.02f, 2.64f, wall);
  b.along_z(5.96f, 2.64f, 3.6f, wall);
  b.box({2.0f, 0.7f, 1.6f}, {3.4f, 0.74f, 2.4f}, wood);  // top of a table
  b.box({2.6f, 0, 1.9f}, {2.8f, 0.7f, 2.1f}, wood);
  b.box({6.3f, 0, 0.1f}, {8.1f, 0.5f, 1.5f}, cloth);          // a bed
  b.box({4.0f, 0, 4.55f}, {5.6f, 1.0f, depth + into}, wood);  // a sideboard in the corridor
  b.lamp(6.4f, 1.4f, 0.8f, {12, 11, 9});
  b.lamp(6.0f, 4.28f, 0.5f, {2, 2.4f, 3});
}

// Fills `rooms` with the finished triangles. `light` is the map around the building.
void finish(Rooms& rooms, const Building& building, LitTriangles triangles, bake::Environment light) {
  rooms.soup = triangles.soup;
  rooms.origin_offset = bake::ray_origin_offset(triangles.soup.position);
  // The box extends slightly beyond the inner faces of the shell, so that it includes these faces.
  rooms.low_ws = {-0.01f, -0.01f, -0.01f};
  rooms.high_ws = {building.width + 0.01f, building.height + 0.01f, building.depth + 0.01f};
  rooms.lit = std::make_unique<bake::LitScene>(std::move(triangles), std::move(light));
}

}  // namespace

bool Rooms::in_solid(Vec3 position_ws) const {
  return std::ranges::any_of(solid, [&](const AxisBox& box) { return box.holds(position_ws); });
}

Rooms make_rooms() {
  const auto [width, height, depth, thickness, shell] = six_rooms;
  LitTriangles triangles;
  Rooms rooms;
  Builder builder(six_rooms, triangles, rooms.solid);
  build_shell(builder);
  build_partitions(builder);
  build_furniture(builder);
  build_lamps(builder);
  rooms.room = {{"bright", {{{0, 0, 0}, {3.9f, height, 3.9f}}}},
                {"sealed", {{{4.0f, 0, 0}, {8.0f, height, 3.9f}}}},
                {"blue", {{{8.1f, 0, 0}, {width, height, 3.9f}}}},
                {"corridor", {{{0, 0, 4.0f}, {width, height, 5.5f}}}},
                {"dim", {{{0, 0, 5.6f}, {4.95f, height, depth}}}},
                {"red", {{{5.05f, 0, 5.6f}, {8.5f, height, depth}}}},
                {"dimmest", {{{8.6f, 0, 5.6f}, {width, height, depth}}}}};
  rooms.sealed = 1;
  rooms.neighbour = 0;
  // The light outside is white, so that any leak of the shell is visible.
  finish(rooms, six_rooms, std::move(triangles), bake::Environment(8, 4, std::vector<float>(8 * 4 * 3, 1)));
  return rooms;
}

Rooms make_house() {
  const auto [width, height, depth, thickness, shell] = house;
  LitTriangles triangles;
  Rooms rooms;
  Builder builder(house, triangles, rooms.solid);
  build_house(builder);
  rooms.room = {
      {"window", {{{0, 0, 0}, {4.5f, height, 3.6f}}}},
      {"cupboard", {{{4.56f, 0, 2.7f}, {5.96f, height, 3.6f}}}},
      {"lamp", {{{4.56f, 0, 0}, {width, height, 2.64f}}, {{6.02f, 0, 2.64f}, {width, height, 3.6f}}}},
      {"corridor", {{{0, 0, 3.66f}, {width, height, depth}}}}};
  rooms.sealed = 1;
  rooms.neighbour = 2;
  // A blue sky above dark ground, without a sun.
  std::vector<float> texels;
  for (int i = 0; i < 8 * 4; ++i) {
    const Vec3 radiance = i < 8 * 2 ? Vec3{2, 2.6f, 3.4f} : Vec3{0.3f, 0.28f, 0.25f};
    texels.insert(texels.end(), {radiance.x, radiance.y, radiance.z});
  }
  finish(rooms, house, std::move(triangles), bake::Environment(8, 4, std::move(texels)));
  return rooms;
}

}  // namespace nook::lab
