#include "sdk/src/nnao/recording.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/filter.h"
#include "sdk/src/nnao/frame_radius.h"
#include "sdk/src/nnao/frame_ranges.h"
#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/projection_check.h"

namespace nook::nnao {
namespace {

void check_frame(const RecordedFrame& frame) {
  check_known("depth_kind", frame.depth_kind, std::int32_t(DepthKind::linear));
  check_known("clip", frame.clip, std::int32_t(ClipRange::zero_to_one));
  check_known("layer", frame.layer, last_recorded_layer);
  check_known("view", frame.view, last_recorded_view);
  check_known("radius_kind", frame.radius_kind, last_recorded_radius_kind);
  const bool share = frame.radius_kind != 0;
  check_fits("radius", frame.radius, frame.radius > 0 && (!share || frame.radius <= 1),
             share ? "a share of the screen, more than 0 up to 1" : "more than 0 metres");
  check_shape(frame, name_in_recording);
  check_fits("sky_depth", frame.sky_depth, frame.sky_depth >= 0, "0 or more metres");
  check_fits("normal_scale", frame.normal_scale, frame.normal_scale != 0, "a finite number other than 0");
  check_fits("normal_bias", frame.normal_bias, true, "a number");
  check_normal_matrix(frame.normal_matrix);
  check_projection(frame.projection, DepthKind(frame.depth_kind), ClipRange(frame.clip));
}

void check_pass(const RecordedPass& pass) {
  if (pass.taps < 0 || horizon_grid(std::uint32_t(pass.taps)).steps == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "taps is unknown (got %d, need 9, 16, 32, 64, 128 or 256)",
                  pass.taps);
  check_known("half_resolution", pass.half_resolution, 1);
  check_known("blur", pass.blur, 2);
  check_fits("blur_sharpness", pass.blur_sharpness, pass.blur_sharpness > 0, "more than 0");
  check_known("path", pass.path, last_recorded_path);
}

void check_image(const char* field, const Vector<float>& image, std::size_t count) {
  if (image.size() != count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s has the wrong size (got %zu numbers, need %zu)", field,
                  image.size(), count);
}

void check_text(const char* field, const String& text) {
  if (text.size() > max_recorded_text)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is too long (got %zu bytes, need at most %zu)", field,
                  text.size(), max_recorded_text);
  for (const char c : text)
    if (const auto code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7f)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "%s has a control character (got %u); use text without line breaks", field,
                    unsigned{code});
}

View view_of(const Recording& recording, std::span<const float> depths) {
  return {recording.width,
          recording.height,
          projection_rays(recording.frame.projection, recording.width, recording.height),
          depths,
          {}};
}

// Returns the host's normal of a pixel in view space, or a zero vector if the host has drawn nothing there.
// normal.glsl uses the same limits for the length of a normal.
Vec3 host_normal(const Recording& recording, std::size_t pixel) {
  const RecordedFrame& frame = recording.frame;
  const float* const texel = &recording.normals[3 * pixel];
  const float* const m = frame.normal_matrix;
  float n[3];
  for (int i = 0; i < 3; ++i) n[i] = texel[i] * frame.normal_scale + frame.normal_bias;
  const Vec3 turned{m[0] * n[0] + m[3] * n[1] + m[6] * n[2], m[1] * n[0] + m[4] * n[1] + m[7] * n[2],
                    m[2] * n[0] + m[5] * n[1] + m[8] * n[2]};
  const float size = length(turned);
  return size > shortest_float_normal && size < 1e6f ? turned * (1 / size) : Vec3{};
}

}  // namespace

void check_recording(const Recording& recording) {
  const std::uint32_t most = max_recorded_size_px;
  if (recording.width < 1 || recording.height < 1 || recording.width > most || recording.height > most)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "width and height are out of range (got %u x %u, need 1 x 1 to %u x %u)", recording.width,
                  recording.height, most, most);
  check_frame(recording.frame);
  check_pass(recording.pass);
  check_image("depth", recording.depth, recording.pixels());
  if (!recording.normals.empty()) check_image("normals", recording.normals, 3 * recording.pixels());
  if (recording.frame.layer != 0 || !recording.layer.empty())
    check_image("layer_texels", recording.layer, 2 * recording.pixels());
  if (!recording.ao.empty()) check_image("ao", recording.ao, recording.pixels());
  const auto bad =
      std::find_if(recording.ao.begin(), recording.ao.end(), [](float ao) { return !(ao >= 0 && ao <= 1); });
  if (bad != recording.ao.end())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "ao is out of range (got %g at pixel %zu, need 0 to 1)",
                  double(*bad), std::size_t(bad - recording.ao.begin()));
  check_text("vendor", recording.vendor);
  check_text("renderer", recording.renderer);
  check_text("driver_version", recording.driver_version);
  check_text("note", recording.note);
}

RecordedNetwork recorded_network(const Recording& recording) {
  RecordedNetwork network;
  const std::span<const std::byte> own = default_network_file();
  network.embedded = std::equal(recording.network.begin(), recording.network.end(), own.begin(), own.end());
  network.readable = network.embedded;
  if (network.embedded || recording.network.empty()) return network;
  try {
    read_network(recording.network);
    network.readable = true;
  } catch (const Failure&) {
  }
  return network;
}

std::vector<float> view_depths(const Recording& recording) {
  const DepthDecode decode = depth_decode(recording.depth_source());
  const bool perspective = is_perspective(recording.frame.projection);
  std::vector<float> depths;
  depths.reserve(recording.depth.size());
  for (std::size_t i = 0; i < recording.depth.size(); ++i) {
    const Pixel pixel{std::uint32_t(i % recording.width), std::uint32_t(i / recording.width)};
    depths.push_back(view_depth(decode, perspective, recording.depth[i], pixel));
  }
  return depths;
}

std::vector<Vec3> view_normals(const Recording& recording, std::span<const float> depths) {
  const View view = view_of(recording, depths);
  const bool in_pixels = recording.frame.radius_kind != 0;
  const FrameRadius radius = frame_radius(
      {RadiusKind(recording.frame.radius_kind), recording.frame.radius, 0, recording.frame.max_radius_px},
      float(recording.height));
  std::vector<Vec3> normals(recording.pixels(), Vec3{0, 0, 1});
  for (std::uint32_t y = 0; y < recording.height; ++y)
    for (std::uint32_t x = 0; x < recording.width; ++x) {
      const std::size_t pixel = view.at(x, y);
      if (!view.has_surface(x, y)) continue;
      const Vec3 given = recording.normals.empty() ? Vec3{} : host_normal(recording, pixel);
      const float metres = in_pixels ? radius.max_px / std::abs(pixel_scale(view.rays, depths[pixel]).y)
                                     : recording.frame.radius;
      const float tolerance = metres / recording.pass.blur_sharpness;
      normals[pixel] =
          dot(given, given) > 0 ? given : rebuilt_normal(view, x, y, neighbours_of(view, x, y, tolerance));
    }
  return normals;
}

}  // namespace nook::nnao
