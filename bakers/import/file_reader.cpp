#include "bakers/import/file_reader.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bakers/import/draco_meshes.h"
#include "bakers/import/json_types.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::json;

// The parser reads "extras" recursively, so deep nesting would exhaust the stack. The number of values is
// limited because a value takes about 60 bytes in memory, but may take only two bytes of text.
void check_structure(std::span<const std::byte> json) {
  constexpr int max_depth = 128;
  constexpr std::size_t max_values = std::size_t{1} << 24;
  int depth = 0;
  std::size_t values = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = static_cast<char>(json[i]);
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == '{' || c == '[') {
      if (++depth > max_depth)
        throw Failure(NOOK_ERROR_BAD_FILE, "the JSON is nested deeper than %d levels", max_depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
    if ((c == '{' || c == '[' || c == ',') && ++values > max_values)
      throw Failure(NOOK_ERROR_BAD_FILE, "the JSON has more than %zu values", max_values);
  }
}

// Returns true for an extension that we support. Also returns true if the extension does not affect geometry,
// poses or the colours that we read.
bool is_readable(std::string_view extension) {
  constexpr std::array<std::string_view, 16> names = {
      "EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_mesh_quantization",   "KHR_node_visibility",
      "KHR_node_selectability",  "KHR_node_hoverability",   "EXT_mesh_gpu_instancing", "MSFT_lod",
      "KHR_texture_transform",   "KHR_texture_basisu",      "KHR_lights_punctual",     "KHR_xmp",
      "KHR_xmp_json_ld",         "EXT_texture_webp",        "EXT_texture_avif",        "MSFT_texture_dds"};
  if (extension == "KHR_draco_mesh_compression") return reads_draco();
  return std::find(names.begin(), names.end(), extension) != names.end() ||
         extension.starts_with("KHR_materials_") || extension.starts_with("EXT_materials_");
}

const char* advice_for(std::string_view extension) {
  if (extension == "KHR_draco_mesh_compression") return "decode it first: gltf-transform copy IN.glb OUT.glb";
  if (extension == "MESHOPT_compression")
    return "decode it first: gltfpack -i IN.glb -o OUT.glb -noq, or gltf-transform copy IN.glb OUT.glb";
  return "export it without this requirement";
}

void check_extensions(const Json& document) {
  const auto required = document.find("extensionsRequired");
  if (required == document.end() || !required->is_array()) return;
  std::string names;
  const char* advice = nullptr;
  for (const Json& entry : *required) {
    if (!entry.is_string()) continue;
    const std::string& name = entry.get_ref<const std::string&>();
    if (is_readable(name)) continue;
    if (!advice) advice = advice_for(name);
    // The first few names are sufficient for the message.
    if (names.size() < 120) names += (names.empty() ? "" : ", ") + name.substr(0, 60);
  }
  if (advice)
    throw Failure(NOOK_ERROR_BAD_FILE, "the file requires %s, which Nook does not read; %s", names.c_str(),
                  advice);
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// RFC 3986, section 2.1.
std::string percent_decoded(const std::string& uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    out += low >= 0 ? static_cast<char>(16 * high + low) : uri[i];
    if (low >= 0) i += 2;
  }
  return out;
}

// Reads "2.0" as {2, 0}. In glTF 1.0, the version may be a number instead of a string.
bool read_version(const Json& value, int& major, int& minor) {
  const std::string text = value.is_string()   ? value.get<std::string>()
                           : value.is_number() ? value.dump()
                                               : "";
  char rest = 0;
  minor = 0;
  const int read = std::sscanf(text.c_str(), "%4d.%4d%c", &major, &minor, &rest);
  return major >= 0 && minor >= 0 &&
         (read == 2 || (read == 1 && text.find_first_not_of("0123456789") == text.npos));
}

void check_version(const Json& document) {
  const auto asset = document.find("asset");
  if (asset == document.end() || !asset->is_object() || !asset->contains("version"))
    throw Failure(NOOK_ERROR_BAD_FILE, "the file has no asset.version (need 2.0); export it as glTF 2.0");
  const auto written = [&](const char* key) { return (*asset)[key].dump().substr(0, 40); };
  int major = 0, minor = 0;
  if (!read_version((*asset)["version"], major, minor) || major != 2)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "asset.version says that the file has glTF version %s (need 2.x); export it as glTF 2.0",
                  written("version").c_str());
  if (!asset->contains("minVersion")) return;
  if (!read_version((*asset)["minVersion"], major, minor) || major != 2 || minor > 0)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "asset.minVersion asks for a reader of glTF version %s (this one reads 2.0); export it as glTF 2.0",
        written("minVersion").c_str());
}

// Returns true if the parser decodes a URI in the same way as we do. The parser treats any two characters
// after % as digits, and + as a space.
bool is_decoded_alike(const std::string& uri) {
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '+') return false;
    if (uri[i] == '%' && (i + 2 >= uri.size() || hex_digit(uri[i + 1]) < 0 || hex_digit(uri[i + 2]) < 0))
      return false;
  }
  return true;
}

// Returns the URI of a file; null for a data URI and for an entry without a URI.
const std::string* file_uri(const Json& entry) {
  if (!entry.is_object()) return nullptr;
  const auto uri = entry.find("uri");
  if (uri == entry.end() || !uri->is_string()) return nullptr;
  const std::string& text = uri->get_ref<const std::string&>();
  return text.starts_with("data:") ? nullptr : &text;
}

// Returns true for a buffer that has no bytes. glTF 2.0 allows such buffers (section 3.6.1.1). In a binary
// file, the first buffer has bytes even without a URI.
bool has_no_bytes(const Json& buffers, std::size_t index, bool is_binary) {
  const Json& buffer = buffers[index];
  return buffer.is_object() &&
         (is_fallback_buffer(buffer) || (!buffer.contains("uri") && !(is_binary && index == 0)));
}

// glTF 2.0, section 3.6.1.1: the bytes of a buffer are application/octet-stream or application/gltf-buffer.
// The parser treats all other types as file names.
void check_data_uri(const Json& buffer, std::size_t index) {
  const auto uri = buffer.find("uri");
  if (uri == buffer.end() || !uri->is_string()) return;
  const std::string& text = uri->get_ref<const std::string&>();
  std::string scheme = text.substr(0, 5);
  for (char& c : scheme) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  if (scheme == "data:" && !tinygltf::IsDataURI(text))
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "buffers[%zu].uri begins with \"%s\" (need \"data:application/octet-stream;base64,\"); export "
        "the file again",
        index, text.substr(0, std::min<std::size_t>(text.find(',') + 1, 60)).c_str());
}

void check_buffers(const Json& document, bool is_binary, std::map<std::string, std::uint64_t>& files) {
  const auto buffers = document.find("buffers");
  if (buffers == document.end() || !buffers->is_array()) return;
  std::uint64_t total = 0;
  for (std::size_t b = 0; b < buffers->size(); ++b) {
    const Json& buffer = (*buffers)[b];
    if (!buffer.is_object() || has_no_bytes(*buffers, b, is_binary)) continue;
    check_data_uri(buffer, b);
    const auto length = buffer.find("byteLength");
    std::uint64_t bytes = 0;
    if (length != buffer.end() && length->is_number()) {
      const double number = length->get<double>();
      bytes = number > 0 ? std::uint64_t(std::min(number, double(max_file_bytes) + 1)) : 0;
      total += bytes;
      if (total > max_file_bytes)
        throw Failure(NOOK_ERROR_BAD_FILE, "the buffers have more than 2 GiB in all; split the file");
    }
    if (const std::string* uri = file_uri(buffer)) {
      std::uint64_t& most = files[percent_decoded(*uri)];
      most = std::max(most, bytes);
    }
  }
}

std::vector<std::size_t> nodes_of_two_transforms(const Json& document) {
  std::vector<std::size_t> out;
  const auto nodes = document.find("nodes");
  if (nodes == document.end() || !nodes->is_array()) return out;
  for (std::size_t n = 0; n < nodes->size(); ++n) {
    const Json& node = (*nodes)[n];
    if (node.is_object() && node.contains("matrix") &&
        (node.contains("translation") || node.contains("rotation") || node.contains("scale")))
      out.push_back(n);
  }
  return out;
}

// Returns the primitives of all meshes that have indices and are compressed by Draco.
std::vector<Json*> draco_primitives(Json& document) {
  std::vector<Json*> out;
  const auto meshes = document.find("meshes");
  if (meshes == document.end() || !meshes->is_array()) return out;
  for (Json& mesh : *meshes) {
    if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
    for (Json& primitive : mesh["primitives"])
      if (primitive.is_object() && primitive.contains("extensions") && primitive.contains("indices") &&
          primitive["extensions"].is_object() &&
          primitive["extensions"].contains("KHR_draco_mesh_compression"))
        out.push_back(&primitive);
  }
  return out;
}

// Removes indices without bytes from primitives that Draco compresses. The parser refuses such indices.
// Decompression adds new ones later. Returns true if any were removed.
bool drop_draco_indices(Json& document) {
  bool dropped = false;
  const auto accessors = document.find("accessors");
  if (accessors == document.end() || !accessors->is_array()) return false;
  for (Json* primitive : draco_primitives(document)) {
    const Json& indices = (*primitive)["indices"];
    if (!indices.is_number_unsigned() || indices.get<std::size_t>() >= accessors->size()) continue;
    const Json& accessor = (*accessors)[indices.get<std::size_t>()];
    if (!accessor.is_object() || accessor.contains("bufferView")) continue;
    primitive->erase("indices");
    dropped = true;
  }
  return dropped;
}

// Replaces the URIs of files, and buffers without bytes, if the parser would misread any of them. is_changed
// is true if the document already differs from the JSON in the file.
void replace_uris(Json& document, bool is_binary, bool is_changed, GltfPreflight& result) {
  bool is_needed = drop_draco_indices(document) || is_changed;
  const auto for_each = [&](const char* list, const auto& visit) {
    const auto entries = document.find(list);
    if (entries == document.end() || !entries->is_array()) return;
    const bool are_buffers = std::string_view(list) == "buffers";
    for (std::size_t i = 0; i < entries->size(); ++i)
      visit((*entries)[i], are_buffers && has_no_bytes(*entries, i, is_binary));
  };
  const auto look = [&](const Json& entry, bool is_room) {
    const std::string* uri = file_uri(entry);
    is_needed = is_needed || (uri && !is_decoded_alike(*uri)) || is_room;
  };
  for_each("buffers", look);
  for_each("images", look);
  if (!is_needed) return;
  const auto replace = [&](Json& entry, bool is_room) {
    if (is_room) {
      const std::string room = "room-" + std::to_string(result.rooms.size());
      result.rooms.insert(room);
      entry["uri"] = room;
      entry["byteLength"] = 1;
    } else if (const std::string* uri = file_uri(entry)) {
      const std::string name = "file-" + std::to_string(result.names.size());
      result.names.emplace(name, percent_decoded(*uri));
      entry["uri"] = name;
    }
  };
  for_each("buffers", replace);
  for_each("images", replace);
  result.replacement = document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

GltfPreflight check_before_parsing(std::span<const std::byte> json, bool is_binary) {
  check_structure(json);
  const char* first = reinterpret_cast<const char*>(json.data());
  Json document = Json::parse(first, first + json.size(), nullptr, false);
  GltfPreflight result;
  if (!document.is_object()) return result;
  check_version(document);
  check_extensions(document);
  const bool is_changed = require_member_types(document);
  check_buffers(document, is_binary, result.buffer_files);
  result.compressed_views = find_compressed_views(document);
  result.matrix_beside_trs = nodes_of_two_transforms(document);
  replace_uris(document, is_binary, is_changed, result);
  return result;
}

namespace {

// Returns true if a relative path leads above the folder where it starts.
bool climbs(const std::string& relative) {
  const std::filesystem::path normal = std::filesystem::path(relative).lexically_normal();
  return normal.has_root_path() || (!normal.empty() && *normal.begin() == "..");
}

}  // namespace

std::vector<std::byte> read_file_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw Failure(NOOK_ERROR_BAD_FILE, "this is a folder (need a .glb or .gltf file)");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Failure(NOOK_ERROR_BAD_FILE, "the file is missing or cannot be read");
  std::vector<std::byte> bytes;
  constexpr std::size_t block = std::size_t{1} << 22;
  std::size_t size = 0;
  // A pipe has no known size.
  const std::uintmax_t known = std::filesystem::is_regular_file(path, error) ? file_size(path, error) : block;
  while (file && size <= max_file_bytes) {
    bytes.resize(std::min<std::uintmax_t>(size == 0 ? known + 1 : size + block, max_file_bytes + 1));
    if (size == bytes.size()) break;
    file.read(reinterpret_cast<char*>(bytes.data()) + size, std::streamsize(bytes.size() - size));
    size += std::size_t(file.gcount());
  }
  if (size > max_file_bytes) throw Failure(NOOK_ERROR_BAD_FILE, "the file has more than 2 GiB");
  bytes.resize(size);
  return bytes;
}

tinygltf::FsCallbacks LinkedFileReader::callbacks() {
  tinygltf::FsCallbacks callbacks{};
  callbacks.user_data = this;
  callbacks.FileExists = [](const std::string& path, void* reader) {
    return static_cast<LinkedFileReader*>(reader)->may_open(path);
  };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& path,
                               void* reader) {
    return static_cast<LinkedFileReader*>(reader)->read(path, *out);
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  return callbacks;
}

std::string LinkedFileReader::name_of(const std::string& path) const {
  std::string prefix = folder_;
  if (!prefix.ends_with('/')) prefix += '/';
  if (!path.starts_with(prefix)) return "";
  const std::string uri = path.substr(prefix.size());
  const auto name = preflight_.names.find(uri);
  return name == preflight_.names.end() ? uri : name->second;
}

bool LinkedFileReader::is_room(const std::string& path) const {
  return preflight_.rooms.contains(path.substr(path.rfind('/') + 1));
}

bool LinkedFileReader::refuse(const std::string& name, const char* why) {
  fault_ = "refers to \"";
  fault_.append(name, 0, 120).append("\", ").append(why);
  return false;
}

// Follows symbolic links, because the real file must be in the folder.
bool LinkedFileReader::leaves_folder(const std::string& name) const {
  std::error_code no_folder, no_file;
  const std::filesystem::path folder = std::filesystem::canonical(folder_, no_folder);
  const std::filesystem::path file =
      std::filesystem::canonical(std::filesystem::path(folder_) / name, no_file);
  if (no_folder || no_file) return true;
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first != folder.end();
}

// tinygltf looks for every name twice, in the given folder and in the current one. We read nothing from the
// current one.
bool LinkedFileReader::may_open(const std::string& path) {
  if (is_room(path)) return true;
  if (folder_.empty()) {
    fault_ =
        "it refers to external files, which cannot be read because the file itself was given as bytes in "
        "memory; put the buffers into the file";
    return false;
  }
  const std::string name = name_of(path);
  if (name.empty() || (only_buffers_ && !preflight_.buffer_files.contains(name))) return false;
  // A C string ends at the NUL, so we would open a different file than the one that we checked.
  if (name.find('\0') != std::string::npos)
    return refuse(name.c_str(), "a name with a NUL character; rename it");
  if (linked_ == LinkedFiles::folder && climbs(name))
    return refuse(name,
                  "which is outside the folder of this file; copy it into the folder, or allow files outside "
                  "(--allow-outside-files)");
  std::error_code error;
  const std::filesystem::path file = std::filesystem::path(folder_) / name;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return refuse(name, "which does not exist");
  if (linked_ == LinkedFiles::folder && leaves_folder(name))
    return refuse(name,
                  "a link that leads outside the folder of this file; copy the linked file into the folder, "
                  "or allow files outside (--allow-outside-files)");
  if (!std::filesystem::is_regular_file(status)) return refuse(name, "which is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > left_) return refuse(name, "and together, the linked files have more than 2 GiB");
  return true;
}

bool LinkedFileReader::read(const std::string& path, std::vector<unsigned char>& out) {
  if (is_room(path)) {
    out.assign(1, 0);
    return true;
  }
  std::error_code error;
  const std::filesystem::path named = std::filesystem::path(folder_) / name_of(path);
  std::uintmax_t size = std::filesystem::file_size(named, error);
  if (error || size > left_) return false;
  // The parser accepts only the bytes of the buffer, but the file may be longer.
  const auto buffer = preflight_.buffer_files.find(name_of(path));
  if (buffer != preflight_.buffer_files.end()) size = std::min<std::uintmax_t>(size, buffer->second);
  std::ifstream file(named, std::ios::binary);
  out.resize(std::size_t(size));
  if (!file || !file.read(reinterpret_cast<char*>(out.data()), std::streamsize(size))) {
    fault_ = "refers to a file that cannot be read: " + named.string().substr(0, 200);
    return false;
  }
  left_ -= size;
  return true;
}

}  // namespace nook::bake
