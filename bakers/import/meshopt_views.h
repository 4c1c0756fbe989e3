// Buffer views compressed by EXT_meshopt_compression or KHR_meshopt_compression.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace nook::bake {

// A compressed view as the file describes it, not yet checked against the buffers.
struct CompressedView {
  enum class Mode { attributes, triangles, indices };
  enum class Filter { none, octahedral, quaternion, exponential };
  std::size_t view = 0;    // index in the file
  std::size_t buffer = 0;  // buffer with the compressed bytes
  std::uint64_t byte_offset = 0, byte_length = 0, byte_stride = 0, count = 0;
  Mode mode = Mode::attributes;
  Filter filter = Filter::none;
};

// Fails with BAD_FILE on numbers and names that the extension does not have.
std::vector<CompressedView> find_compressed_views(const nlohmann::json& document);

// True for buffers that are only room for decompressed views.
bool is_fallback_buffer(const nlohmann::json& buffer);

// Decompresses the views into buffers that it appends, and points the views to them. Fails with BAD_FILE; the
// message names the view. The size of the compressed bytes limits the memory before it is taken. The limit
// for all views is 2 GiB. The time is linear in the memory.
void decompress_views(const std::vector<CompressedView>& views, tinygltf::Model& model);

}  // namespace nook::bake
