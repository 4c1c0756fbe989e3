#include "bakers/import/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bakers/import/draco_meshes.h"
#include "bakers/import/file_reader.h"
#include "bakers/import/foreign_formats.h"
#include "bakers/import/gltf_check.h"
#include "bakers/import/meshopt_views.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

bool is_binary(std::span<const std::byte> bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

std::uint32_t load_u32(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// glTF 2.0, section 4.4: a 12-byte header, then the JSON chunk.
std::span<const std::byte> json_of_binary(std::span<const std::byte> bytes) {
  if (bytes.size() < 20)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "truncated .glb file (got %zu bytes, need at least 20 bytes of headers)", bytes.size());
  const std::uint32_t version = load_u32(bytes, 4);
  const std::uint32_t total = load_u32(bytes, 8);
  const std::uint32_t json = load_u32(bytes, 12);
  if (version != 2)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the binary header says that the file has glTF version %u (need 2); export it as glTF 2.0",
                  version);
  if (total > bytes.size() || total < 20)
    throw Failure(NOOK_ERROR_BAD_FILE, "truncated .glb file (got %zu bytes, but its header says %u)",
                  bytes.size(), total);
  if (json > total - 20)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "truncated .glb file (its JSON chunk should have %u bytes, but only %u are left)", json,
                  total - 20);
  return bytes.subspan(20, json);
}

bool accept_any_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                      int, void*) {
  return true;
}

// Skips images in buffer views. Their bytes are already in the buffer, and tinygltf does not check that the
// views are in bounds.
bool keep_encoded_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                        const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

// A C string ends at the NUL, so different names would become equal.
void refuse_nul(const std::string& name, const char* what, std::size_t index) {
  if (name.find('\0') != std::string::npos)
    throw Failure(NOOK_ERROR_BAD_FILE, "the name of %s %zu (\"%s...\") holds a NUL character; rename it",
                  what, index, name.c_str());
}

void check_names(const tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) refuse_nul(model.nodes[i].name, "node", i);
  for (std::size_t i = 0; i < model.meshes.size(); ++i) refuse_nul(model.meshes[i].name, "mesh", i);
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    refuse_nul(model.animations[i].name, "animation", i);
}

template <std::size_t n>
std::array<double, n> read_numbers(const std::vector<double>& from, std::array<double, n> otherwise,
                                   std::size_t node) {
  if (from.empty()) return otherwise;
  std::array<double, n> out{};
  if (from.size() != n)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "node %zu has a translation, rotation, scale or matrix with %zu numbers (need %zu)", node,
                  from.size(), n);
  std::copy(from.begin(), from.end(), out.begin());
  return out;
}

Node read_node(const tinygltf::Node& source, std::size_t index) {
  Node node;
  node.name = source.name;
  if (!source.matrix.empty()) node.matrix = from_columns(read_numbers<16>(source.matrix, {}, index).data());
  node.local.translation = read_numbers(source.translation, node.local.translation, index);
  node.local.rotation = read_numbers(source.rotation, node.local.rotation, index);
  node.local.scale = read_numbers(source.scale, node.local.scale, index);
  double square = 0;
  for (const double q : node.local.rotation) square += q * q;
  if (square > 0)
    for (double& q : node.local.rotation) q /= std::sqrt(square);
  if (!(square > 0) || !is_finite(default_local(node)))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "node %zu (\"%s\") has a transform that is not finite, or a rotation of length 0", index,
                  node.name.c_str());
  return node;
}

// Returns the bytes of the file with another JSON chunk. glTF 2.0, section 4.4: chunks are padded to 4 bytes.
std::vector<std::byte> with_json(std::span<const std::byte> bytes, std::string json) {
  const auto* text = reinterpret_cast<const std::byte*>(json.data());
  if (!is_binary(bytes)) return {text, text + json.size()};
  json.resize((json.size() + 3) / 4 * 4, ' ');
  text = reinterpret_cast<const std::byte*>(json.data());
  const std::size_t chunks_at = 20 + json_of_binary(bytes).size();
  const std::span<const std::byte> chunks = bytes.subspan(chunks_at, load_u32(bytes, 8) - chunks_at);
  std::vector<std::byte> out(bytes.begin(), bytes.begin() + 20);
  out.insert(out.end(), text, text + json.size());
  out.insert(out.end(), chunks.begin(), chunks.end());
  const auto store = [&](std::size_t at, std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    std::memcpy(out.data() + at, &word, sizeof word);
  };
  store(8, out.size());
  store(12, json.size());
  return out;
}

// Restores the names that were replaced for the parser. Sets URIs to the decoded URIs of the file. Removes
// the name and the bytes of buffers that only reserved space for decompressed views. If a node has both a
// matrix and TRS, keeps the matrix. It then also sets a translation, which tells the later checks that the
// node had both.
void restore(const GltfPreflight& preflight, tinygltf::Model& model) {
  const auto restore_uri = [&](std::string& uri) {
    const auto name = preflight.names.find(uri);
    if (name != preflight.names.end()) uri = name->second;
  };
  for (const std::size_t node : preflight.matrix_beside_trs)
    if (node < model.nodes.size()) model.nodes[node].translation = {0, 0, 0};
  for (tinygltf::Image& image : model.images) restore_uri(image.uri);
  for (tinygltf::Buffer& buffer : model.buffers) {
    restore_uri(buffer.uri);
    if (preflight.rooms.contains(buffer.uri)) buffer = tinygltf::Buffer();
  }
}

}  // namespace

tinygltf::Model parse_gltf(std::span<const std::byte> bytes, const FileAccess& files, Images images) {
  if (bytes.empty()) throw Failure(NOOK_ERROR_BAD_FILE, "the file is empty");
  if (const char* format = foreign_format(bytes))
    throw Failure(NOOK_ERROR_BAD_FILE, "this is %s, not a glTF file; give a .glb or .gltf file", format);
  if (bytes.size() > 0x7fffffffu)
    throw Failure(NOOK_ERROR_BAD_FILE, "the file has %zu bytes (need less than 2 GiB)", bytes.size());
  const GltfPreflight preflight =
      check_before_parsing(is_binary(bytes) ? json_of_binary(bytes) : bytes, is_binary(bytes));
  std::vector<std::byte> replaced;
  if (!preflight.replacement.empty()) {
    replaced = with_json(bytes, preflight.replacement);
    bytes = replaced;
    if (bytes.size() > 0x7fffffffu) throw Failure(NOOK_ERROR_BAD_FILE, "the file has 2 GiB or more");
  }

  LinkedFileReader reader(files.folder, files.linked, preflight, images != Images::keep);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(images == Images::keep ? keep_encoded_image : accept_any_image, nullptr);
  loader.SetFsCallbacks(reader.callbacks());
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool is_loaded = false;
  try {
    const auto size = static_cast<unsigned int>(bytes.size());
    is_loaded =
        is_binary(bytes)
            ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                          files.folder)
            : loader.LoadASCIIFromString(&model, &error, &warning,
                                         reinterpret_cast<const char*>(bytes.data()), size, files.folder);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    error = fault.what();
    is_loaded = false;
  }
  if (!is_loaded && !reader.fault().empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "the file %s", reader.fault().c_str());
  if (!is_loaded)
    throw Failure(NOOK_ERROR_BAD_FILE, "not a glTF 2.0 file, or a damaged one: %s",
                  error.empty() ? "the parser gives no reason" : one_line(error).substr(0, 200).c_str());
  check_names(model);
  restore(preflight, model);
  decompress_views(preflight.compressed_views, model);
  decompress_draco(model);
  check_types(model);
  return model;
}

NodeTree read_nodes(const tinygltf::Model& model) {
  NodeTree tree;
  tree.nodes.reserve(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) tree.nodes.push_back(read_node(model.nodes[i], i));
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    for (const int child : model.nodes[i].children) {
      if (child < 0 || static_cast<std::size_t>(child) >= tree.size())
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "node %zu refers to node %d as a child, but the file has only %zu nodes", i, child,
                      tree.size());
      if (tree.nodes[child].parent >= 0)
        throw Failure(NOOK_ERROR_BAD_FILE, "node %d has two parents, %d and %zu (need a tree)", child,
                      tree.nodes[child].parent, i);
      tree.nodes[child].parent = static_cast<std::int32_t>(i);
    }
  sort_parents_first(tree);
  const std::vector<Affine> world = default_world_transforms(tree);
  for (std::size_t i = 0; i < world.size(); ++i)
    if (!is_finite(world[i]))
      throw Failure(NOOK_ERROR_BAD_FILE, "node %zu (\"%s\") has a world matrix that is not finite", i,
                    tree.nodes[i].name.c_str());
  return tree;
}

}  // namespace nook::bake
