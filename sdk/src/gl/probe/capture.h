// Makes probes on the GPU from cube maps that a host has rendered.
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
  std::uint32_t face_size_px = 0;  // size of a face at the mipmap level that is read
  std::uint32_t level = 0;
};

// Binds the cube map to the active unit. Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the texture is not a
// cube map, has another size, does not have this level, or has colours that are neither floats nor normalised
// integers. Sizes and formats are not checked on OpenGL ES 3.0 and WebGL, which have no queries for them.
void bind_checked(const Device& device, const CubeMap& cube);

// The shaders in shaders/probe/capture read and write a table of texels. It contains constants, sums over the
// rows of a cube map, and the average of each probe's sums.

// The layout of the table, in texels of four floats. First comes a texel with the luminance limit for suns.
// Second come axis and sharpness of the lobes, padded to whole groups. Third come the rows of the solution
// matrix, whose columns have the order of the sums. Fourth come the sums of one group over each row of a cube
// map. Last come the averaged sums of each probe: the groups of lobes, then one group of harmonics.
struct CapturePlan {
  std::uint32_t lobes = 0;  // number of lobes; 0: only harmonics
  std::uint32_t face_size_px = 0;
  std::uint64_t probes = 0;

  std::uint32_t lobe_groups() const { return (lobes + NOOK_CAPTURE_GROUP - 1) / NOOK_CAPTURE_GROUP; }
  std::uint32_t groups() const { return lobe_groups() + 1; }
  std::uint32_t rows() const { return 6 * face_size_px; }
  std::uint32_t sums() const { return groups() * NOOK_CAPTURE_GROUP; }  // sums of one probe
  std::uint32_t map_row() const { return sums() / 4; }                  // texels

  static constexpr std::uint64_t first_lobe = 1;
  std::uint64_t first_map_row() const { return first_lobe + lobe_groups() * NOOK_CAPTURE_GROUP; }
  std::uint64_t first_row() const { return first_map_row() + std::uint64_t{lobes} * map_row(); }
  std::uint64_t first_sum(std::uint64_t probe) const {
    return first_row() + std::uint64_t{rows()} * NOOK_CAPTURE_GROUP + probe * sums();
  }
  std::uint64_t texels() const { return first_sum(probes); }
};

// Returns the initial table, with constants and without light. If the plan has lobes, pass the basis that
// contains them.
Vector<float> capture_texels(const CapturePlan& plan, const probe::Basis& basis, probe::Constraint constraint,
                             Memory* memory);

// Converts cube maps that a host renders to probes, entirely on the GPU. Vertex shaders sum over texels and
// write the sums by transform feedback, which supports 32-bit floats on every OpenGL and OpenGL ES. A matrix
// product then solves the fit, and the result is copied to the textures that the host's shaders read. Nothing
// is read back.
//
// A map is processed by three kinds of draws. rows.vert processes one point for each row of a face and each
// group of functions. mean.vert processes one point for each sum, and also updates the running average over
// maps. solve.vert processes one point for each texel of the result.

// The textures that a capture writes. At most one of the pointers may be null. The textures must outlive the
// capture.
struct CaptureTargets {
  const ProbeTexture* lobes = nullptr;
  const GridVolume* grid = nullptr;

  const probe::Grid& places() const { return lobes ? lobes->grid() : grid->grid(); }
};

struct CaptureSettings {
  std::uint32_t face_size_px = 64;
  std::uint32_t level = 0;
  std::uint32_t history = 1;  // maps
  bool sky = false;           // if true, suns are excluded
  probe::Constraint constraint = probe::Constraint::bands;
};

// The light of a probe, averaged over the maps that were added.
struct CaptureResult {
  std::uint32_t maps = 0;
  std::array<Vec3, probe::band_functions> harmonics{};
  Vec3 sun_irradiance, sun_direction;
  float sun_solid_angle = 0;  // steradians
  float used_solid_angle = 0;
};

class ProbeCapture {
 public:
  // All functions change the state of the user `captures` in touched_state.h, and may throw Failure.
  ProbeCapture(Device& device, const CaptureTargets& targets, const CaptureSettings& settings);

  // Adds a cube map to a probe's average, and writes the new average to the probe in the targets. The probe
  // must exist. If `restart` is true, the average starts again with this map.
  void add(std::size_t probe, GLuint cube_map, bool restart);
  // read and solve wait for the GPU. If the capture has no lobes, the result of solve has harmonics. A probe
  // to which no map was added is black.
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
  const probe::Basis basis_;  // lobes, or harmonics of order 2 if there are no lobes
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
  Vector<std::uint32_t> maps_;  // maps in the average of each probe
};

}  // namespace nook::gl
