// Distant light as the mean radiance of the cells of a cube around the origin, from which lobes are fitted in
// any rotation.
#pragma once

#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/light_map.h"
#include "sdk/src/core/vec.h"

namespace nook::transfer {

// The cells of a cube of side x side cells a face, the faces +x, -x, +y, -y, +z, -z. Cells are squares of a
// face; their solid angles differ by up to a factor of 5.
struct CubeCells {
  explicit CubeCells(std::uint32_t side, Memory* memory = default_memory());

  std::uint32_t side;
  Vector<Vec3> direction;     // unit, through the centre of each cell
  Vector<float> solid_angle;  // steradians; their sum is 4 pi

  std::size_t size() const { return direction.size(); }
};

// Returns the mean radiance of each cell: that of the texels in it, or of the nearest texel where a map has
// fewer texels than there are cells.
Vector<Vec3> cell_means(const MapView& map, const CubeCells& cells, Memory* memory);

}  // namespace nook::transfer
