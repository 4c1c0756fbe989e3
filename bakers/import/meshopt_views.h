// Decompresses buffer views that use EXT_meshopt_compression or KHR_meshopt_compression.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace nook::bake {

// A compressed view as described in the file. It is not yet checked against the buffers.
struct CompressedView {
  enum class Mode { attributes, triangles, indices };
  enum class Filter { none, octahedral, quaternion, exponential };
  std::size_t view = 0;    // index in the file
  std::size_t buffer = 0;  // buffer with the compressed bytes
  std::uint64_t byte_offset = 0, byte_length = 0, byte_stride = 0, count = 0;
  Mode mode = Mode::attributes;
  Filter filter = Filter::none;
};

// Fails with BAD_FILE if a value or a name is not allowed by the extension.
std::vector<CompressedView> find_compressed_views(const nlohmann::json& document);

// Returns true if a buffer only reserves space for decompressed views.
bool is_fallback_buffer(const nlohmann::json& buffer);

// Decompresses the views into new buffers of the model. The views then refer to these buffers. Fails with
// BAD_FILE; the message names the view. Before memory is allocated, its size is checked against a limit that
// depends on the size of the compressed bytes. All views together may take 2 GiB. The time is linear in the
// decompressed size.
void decompress_views(const std::vector<CompressedView>& views, tinygltf::Model& model);

}  // namespace nook::bake
