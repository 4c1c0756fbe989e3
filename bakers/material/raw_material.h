// Stores the uncompressed appearance of a material, which is traced or measured. It is the reference for
// compression. This header also declares directions, the file format, and the filling of texels that views
// pass through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// The last index is fastest. Texel (x, y) covers [x, x + 1] / width times [y, y + 1] / height of the tile.
struct RawMaterial {
  std::string name;
  std::vector<Vec3> lights, views;  // unit, tile space
  std::uint32_t width = 0, height = 0;
  // BTF: (3 light + channel) x view x width x height. The radiance (as in sdk's material/material.h) of the
  // surface that the view meets. Where a view passes through, fill_gaps() below sets the value.
  std::vector<float> btf;
  // VOTF: view x width x height, 1 where the view meets the meso-structure, 0 where it passes through; empty:
  // all 1.
  std::vector<float> mask;
  // Heights over the plane z = 0 in tiles, x * height + y; empty if not known.
  std::vector<float> heights;

  std::size_t texels() const { return std::size_t(width) * height; }
  std::size_t light_rows() const { return 3 * lights.size(); }
};

// Rounds the BTF to the half floats that files store.
void round_to_halves(RawMaterial& raw);

// Sets of light and view directions in tile space: x and y along the surface, z out of it. A direction has
// unit length and points away from the surface, to the light or to the viewer.

// Measured and simulated sets end at this tilt. At larger tilts, the footprint of a texel covers too much to
// show the structure.
inline constexpr float default_max_tilt_deg = 75;

// Returns `count` directions on a spiral from the normal down to max_tilt_deg, each with about the same solid
// angle. Throws Failure(INVALID_ARGUMENT) unless count >= 4 and 0 < max_tilt_deg < 90.
std::vector<Vec3> spiral_directions(std::uint32_t count, float max_tilt_deg = default_max_tilt_deg);

// Takes the tilt from the normal and the azimuth from x towards y, in degrees.
Vec3 direction_from_angles(float tilt_deg, float azimuth_deg);

// Stores raw materials in files, so that you can evaluate a compression later. The file is a .nook container
// of the kind "MRAW", version 2 (in version 1 the BTF was black where views pass through), with the sections
//   HEAD  u32 lights, views, width, height; u32, 1 if there is a VOTF; u32 length and bytes of the name
//   DIRS  f32 x, y, z of the lights, then of the views
//   BTF_  half floats, in the order of RawMaterial::btf
//   MASK  only with a VOTF: one bit per texel, low bits first

inline constexpr ContainerKind raw_kind{four_letters("MRAW"), "raw material", 2, 2};

std::vector<std::byte> write_raw_material(const RawMaterial& raw);

// Throws Failure(NOOK_ERROR_BAD_FILE). If a texel is not finite, the message names the texel.
RawMaterial read_raw_material(std::span<const std::byte> bytes);

// Throws Failure(NOOK_ERROR_BAD_FILE) if a texel is not finite. The message names the first such texel by
// light, channel, view, x and y. Also throws if a direction appears twice or is not a unit vector of the
// upper hemisphere, and names the first such direction.
void check_raw_material(const RawMaterial& raw);

// Sets colours for texels through which a view passes. If they were black, filtering, mipmaps and compression
// would mix the black into visible texels beside them. Silhouettes would then be darkened twice: by the
// black, and by their visibility.

// `coverage` is view x width x height: the share of a texel in which the view meets the structure, 0 to 1. On
// entry, the BTF must be this share times the colour of the structure. On return, it is the colour alone.
//
// Where the coverage is 0, values are not read but filled by the pull-push algorithm. They get the mean
// colour, weighted by coverage, of the smallest block of 2 x 2, 4 x 4, ... texels with any coverage,
// interpolated linearly between blocks. So means over larger areas, such as mipmaps, stay close to the
// visible colours. If a view meets nothing, it becomes black. The texture repeats. Any number of threads
// gives the same bits.
void fill_gaps(RawMaterial& raw, std::span<const float> coverage);

// Fills the gaps of one image in the order x * height + y.
void fill_image_gaps(std::span<float> image, std::span<const float> coverage, std::uint32_t width,
                     std::uint32_t height);

}  // namespace nook::bake::material
