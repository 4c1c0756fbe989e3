// The table of texels that the shaders of captures work in: constants, sums over the rows of a cube map, and
// the average of each probe's sums. shaders/probe/capture has its readers.
#pragma once

#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/probe/fit.h"
#include "shaders/probe/capture/layout.h"

namespace nook::gl {

// Texels of four floats, from the first: the luminance where suns begin; axis and sharpness of the lobes in
// whole groups; the rows of the solution map, whose columns lie as the sums do; sums of one group over all
// rows; then the sums of each probe, groups of lobes and one of harmonics.
struct CapturePlan {
  std::uint32_t lobes = 0;  // 0: harmonics alone
  std::uint32_t face_size_px = 0;
  std::uint64_t probes = 0;

  std::uint32_t lobe_groups() const { return (lobes + NOOK_CAPTURE_GROUP - 1) / NOOK_CAPTURE_GROUP; }
  std::uint32_t groups() const { return lobe_groups() + 1; }
  std::uint32_t rows() const { return 6 * face_size_px; }
  std::uint32_t sums() const { return groups() * NOOK_CAPTURE_GROUP; }  // of a probe
  std::uint32_t map_row() const { return sums() / 4; }                  // texels

  static constexpr std::uint64_t first_lobe = 1;
  std::uint64_t first_map_row() const { return first_lobe + lobe_groups() * NOOK_CAPTURE_GROUP; }
  std::uint64_t first_row() const { return first_map_row() + std::uint64_t{lobes} * map_row(); }
  std::uint64_t first_sum(std::uint64_t probe) const {
    return first_row() + std::uint64_t{rows()} * NOOK_CAPTURE_GROUP + probe * sums();
  }
  std::uint64_t texels() const { return first_sum(probes); }
};

// The table before the first map: constants, and no light. A plan with lobes is that of the basis.
Vector<float> capture_texels(const CapturePlan& plan, const probe::Basis& basis, probe::Constraint constraint,
                             Memory* memory);

}  // namespace nook::gl
