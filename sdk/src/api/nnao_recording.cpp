#include <nook/experimental/nook_recording.h>

#include <algorithm>
#include <cstring>
#include <iterator>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/nnao_recording_handle.h"
#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/recording_file.h"

using namespace nook;
using nnao::Recording;

namespace {

void copy_image(Vector<float>& image, const float* given, std::size_t count) {
  if (given) image.assign(given, given + count);
}

void copy_text(String& text, const char* given, const char* field) {
  if (!given) return;
  const void* const end = std::memchr(given, 0, nnao::max_recorded_text + 1);
  if (!end)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.%s is too long (need at most %zu bytes)", field,
                  nnao::max_recorded_text);
  text.assign(given, static_cast<const char*>(end));
}

void copy_network(Vector<std::byte>& network, const nook_nnao_recording_desc& desc) {
  if (!desc.network && desc.network_size != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.network is NULL, but desc.network_size is %zu; pass the bytes of the network, or set "
                  "the size to 0 for the embedded network",
                  desc.network_size);
  std::span<const std::byte> bytes = nnao::default_network_file();
  if (desc.network) {
    bytes = {static_cast<const std::byte*>(desc.network), desc.network_size};
    Container(bytes, nnao::network_kind);
  }
  network.assign(bytes.begin(), bytes.end());
}

Recording recording_of(const nook_nnao_recording_desc& desc, Memory* memory) {
  need(desc.depth, "desc.depth");
  Recording recording(memory);
  const auto most = std::int32_t(nnao::max_recorded_size_px);
  if (desc.width < 1 || desc.height < 1 || desc.width > most || desc.height > most)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.width and desc.height are out of range (got %d x %d, need 1 x 1 to %d x %d)",
                  desc.width, desc.height, most, most);
  recording.width = std::uint32_t(desc.width);
  recording.height = std::uint32_t(desc.height);
  recording.library_version = desc.library_version ? desc.library_version : std::uint32_t{NOOK_VERSION};
  nnao::copy_frame_settings(desc, recording.frame);
  recording.pass = {desc.taps, desc.half_resolution, desc.blur, desc.blur_sharpness, desc.path};
  copy_image(recording.depth, desc.depth, recording.pixels());
  copy_image(recording.normals, desc.normals, 3 * recording.pixels());
  copy_image(recording.layer, desc.layer_texels, 2 * recording.pixels());
  copy_image(recording.ao, desc.ao, recording.pixels());
  copy_network(recording.network, desc);
  copy_text(recording.vendor, desc.vendor, "vendor");
  copy_text(recording.renderer, desc.renderer, "renderer");
  copy_text(recording.driver_version, desc.driver_version, "driver_version");
  copy_text(recording.note, desc.note, "note");
  nnao::check_recording(recording);
  return recording;
}

const float* image_of(const Vector<float>& image) {
  return image.empty() ? nullptr : image.data();
}

nook_nnao_recording_desc desc_of(const Recording& recording) {
  nook_nnao_recording_desc desc = default_desc<nook_nnao_recording_desc>();
  desc.type = NOOK_DESC_NNAO_RECORDING;
  const nnao::RecordedPass& pass = recording.pass;
  desc.width = std::int32_t(recording.width);
  desc.height = std::int32_t(recording.height);
  desc.library_version = recording.library_version;
  nnao::copy_frame_settings(recording.frame, desc);
  desc.taps = pass.taps;
  desc.half_resolution = pass.half_resolution;
  desc.blur = pass.blur;
  desc.blur_sharpness = pass.blur_sharpness;
  desc.path = pass.path;
  desc.depth = image_of(recording.depth);
  desc.normals = image_of(recording.normals);
  desc.layer_texels = image_of(recording.layer);
  desc.ao = image_of(recording.ao);
  desc.network = recording.network.empty() ? nullptr : recording.network.data();
  desc.network_size = recording.network.size();
  desc.vendor = recording.vendor.c_str();
  desc.renderer = recording.renderer.c_str();
  desc.driver_version = recording.driver_version.c_str();
  desc.note = recording.note.c_str();
  return desc;
}

}  // namespace

nook_result nook_nnao_recording_create(nook_context context, const nook_nnao_recording_desc* desc,
                                       nook_nnao_recording* out) {
  return api::enter("nook_nnao_recording_create", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    const nook_nnao_recording_desc known = read_descriptor(desc);
    *out = Owned<nook_nnao_recording_s>::make(context->memory(), Ref<nook_context_s>::share(context),
                                              recording_of(known, context->memory()))
               .detach();
  });
}

nook_result nook_nnao_recording_load(nook_context context, const void* bytes, size_t size,
                                     nook_nnao_recording* out) {
  return api::enter("nook_nnao_recording_load", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(bytes, "bytes");
    *out = Owned<nook_nnao_recording_s>::make(
               context->memory(), Ref<nook_context_s>::share(context),
               nnao::read_recording({static_cast<const std::byte*>(bytes), size}, context->memory()))
               .detach();
  });
}

void nook_nnao_recording_destroy(nook_nnao_recording* recording) {
  if (!recording || !*recording) return;
  (*recording)->release();
  *recording = nullptr;
}

nook_result nook_nnao_recording_save(nook_nnao_recording recording, void* bytes, size_t* size) {
  return api::enter("nook_nnao_recording_save", [&] {
    need(recording, "recording");
    need(size, "size");
    const std::vector<std::byte> file = nnao::write_recording(recording->recording);
    const std::size_t room = *size;
    *size = file.size();
    if (!bytes) return;
    if (room < file.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "*size is too small (got %zu bytes, need %zu); call again with a larger buffer", room,
                    file.size());
    std::memcpy(bytes, file.data(), file.size());
  });
}

nook_result nook_nnao_recording_describe(nook_nnao_recording recording, nook_nnao_recording_desc* desc) {
  return api::enter("nook_nnao_recording_describe", [&] {
    need(recording, "recording");
    write_info(desc, desc_of(recording->recording));
  });
}
