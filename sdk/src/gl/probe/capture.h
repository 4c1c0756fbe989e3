// Probes from cube maps that a host has rendered, on the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/device.h"
#include "sdk/src/gl/object.h"
#include "sdk/src/gl/probe/grid_volume.h"
#include "sdk/src/gl/probe/probe_texture.h"
#include "sdk/src/probe/fit.h"
#include "shaders/probe/capture/layout.h"

namespace nook::gl {

struct CubeMap {
  GLuint name = 0;
  std::uint32_t face_size_px = 0;  // at the level
  std::uint32_t level = 0;
};

// Binds the cube map to the active unit. Throws Failure(NOOK_ERROR_INVALID_ARGUMENT): it is no cube map, or
// has another size, levels that lack this one, or colours that are neither floats nor normalised. OpenGL ES
// 3.0 and WebGL tell neither sizes nor formats.
void bind_checked(const Device& device, const CubeMap& cube);

// The table of texels that the shaders of captures work in: constants, sums over the rows of a cube map, and
// the average of each probe's sums. shaders/probe/capture has its readers.

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

// Cube maps that a host renders become probes on the GPU: sums over texels by transform feedback, which every
// OpenGL and OpenGL ES has in 32 bits, then the solution of the fit as a matrix, then copies to the textures
// that shaders read. Nothing is read back.
//
// A map is summed in three kinds of draws: a point for each row of a face and group of functions
// (rows.vert), a point for each sum (mean.vert), which also takes the running average over maps, and a point
// for each texel of the result (solve.vert).

// The textures that a capture writes; one of both may be null, and neither dies before the capture.
struct CaptureTargets {
  const ProbeTexture* lobes = nullptr;
  const GridVolume* grid = nullptr;

  const probe::Grid& places() const { return lobes ? lobes->grid() : grid->grid(); }
};

struct CaptureSettings {
  std::uint32_t face_size_px = 64;
  std::uint32_t level = 0;
  std::uint32_t history = 1;  // maps
  bool sky = false;           // suns stay out
  probe::Constraint constraint = probe::Constraint::bands;
};

// The light of a probe, as means over its maps.
struct CaptureResult {
  std::uint32_t maps = 0;
  std::array<Vec3, probe::band_functions> harmonics{};
  Vec3 sun_irradiance, sun_direction;
  float sun_solid_angle = 0;  // steradians
  float used_solid_angle = 0;
};

class ProbeCapture {
 public:
  // The functions change the state of the user `captures` in touched_state.h. All throw Failure.
  ProbeCapture(Device& device, const CaptureTargets& targets, const CaptureSettings& settings);

  // Replaces what the targets hold of a probe, which exists, by its average over maps with this one. With
  // restart, this map is the first one of the average.
  void add(std::size_t probe, GLuint cube_map, bool restart);
  // Both wait for the GPU. Without lobes the probes are of harmonics. Probes without a map are 0.
  CaptureResult read(std::size_t probe) const;
  probe::Probes read_all() const;

  std::size_t size() const { return maps_.size(); }
  std::uint64_t bytes() const { return table_.bytes() + rows_.bytes() + sums_.bytes() + numbers_.bytes(); }

 private:
  struct RowProgram {
    Object object;
    GLint first_lobe = -1, limited = -1;
  };
  struct Draw {
    const Object& program;
    const Buffer& out;
    std::uint64_t first_texel, texels;  // of out
    std::uint32_t points;
  };
  RowProgram make_row_program(int kind) const;
  Object make_solve_program(int form) const;
  void check_targets() const;
  void use(const Object& program) const;
  void draw(const Draw& draw) const;
  void find_limit() const;
  void sum_rows(const RowProgram& program, std::uint32_t group, std::uint32_t entries) const;
  void average(std::size_t probe, std::uint32_t group) const;
  void solve(std::size_t probe) const;

  Device& device_;
  const CaptureTargets targets_;
  const CaptureSettings settings_;
  const probe::Basis basis_;  // of the lobes, else harmonics of order 2
  const probe::Grid grid_;
  const CapturePlan plan_;
  FeedbackTarget feedback_;
  Object vertex_array_;
  Object sampler_;
  RowProgram lobe_rows_, band_rows_, luminance_rows_;
  Object mean_, amplitudes_, texels_;
  GLint mean_rows_ = -1, mean_scale_share_ = -1;
  TexelTable table_;
  Buffer rows_, sums_, numbers_;
  Vector<std::uint32_t> maps_;  // of each probe
};

}  // namespace nook::gl
