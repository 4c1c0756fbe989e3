#include <algorithm>
#include <cmath>

#include "bakers/tool/inspect/describe.h"
#include "sdk/src/core/hash.h"
#include "sdk/src/nnao/exact_packing.h"
#include "sdk/src/nnao/layers.h"
#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/recording_file.h"

namespace nook::tool {
namespace {

using nook::nnao::Recording;

std::string version_text(std::uint32_t version) {
  return std::to_string(version >> 22) + "." + std::to_string(version >> 12 & 1023) + "." +
         std::to_string(version & 4095);
}

std::string packing_name(const Vector<float>& image) {
  if (image.empty()) return "none";
  const nnao::ExactPacking packing = nnao::exact_packing(image);
  if (packing == nnao::packed_as_floats) return "float";
  if (packing == nnao::packed_as_halves) return "half float";
  return std::to_string(packing.bits) + " bits";
}

// Adds the depths of the near and the far plane. A depth is null if it is unknown or infinite.
void add_planes(Row& row, const Recording& recording) {
  row["near"] = row["far"] = nullptr;
  row["reversed"] = nullptr;
  if (recording.frame.depth_kind != int(nnao::DepthKind::hardware)) return;
  const nnao::DepthDecode decode = nnao::depth_decode(recording.depth_source());
  row["reversed"] = decode.far_sign < 0;
  if (decode.slope_x != 0 || decode.slope_y != 0) return;  // an oblique plane has no single depth
  for (const char* plane : {"near", "far"}) {
    const double stored = (plane[0] == 'f') == (decode.far_stored > 0.5f) ? 1 : 0;
    const double depth = (decode.x + decode.y * stored) / (decode.z + decode.w * stored);
    if (std::abs(depth) < 1e9) row[plane] = depth;
  }
}

void add_depths(Row& row, const Recording& recording) {
  std::vector<float> depths = nnao::view_depths(recording);
  const std::size_t pixels = depths.size();
  std::erase_if(depths, [](float depth) { return !std::isfinite(depth); });
  row["sky_share"] = 1 - double(depths.size()) / double(pixels);
  row["nearest"] = depths.empty() ? Row() : Row(*std::ranges::min_element(depths));
  row["farthest"] = depths.empty() ? Row() : Row(*std::ranges::max_element(depths));
}

void add_network(Row& row, const Recording& recording) {
  const nnao::RecordedNetwork network = nnao::recorded_network(recording);
  row["network"] = recording.network.empty() ? "none"
                   : network.embedded        ? "the embedded one of this version"
                   : network.readable        ? "another one"
                                             : "one that this version does not evaluate";
  row["network_revision"] = nullptr;
  row["network_hash"] = nullptr;
  if (recording.network.empty()) return;
  Hash64 hash;
  hash.add(recording.network);
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  row["network_hash"] = text;
  if (network.readable)
    row["network_revision"] = nnao::network_form(recording.network) == nnao::NetworkForm::horizon
                                  ? Row(int(nnao::HorizonNetwork::revision))
                                  : Row("paper's form");
}

double mean_of(const Vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return sum / double(values.size());
}

}  // namespace

Row describe_recording(std::span<const std::byte> bytes) {
  const Recording recording = nnao::read_recording(bytes);
  const nnao::RecordedFrame& frame = recording.frame;
  const nnao::RecordedPass& pass = recording.pass;
  Row row;
  row["kind"] = "recorded frame of the screen-space pass";
  row["format_version"] = Container(bytes, nnao::recording_kind).version();
  row["bytes"] = bytes.size();
  row["library_version"] = version_text(recording.library_version);
  row["note"] = std::string(recording.note);
  row["vendor"] = std::string(recording.vendor);
  row["renderer"] = std::string(recording.renderer);
  row["driver_version"] = std::string(recording.driver_version);
  row["width"] = recording.width;
  row["height"] = recording.height;
  row["depth_kind"] = frame.depth_kind == 0 ? "hardware" : "linear";
  row["clip"] = frame.clip == 0 ? "-1 to 1" : "0 to 1";
  row["perspective"] = nnao::is_perspective(frame.projection);
  add_planes(row, recording);
  row["sky_depth"] = frame.sky_depth;
  add_depths(row, recording);
  row["projection"] = std::vector<float>(frame.projection, frame.projection + 16);
  row["normal_scale"] = frame.normal_scale;
  row["normal_bias"] = frame.normal_bias;
  row["normal_matrix"] = std::vector<float>(frame.normal_matrix, frame.normal_matrix + 9);
  row["depth_packing"] = packing_name(recording.depth);
  row["normals_packing"] = packing_name(recording.normals);
  row["layer_packing"] = packing_name(recording.layer);
  row["ao_packing"] = packing_name(recording.ao);
  row["ao_mean"] = recording.ao.empty() ? Row() : Row(mean_of(recording.ao));
  row["radius"] = frame.radius;
  row["radius_kind"] = frame.radius_kind == 0 ? "metres" : "share of the height";
  row["max_radius_px"] = frame.max_radius_px;
  row["min_radius_px"] = frame.min_radius_px;
  row["fade_begin"] = frame.fade_begin;
  row["fade_end"] = frame.fade_end;
  row["intensity"] = frame.intensity;
  row["power"] = frame.power;
  constexpr const char* layers[] = {"none", "minimum", "remainder", "replace", "apart"};
  constexpr const char* views[] = {"result", "raw", "blurred"};
  constexpr const char* paths[] = {"unknown", "fragment", "compute"};
  static_assert(std::size(layers) == nnao::last_recorded_layer + 1);
  static_assert(std::size(views) == nnao::last_recorded_view + 1);
  static_assert(std::size(paths) == nnao::last_recorded_path + 1);
  row["layer"] = text_of(layers, std::size_t(frame.layer));
  row["view"] = text_of(views, std::size_t(frame.view));
  row["taps"] = pass.taps;
  row["half_resolution"] = pass.half_resolution != 0;
  row["blur"] = pass.blur;
  row["blur_sharpness"] = pass.blur_sharpness;
  row["path"] = text_of(paths, std::size_t(pass.path));
  add_network(row, recording);
  return row;
}

Row describe_network(std::span<const std::byte> bytes) {
  const nnao::Network network = nnao::read_network(bytes);
  Row row;
  row["kind"] = "screen-space network";
  row["format_version"] = Container(bytes, nnao::network_kind).version();
  row["bytes"] = bytes.size();
  std::size_t parameters = network.paper.filters.size();
  nnao::visit_layers(network, [&](std::span<const float> values) { parameters += values.size(); });
  row["parameters"] = parameters;
  add_recipe(row, network.recipe);
  return row;
}

}  // namespace nook::tool
