// Makes a building of closed rooms with different light and walls of 0.1 metres, where grids of probes leak.
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
  AxisBox air;  // between its walls
};

// Six rooms of 3.4 to 5 metres along a corridor. Lamps have different colours, and the brightest has 30 times
// the light of the dimmest. Two rooms have an open door to the corridor, three are closed and lit, and one is
// sealed without a lamp.
struct Rooms {
  bake::TriangleSoup soup;
  float origin_offset = 0;  // metres along the normal, for rays that leave a surface
  Vec3 low_ws, high_ws;     // metres, the box of a grid
  std::unique_ptr<bake::LitScene> lit;
  std::vector<Room> room;
  std::vector<AxisBox> solid;
  bool in_solid(Vec3 position_ws) const;  // where solids meet, faces of one lie in another
  std::size_t sealed = 0;                 // index of a room
  std::size_t neighbour = 0;              // the bright room behind the sealed room's wall
};
Rooms make_rooms();

}  // namespace nook::lab
