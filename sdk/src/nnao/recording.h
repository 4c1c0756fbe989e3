// A recorded frame of the screen-space pass as plain data: the pass's inputs, its settings, and the AO that
// it produced. Members have the same meanings and values as in nook_nnao_frame_desc and nook_nnao_desc.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/nnao/host_depth.h"
#include "sdk/src/nnao/taps.h"

namespace nook::nnao {

// The highest values of nook_gbuffer_ao, nook_nnao_view and the other enumerations that a recording can have.
// The lowest value is 0.
inline constexpr std::int32_t last_recorded_layer = 4, last_recorded_view = 2, last_recorded_path = 2,
                              last_recorded_radius_kind = 1;
inline constexpr std::uint32_t max_recorded_size_px = 16384;
inline constexpr std::size_t max_recorded_text = 1000;  // bytes

struct RecordedFrame {
  std::int32_t depth_kind = 0, clip = 0;
  float sky_depth = 0;  // metres
  float normal_scale = 1, normal_bias = 0;
  float normal_matrix[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  float projection[16] = {};
  float radius = 0;         // metres, or a share of the height
  float max_radius_px = 0;  // 0: a quarter of the height
  float intensity = 1, power = 1;
  std::int32_t layer = 0, view = 0;
  std::int32_t radius_kind = 0;        // 0: metres; 1: a share of the height
  float min_radius_px = 0;             // 0: none
  float fade_begin = 0, fade_end = 0;  // metres; 0: no fade
};

// Copies the settings of a frame between this structure and the structure of the C interface, which has the
// same members.
template <class From, class To>
void copy_frame_settings(const From& from, To& to) {
  to.depth_kind = from.depth_kind;
  to.clip = from.clip;
  to.sky_depth = from.sky_depth;
  to.normal_scale = from.normal_scale;
  to.normal_bias = from.normal_bias;
  std::copy(std::begin(from.normal_matrix), std::end(from.normal_matrix), to.normal_matrix);
  std::copy(std::begin(from.projection), std::end(from.projection), to.projection);
  to.radius = from.radius;
  to.max_radius_px = from.max_radius_px;
  to.intensity = from.intensity;
  to.power = from.power;
  to.layer = from.layer;
  to.view = from.view;
  to.radius_kind = from.radius_kind;
  to.min_radius_px = from.min_radius_px;
  to.fade_begin = from.fade_begin;
  to.fade_end = from.fade_end;
}

struct RecordedPass {
  std::int32_t taps = default_taps;
  std::int32_t half_resolution = 0, blur = 1;
  float blur_sharpness = 16;
  std::int32_t path = 0;  // 0: unknown
};

// Images are stored row by row, starting at the bottom.
struct Recording {
  explicit Recording(Memory* memory = default_memory())
      : depth(memory),
        normals(memory),
        layer(memory),
        ao(memory),
        network(memory),
        vendor(memory),
        renderer(memory),
        driver_version(memory),
        note(memory) {}

  std::size_t pixels() const { return std::size_t(width) * height; }
  DepthSource depth_source() const {
    DepthSource source{frame.projection, DepthKind(frame.depth_kind), ClipRange(frame.clip), frame.sky_depth};
    source.width = width;
    source.height = height;
    return source;
  }

  std::uint32_t width = 0, height = 0;
  std::uint32_t library_version = 0;  // version of the library that computed `ao`
  RecordedFrame frame;
  RecordedPass pass;
  // Texel values as a shader reads them. An array is empty if the frame did not have this image.
  Vector<float> depth;        // 1 value per pixel
  Vector<float> normals;      // 3
  Vector<float> layer;        // 2
  Vector<float> ao;           // 1
  Vector<std::byte> network;  // the file of the network
  String vendor, renderer, driver_version, note;
};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if a value is invalid. The message names the field. Depth,
// normals and layer may contain any values, including NaN, because a host may want to record exactly such a
// faulty frame.
void check_recording(const Recording& recording);

// Information about the network file in a recording.
struct RecordedNetwork {
  bool readable = false;  // true if this library can evaluate the network
  bool embedded = false;  // true if it is the network that is compiled into this library
};
RecordedNetwork recorded_network(const Recording& recording);

// Returns the view depths of a recording in metres. The depth of a pixel without a surface is infinite.
std::vector<float> view_depths(const Recording& recording);

// Returns the normals that the network uses at full resolution, in view space. Where the host has no normal,
// the normal is derived from depth. Where there is no surface, the normal is {0, 0, 1}.
std::vector<Vec3> view_normals(const Recording& recording, std::span<const float> depths);

}  // namespace nook::nnao
