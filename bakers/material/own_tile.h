// A mesh of one's own as a meso-structure.
#pragma once

#include "bakers/import/static_scene.h"
#include "bakers/material/meso_surface.h"

namespace nook::bake::material {

// Takes the triangles of a scene, y up, as one tile of a structure that repeats after side_m metres along x
// and z: x becomes the tile's x, -z its y, and y its height, with the middle of the scene's heights at z = 0.
// Normals are averages over faces that share a vertex, also across the border of the tile; the front side of
// a triangle is outside of the solid. Diffuse colours are the base colours of the materials, and there is no
// specular part. Throws Failure(INVALID_ARGUMENT) if the scene is flat, higher than half a tile or wider than
// two, or the side is not above 0.
MesoSurface tile_of_scene(const StaticScene& scene, float side_m);

}  // namespace nook::bake::material
