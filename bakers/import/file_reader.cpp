#include "bakers/import/file_reader.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::json;

// The parser walks "extras" by recursion, so that deep nesting would exhaust the stack, and a value takes
// some 60 bytes in memory where two bytes of text will do.
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
        throw Failure(NOOK_ERROR_BAD_FILE, "JSON nested deeper than %d levels", max_depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
    if ((c == '{' || c == '[' || c == ',') && ++values > max_values)
      throw Failure(NOOK_ERROR_BAD_FILE, "JSON of more than %zu values", max_values);
  }
}

// Read here, or without any bearing on geometry, poses and the colours that are read.
bool is_readable(std::string_view extension) {
  constexpr std::array<std::string_view, 14> names = {"KHR_mesh_quantization",   "KHR_node_visibility",
                                                      "KHR_node_selectability",  "KHR_node_hoverability",
                                                      "EXT_mesh_gpu_instancing", "MSFT_lod",
                                                      "KHR_texture_transform",   "KHR_texture_basisu",
                                                      "KHR_lights_punctual",     "KHR_xmp",
                                                      "KHR_xmp_json_ld",         "EXT_texture_webp",
                                                      "EXT_texture_avif",        "MSFT_texture_dds"};
  return std::find(names.begin(), names.end(), extension) != names.end() ||
         extension.starts_with("KHR_materials_") || extension.starts_with("EXT_materials_");
}

const char* advice_for(std::string_view extension) {
  if (extension == "KHR_draco_mesh_compression") return "decode it first: gltf-transform copy IN.glb OUT.glb";
  if (extension == "EXT_meshopt_compression" || extension == "KHR_meshopt_compression" ||
      extension == "MESHOPT_compression")
    return "decode it first: gltfpack -i IN.glb -o OUT.glb -noq, or gltf-transform copy IN.glb OUT.glb";
  return "export it without";
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
    // The first few say enough.
    if (names.size() < 120) names += (names.empty() ? "" : ", ") + name.substr(0, 60);
  }
  if (advice)
    throw Failure(NOOK_ERROR_BAD_FILE, "the file requires %s, which is not read; %s", names.c_str(), advice);
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

void check_buffers(const Json& document, std::set<std::string>& files) {
  const auto buffers = document.find("buffers");
  if (buffers == document.end() || !buffers->is_array()) return;
  std::uint64_t total = 0;
  for (const Json& buffer : *buffers) {
    if (!buffer.is_object()) continue;
    const auto length = buffer.find("byteLength");
    if (length != buffer.end() && length->is_number()) {
      const double bytes = length->get<double>();
      total += bytes > 0 ? std::uint64_t(std::min(bytes, double(max_file_bytes) + 1)) : 0;
      if (total > max_file_bytes)
        throw Failure(NOOK_ERROR_BAD_FILE, "buffers of more than 2 GiB in all; split the file");
    }
    const auto uri = buffer.find("uri");
    if (uri != buffer.end() && uri->is_string() && !uri->get_ref<const std::string&>().starts_with("data:"))
      files.insert(percent_decoded(uri->get_ref<const std::string&>()));
  }
}

}  // namespace

GltfPreflight check_before_parsing(std::span<const std::byte> json) {
  check_structure(json);
  const char* first = reinterpret_cast<const char*>(json.data());
  const Json document = Json::parse(first, first + json.size(), nullptr, false);
  GltfPreflight result;
  if (!document.is_object()) return result;
  check_extensions(document);
  check_buffers(document, result.buffer_files);
  return result;
}

namespace {

// Returns whether a relative path climbs above where it starts.
bool climbs(const std::string& relative) {
  const std::filesystem::path normal = std::filesystem::path(relative).lexically_normal();
  return normal.is_absolute() || (!normal.empty() && *normal.begin() == "..");
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

// tinygltf looks for every name twice, in the folder given and in the current one, where nothing is to be
// read.
bool LinkedFileReader::may_open(const std::string& path) {
  std::string prefix = folder_;
  if (!prefix.ends_with('/')) prefix += '/';
  if (folder_.empty()) {
    fault_ = "external files are not read from memory; put the buffers into the file";
    return false;
  }
  if (!path.starts_with(prefix)) return false;
  const std::string name = path.substr(prefix.size());
  if (only_ && !only_->contains(name)) return false;
  const auto refuse = [&](const char* why) {
    fault_ = "names \"";
    fault_.append(name, 0, 120).append("\", ").append(why);
    return false;
  };
  if (linked_ == LinkedFiles::folder && climbs(name))
    return refuse("outside of its own folder; copy it there, or allow files outside");
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return refuse("which is not there");
  if (!std::filesystem::is_regular_file(status)) return refuse("which is no regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > left_) return refuse("with which its files have more than 2 GiB");
  return true;
}

bool LinkedFileReader::read(const std::string& path, std::vector<unsigned char>& out) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > left_) return false;
  std::ifstream file(path, std::ios::binary);
  out.resize(std::size_t(size));
  if (!file || !file.read(reinterpret_cast<char*>(out.data()), std::streamsize(size))) {
    fault_ = "names a file that cannot be read: " + path.substr(0, 200);
    return false;
  }
  left_ -= size;
  return true;
}

}  // namespace nook::bake
