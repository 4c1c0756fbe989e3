// The geometry of a meso-structure: one tile of a surface that repeats without end along x and y.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/import/static_scene.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// A surface that is closed, at least together with the copies of the tile. Normals point out of the solid.
// Lengths are in tiles, so the pattern repeats after 1 along x and y. Triangles may reach beyond the tile.
// Together with their copies, they cover the plane once.
struct MesoSurface {
  std::vector<Vec3> position;
  std::vector<Vec3> normal;  // unit, for shading
  std::vector<Vec3> albedo;  // linear RGB of the diffuse part
  std::vector<std::array<std::uint32_t, 3>> triangle;
  float specular = 0;   // reflectance at normal incidence of a Blinn-Phong lobe on top of the diffuse part;
                        // 0: none
  float shininess = 1;  // exponent of the Blinn-Phong lobe
  // If not empty, these two arrays replace Blinn-Phong. Each vertex has a GGX width and a reflectance at
  // normal incidence in linear RGB, as in pbr_maps.h. Set both arrays or neither.
  std::vector<float> ggx_width;
  std::vector<Vec3> reflectance;
};

// The parameters of the built-in structures. The defaults of each are in `meso_parameters`, and
// docs/materials.md lists them.
struct MesoParameters {
  std::string name;         // "fiber", "roughhole" or "weave"
  std::uint32_t count = 1;  // fibres; holes along a side; yarns along a side
  float radius = 0.02f;     // fiber: of a fibre; roughhole: of a hole; weave: half the width of a yarn
  float thickness =
      0.1f;  // fiber: height over which fibres are spread; roughhole: of the plate; weave: of a yarn
  float roughness =
      0;             // fiber: wander of a fibre; roughhole: amplitude of the noise; weave: depth of the plies
  float detail = 1;  // factor of the default numbers of segments and grid cells
  std::uint64_t seed = 1;
};

std::vector<std::string_view> meso_names();

// Returns the defaults of a structure. Throws Failure(INVALID_ARGUMENT) that lists all names if this name is
// unknown.
MesoParameters meso_parameters(std::string_view name);

// Throws Failure(INVALID_ARGUMENT) if the structure cannot be built from the parameters.
MesoSurface make_meso_surface(const MesoParameters& parameters);

MesoSurface make_fiber(const MesoParameters& parameters);
MesoSurface make_rough_hole(const MesoParameters& parameters);
MesoSurface make_weave(const MesoParameters& parameters);

// Makes a meso-structure from a user's mesh.

// Takes the triangles of a scene, y up, as one tile of a structure that repeats after side_m metres along x
// and z. The scene's x becomes the tile's x, -z becomes y, and y becomes the height. The middle of the
// scene's heights is at z = 0. Normals are averaged over faces that share a vertex, also across the border of
// the tile. The front side of a triangle faces out of the solid. Diffuse colours are the base colours of the
// materials. There is no specular part. Throws Failure(INVALID_ARGUMENT) if the scene is flat, higher than
// half a tile or wider than two, or the side is not above 0.
MesoSurface tile_of_scene(const StaticScene& scene, float side_m);

}  // namespace nook::bake::material
