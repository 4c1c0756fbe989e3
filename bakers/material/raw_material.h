// Uncompressed appearance of a material: what is traced or measured, what compression is judged by. Its
// directions, its file and the texels that views pass through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Uncompressed appearance of a material: what is traced or measured, what compression is judged by.

// Last index fastest. Texel (x, y) covers [x, x + 1] / width times [y, y + 1] / height of the tile.
struct RawMaterial {
  std::string name;
  std::vector<Vec3> lights, views;  // unit, tile space
  std::uint32_t width = 0, height = 0;
  // BTF: (3 light + channel) x view x width x height, radiance as in sdk's material/material.h, of what the
  // view meets; where it passes through, as fill_gaps() below has it.
  std::vector<float> btf;
  // VOTF: view x width x height, 1 where the view meets the meso-structure, 0 where it passes through; empty:
  // all 1.
  std::vector<float> mask;
  // Heights over the plane z = 0 in tiles, x * height + y; empty: not known.
  std::vector<float> heights;

  std::size_t texels() const { return std::size_t(width) * height; }
  std::size_t light_rows() const { return 3 * lights.size(); }
};

// Rounds the BTF to half floats, in which files hold it.
void round_to_halves(RawMaterial& raw);

// Sets of light and view directions. Tile space: x and y along the surface, z out of it; a direction points
// away from the surface, to the light or to the viewer, and has unit length.

// Measured and simulated sets end here: beyond it a texel's footprint says little of the structure.
inline constexpr float default_max_tilt_deg = 75;

// `count` directions on a spiral from the normal down to max_tilt_deg, each of about the same solid angle.
// Throws Failure(INVALID_ARGUMENT) unless count >= 4 and 0 < max_tilt_deg < 90.
std::vector<Vec3> spiral_directions(std::uint32_t count, float max_tilt_deg = default_max_tilt_deg);

// From tilt (against the normal) and azimuth (from x towards y), degrees.
Vec3 direction_from_angles(float tilt_deg, float azimuth_deg);

// Raw materials as files, so that what was compressed can be judged later. A .nook container of the kind
// "MRAW", version 2 (in version 1 the BTF was black where views pass through), with the sections
//   HEAD  u32 lights, views, width, height; u32 1 with a VOTF; u32 length and bytes of the name
//   DIRS  f32 x, y, z of the lights, then of the views
//   BTF_  half floats, in the order of RawMaterial::btf
//   MASK  with a VOTF one bit a texel, low bits first

inline constexpr ContainerKind raw_kind{four_letters("MRAW"), "raw material", 2, 2};

std::vector<std::byte> write_raw_material(const RawMaterial& raw);

// Throws Failure(NOOK_ERROR_BAD_FILE); a texel that is not finite is named.
RawMaterial read_raw_material(std::span<const std::byte> bytes);

// Throws Failure(NOOK_ERROR_BAD_FILE) that names the first texel that is not finite by light, channel, view,
// x and y, or the first direction that is no unit vector of the upper hemisphere or is there twice.
void check_raw_material(const RawMaterial& raw);

// Colours for texels through which a view passes. Were they black, filtering, mipmaps and compression would
// mix the black into what is visible beside them, and silhouettes would be darkened twice: by that, and by
// their visibility.

// coverage: view x width x height, the share of a texel that the view meets, 0 to 1. On entry the BTF is that
// share times the colour of what is met; on return the colour alone. Where the coverage is 0, values are not
// read, but filled from around by pull and push: the mean colour, weighted by coverage, of the smallest block
// of 2 x 2, 4 x 4, ... texels that holds any, linear between blocks. Means over larger areas, which mipmaps
// are, so stay near those of what is visible. A view that meets nothing becomes black. The texture repeats.
// The same bits on any number of threads.
void fill_gaps(RawMaterial& raw, std::span<const float> coverage);

// The same for one image, x * height + y.
void fill_image_gaps(std::span<float> image, std::span<const float> coverage, std::uint32_t width,
                     std::uint32_t height);

}  // namespace nook::bake::material
