// Makes two buildings of closed rooms with different light. Their walls are thin, so that grids of probes
// leak light through them.
#pragma once

#include <algorithm>
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
  std::vector<AxisBox> air;  // the space between the room's walls
  bool holds(Vec3 position_ws) const {
    return std::ranges::any_of(air, [&](const AxisBox& box) { return box.holds(position_ws); });
  }
};

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

// Makes six rooms of 3.4 to 5 metres along a corridor, with walls of 0.1 metres. The lamps have different
// colours, and the brightest lamp is 30 times as bright as the dimmest. Two rooms have an open door to the
// corridor. Three rooms are closed and lit. One room is sealed and does not have a lamp.
Rooms make_rooms();

// Makes a house of two rooms and a corridor, with walls of 0.06 metres. One room has a window and an open
// door to the corridor. The other room is closed and has the brightest lamp. A sealed cupboard of 1.4 x 0.9
// metres lies between both rooms and the corridor. Nook's fit of walls was not tuned on this house.
Rooms make_house();

}  // namespace nook::lab
