#include "import/gltf.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "core/failure.h"
#include "import/gltf_parts.h"

namespace nook::bake {
namespace {

// Textures are not read: their files may be missing and their formats unknown.
bool ignore_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

tinygltf::Model parse(std::span<const std::byte> bytes, const std::string& folder) {
  if (bytes.size() < 20)
    throw Failure(NOOK_ERROR_BAD_FILE, "not a glTF file (got %zu bytes, a .glb has at least 20)", bytes.size());
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(ignore_image, nullptr);
  if (folder.empty()) {
    // Memory must not reach for files that a hostile document names.
    tinygltf::FsCallbacks none{};
    none.FileExists = [](const std::string&, void*) { return false; };
    none.ExpandFilePath = [](const std::string& path, void*) { return path; };
    none.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; };
    none.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
      return false;
    };
    loader.SetFsCallbacks(none);
  }
  tinygltf::Model model;
  std::string error, warning;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const bool binary = std::memcmp(data, "glTF", 4) == 0;
  bool loaded = false;
  try {
    loaded = binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, data, unsigned(bytes.size()), folder)
                    : loader.LoadASCIIFromString(&model, &error, &warning, reinterpret_cast<const char*>(data),
                                                 unsigned(bytes.size()), folder);
  } catch (const std::exception& e) {
    error = e.what();
  }
  if (!loaded) {
    while (!error.empty() && (error.back() == '\n' || error.back() == ' ')) error.pop_back();
    throw Failure(NOOK_ERROR_BAD_FILE, "not a readable glTF file (%s)", error.empty() ? "unknown fault" : error.c_str());
  }
  return model;
}

ImportedCharacter import_document(std::span<const std::byte> bytes, const std::string& folder) {
  if (bytes.size() > UINT32_MAX)
    throw Failure(NOOK_ERROR_BAD_FILE, "file too large (got %zu bytes, glTF allows 4 GiB)", bytes.size());
  const tinygltf::Model model = parse(bytes, folder);
  ImportedCharacter character;
  character.nodes = read_nodes(model);
  Skeleton skeleton = read_skeleton(model, character.nodes, character.warnings);
  FileMesh mesh = read_meshes(model, character.nodes, skeleton, character.warnings);
  mesh.bones = std::move(skeleton.bones);
  character.bindings = std::move(skeleton.bindings);
  character.mesh = weld(std::move(mesh), character.warnings, NOOK_ERROR_BAD_FILE);
  character.clips = read_clips(model, character.warnings);

  XXH64_state_t hash;
  XXH64_reset(&hash, 0);
  XXH64_update(&hash, bytes.data(), bytes.size());
  for (const tinygltf::Buffer& buffer : model.buffers)
    if (!buffer.uri.empty() && buffer.uri.compare(0, 5, "data:") != 0)
      XXH64_update(&hash, buffer.data.data(), buffer.data.size());
  character.source_hash = XXH64_digest(&hash);
  return character;
}

}  // namespace

ImportedCharacter import_gltf(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw Failure(NOOK_ERROR_BAD_FILE, "is a folder, need a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Failure(NOOK_ERROR_BAD_FILE, "cannot be opened for reading");
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : std::string(".");
  return import_document(std::as_bytes(std::span(bytes)), folder);
}

ImportedCharacter import_gltf(std::span<const std::byte> bytes) { return import_document(bytes, {}); }

}  // namespace nook::bake
