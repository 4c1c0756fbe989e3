#include "bakers/import/meshopt_views.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "bakers/import/file_reader.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(std::size_t view, const std::string& fault) {
  throw Failure(NOOK_ERROR_BAD_FILE, "buffer view %zu, compressed by meshopt: %s; export the file again",
                view, fault.c_str());
}

// Returns the entry of the extension in a view, or null if the view does not have it.
const Json* extension_of(const Json& view) {
  if (!view.is_object()) return nullptr;
  const auto extensions = view.find("extensions");
  if (extensions == view.end() || !extensions->is_object()) return nullptr;
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (const auto found = extensions->find(name); found != extensions->end()) return &*found;
  return nullptr;
}

std::uint64_t number(const Json& object, const char* name, bool is_needed, std::size_t view) {
  const auto found = object.find(name);
  if (found == object.end() && !is_needed) return 0;
  if (found == object.end() || !found->is_number_unsigned())
    refuse(view, std::string("\"").append(name).append("\" is missing or not a whole number of 0 or more"));
  return found->get<std::uint64_t>();
}

template <typename Value, std::size_t n>
Value named(const Json& object, const char* name, const std::array<std::pair<const char*, Value>, n>& values,
            Value otherwise, std::size_t view) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (found->is_string())
    for (const auto& [text, value] : values)
      if (found->get_ref<const std::string&>() == text) return value;
  refuse(view, std::string("\"")
                   .append(name)
                   .append("\" is ")
                   .append(found->dump().substr(0, 60))
                   .append(", which Nook does not read"));
}

CompressedView read_view(const Json& object, std::size_t view) {
  using Mode = CompressedView::Mode;
  using Filter = CompressedView::Filter;
  if (!object.is_object()) refuse(view, "its extension is not an object");
  CompressedView out;
  out.view = view;
  out.buffer = number(object, "buffer", true, view);
  out.byte_offset = number(object, "byteOffset", false, view);
  out.byte_length = number(object, "byteLength", true, view);
  out.byte_stride = number(object, "byteStride", true, view);
  out.count = number(object, "count", true, view);
  if (!object.contains("mode")) refuse(view, "\"mode\" is missing");
  out.mode = named<Mode, 3>(
      object, "mode",
      {{{"ATTRIBUTES", Mode::attributes}, {"TRIANGLES", Mode::triangles}, {"INDICES", Mode::indices}}},
      Mode::attributes, view);
  out.filter = named<Filter, 4>(object, "filter",
                                {{{"NONE", Filter::none},
                                  {"OCTAHEDRAL", Filter::octahedral},
                                  {"QUATERNION", Filter::quaternion},
                                  {"EXPONENTIAL", Filter::exponential}}},
                                Filter::none, view);
  return out;
}

// Checks the extension's rules for strides and counts. The decoder relies on them.
void check_layout(const CompressedView& view) {
  using Mode = CompressedView::Mode;
  using Filter = CompressedView::Filter;
  const std::uint64_t stride = view.byte_stride;
  const bool is_index = view.mode != Mode::attributes;
  if (is_index ? stride != 2 && stride != 4 : stride == 0 || stride % 4 != 0 || stride > 256)
    refuse(view.view, "byteStride is " + std::to_string(stride) +
                          (is_index ? " (need 2 or 4)" : " (need a multiple of 4 up to 256)"));
  if (view.mode == Mode::triangles && view.count % 3 != 0)
    refuse(view.view, "it has " + std::to_string(view.count) + " indices (need three per triangle)");
  if (is_index && view.filter != Filter::none)
    refuse(view.view, "it has a filter, which is not allowed for indices");
  if ((view.filter == Filter::octahedral && stride != 4 && stride != 8) ||
      (view.filter == Filter::quaternion && stride != 8))
    refuse(view.view, "byteStride is " + std::to_string(stride) + ", which does not fit the filter");
  // The codec of attributes spends at least a bit on 8 bytes. The codecs of indices spend at least a byte on
  // a triangle or an index.
  const std::uint64_t most_per_byte = is_index ? 12 : 64, room = 16384;
  if (view.count > max_file_bytes ||
      view.count * stride > most_per_byte * std::min(view.byte_length, max_file_bytes) + room)
    refuse(view.view, std::to_string(view.count) + " elements of " + std::to_string(stride) +
                          " bytes each cannot come from " + std::to_string(view.byte_length) + " bytes");
}

// Returns the compressed bytes and checks that they are inside their buffer.
const unsigned char* source_of(const CompressedView& view, const tinygltf::Model& model) {
  if (view.buffer >= model.buffers.size())
    refuse(view.view, "it refers to buffer " + std::to_string(view.buffer) + ", but the file has only " +
                          std::to_string(model.buffers.size()));
  const std::size_t size = model.buffers[view.buffer].data.size();
  if (view.byte_offset > size || view.byte_length > size - view.byte_offset)
    refuse(view.view, "it starts at byte " + std::to_string(view.byte_offset) + " and has " +
                          std::to_string(view.byte_length) + " bytes, but its buffer has only " +
                          std::to_string(size));
  return model.buffers[view.buffer].data.data() + view.byte_offset;
}

void decode(const CompressedView& view, const unsigned char* source, std::vector<unsigned char>& out) {
  using Mode = CompressedView::Mode;
  using Filter = CompressedView::Filter;
  const auto count = std::size_t(view.count), stride = std::size_t(view.byte_stride),
             length = std::size_t(view.byte_length);
  // The first byte has the codec in the upper half and its version in the lower one.
  const unsigned char codec = view.mode == Mode::attributes  ? 0xa0
                              : view.mode == Mode::triangles ? 0xe0
                                                             : 0xd0;
  const int newest = view.mode == Mode::attributes ? 0 : 1;
  if (length == 0 || (source[0] & 0xf0) != codec)
    refuse(view.view, "its data are damaged: they do not begin with the header of the codec");
  if ((source[0] & 0x0f) > newest)
    refuse(view.view, "its data have version " + std::to_string(source[0] & 0x0f) +
                          " of the codec, which Nook does not read (need " + std::to_string(newest) +
                          "); write it with gltfpack -c");
  const int fault =
      view.mode == Mode::attributes  ? meshopt_decodeVertexBuffer(out.data(), count, stride, source, length)
      : view.mode == Mode::triangles ? meshopt_decodeIndexBuffer(out.data(), count, stride, source, length)
                                     : meshopt_decodeIndexSequence(out.data(), count, stride, source, length);
  if (fault != 0) refuse(view.view, "its data are damaged");
  if (view.filter == Filter::octahedral) meshopt_decodeFilterOct(out.data(), count, stride);
  if (view.filter == Filter::quaternion) meshopt_decodeFilterQuat(out.data(), count, stride);
  if (view.filter == Filter::exponential) meshopt_decodeFilterExp(out.data(), count, stride);
}

}  // namespace

std::vector<CompressedView> find_compressed_views(const Json& document) {
  std::vector<CompressedView> out;
  const auto views = document.find("bufferViews");
  if (views == document.end() || !views->is_array()) return out;
  for (std::size_t v = 0; v < views->size(); ++v)
    if (const Json* extension = extension_of((*views)[v])) out.push_back(read_view(*extension, v));
  return out;
}

bool is_fallback_buffer(const Json& buffer) {
  const Json* extension = extension_of(buffer);
  if (!extension || !extension->is_object()) return false;
  const auto fallback = extension->find("fallback");
  return fallback != extension->end() && fallback->is_boolean() && fallback->get<bool>();
}

void decompress_views(const std::vector<CompressedView>& views, tinygltf::Model& model) {
  // Without this limit, views that share compressed bytes would let a small file take any amount of memory.
  std::uint64_t left = max_file_bytes, unread = 0;
  for (const tinygltf::Buffer& buffer : model.buffers) unread += buffer.data.size();
  for (const CompressedView& view : views) {
    check_layout(view);
    const std::uint64_t bytes = view.count * view.byte_stride;
    if (view.view >= model.bufferViews.size() || model.bufferViews[view.view].byteLength != bytes)
      refuse(view.view, "byteLength is not count times byteStride");
    if (bytes > left) refuse(view.view, "the decompressed views have more than 2 GiB in all");
    left -= bytes;
    const unsigned char* source = source_of(view, model);
    if (view.byte_length > unread) refuse(view.view, "it shares bytes with other compressed views");
    unread -= view.byte_length;
    tinygltf::Buffer buffer;
    buffer.data.resize(std::size_t(bytes));
    if (view.count > 0) decode(view, source, buffer.data);
    model.bufferViews[view.view].buffer = static_cast<int>(model.buffers.size());
    model.bufferViews[view.view].byteOffset = 0;
    model.buffers.push_back(std::move(buffer));
  }
}

}  // namespace nook::bake
