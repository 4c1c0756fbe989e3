// Reads measured BTFs in the file format of the University of Bonn's database of 2014 (UBO2014), signature
// "!DFMF08FC". Each channel of a decorrelated colour is a matrix of light and view pairs times texels. The
// file keeps it as a truncated singular value decomposition (decorrelated full matrix factorisation).
// Numbers are little-endian. The parts of the file are
//   signature  10 bytes "!DFMF08FCR", or 9 bytes without the R
//   head       u32 bytes of the head, including this number; u32 version; three texts of 80 bytes; f32 texels
//              per mm; three f32 scales of RGB, which are not applied; from version 2 on: u32, which is 1 if
//              the data include the cosine of the light; from version 3 on: u32 length, XML; from version 4
//              on: u32 number of channels, and for each u32 length and name
//   views      u32 count; for each view: f32 tilt and azimuth in radians, u32 number of lights, and f32 tilt
//              and azimuth of each light
//   texels     u32 width and height; with the R: u32 count of rotations, 9 f32 for each, not applied
//   colour     u32 largest number of components; i32 model; three f32 means; f32 matrix, 3 x 3, by rows
//   channels   for each: u8 bytes of a number (2, 4 or 8: IEEE floats); u32 components, rows and columns; the
//              singular values; U, rows x components; V times the singular values, columns x components
// There are two layouts. Either rows are pairs of light and view (light + lights * view) and columns are
// texels (x + width * y, with y from the top), or rows are texels and columns are pairs.
#pragma once

#include <cstdint>
#include <span>

#include "bakers/material/raw_material.h"

namespace nook::bake::material {

// If `texels` is above 0, reads only the square with this side in the middle. If the data do not include the
// cosine of the light, multiplies them by it. The result has no VOTF.
//
// Throws Failure(BAD_FILE) if the signature is unknown, the layout is invalid, there are not three channels,
// or a number is not finite. Also throws it if the BTF exceeds `most_bytes`, lights differ between views, or
// the colour model has no public definition. Throws Failure(INVALID_ARGUMENT) if `texels` exceeds the texels
// of the file.
RawMaterial read_btf_file(std::span<const std::byte> bytes, std::uint32_t texels,
                          std::size_t most_bytes = std::size_t{6} << 30);

}  // namespace nook::bake::material
