// Makes a building of closed rooms with different light. Its walls are 0.1 metres thick, so that grids of
// probes leak light through them.
#pragma once

#include <memory>
#include <vector>

#include "bakers/raytrace/lit_scene.h"

namespace nook::lab {

struct AxisBox {
  Vec3 low_ws, high_ws;  // metres
  bool holds(Vec3 p) const {
    return p.x >= low_ws.x && p.x <= high_ws.x && p.y >= low_ws.y && p.y <= high_ws.y && p.z >= low_ws.z &&
           p.z <= high_ws.z;
  }
};

struct Room {
  const char* name;
  AxisBox air;  // the space between the room's walls
};

// Six rooms of 3.4 to 5 metres along a corridor. The lamps have different colours, and the brightest lamp is
// 30 times as bright as the dimmest. Two rooms have an open door to the corridor. Three rooms are closed and
// lit. One room is sealed and does not have a lamp.
struct Rooms {
  bake::TriangleSoup soup;
  float origin_offset = 0;  // rays that leave a surface start this far from it along the normal, metres
  Vec3 low_ws, high_ws;     // box of a probe grid, metres
  std::unique_ptr<bake::LitScene> lit;
  std::vector<Room> room;
  std::vector<AxisBox> solid;
  bool in_solid(Vec3 position_ws) const;  // use it to skip faces that lie inside another solid
  std::size_t sealed = 0;                 // index of the sealed room
  std::size_t neighbour = 0;              // index of the bright room behind the sealed room's wall
};
Rooms make_rooms();

}  // namespace nook::lab
