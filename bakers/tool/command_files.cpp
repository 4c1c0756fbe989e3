#include "bakers/tool/command_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>

#include "bakers/tool/depfile.h"
#include "platform/input_file.h"
#include "platform/output_file.h"
#include "sdk/src/core/container.h"

namespace nook::tool {

namespace {

constexpr FourLetters raw_material = four_letters("MRAW");
// A raw material can have up to 16 GiB of floats, which its file stores in half as many bytes. .btf files
// from other tools can also be large. Files of all other kinds are far smaller than 4 GiB, even at the limits
// of their formats.
constexpr std::uint64_t max_raw_bytes = std::uint64_t{16} << 30, max_nook_bytes = std::uint64_t{4} << 30;

std::uint64_t memory_bytes() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? std::uint64_t(pages) * std::uint64_t(size) : UINT64_MAX;
}

// Throws std::runtime_error if the file is too large. Reading a file that is larger than the memory would end
// the program.
void check_size(const std::filesystem::path& path, std::uint64_t size, std::uint64_t most) {
  const std::uint64_t memory = memory_bytes();
  const bool fits_machine = size <= memory;
  if (size <= most && fits_machine) return;
  throw std::runtime_error(path.string() + ": is too large (got " + std::to_string(size) +
                           " bytes, need at most " + std::to_string(std::min(most, memory)) +
                           (size <= most ? ", the memory of this machine); use a larger machine"
                                         : "); it is damaged, or not a file that this command reads"));
}

// Throws std::runtime_error if the size in the head of a .nook file differs from the file's size.
void check_nook_size(const std::filesystem::path& path, std::span<const std::byte> head, std::uint64_t size) {
  check_size(path, size, container_kind(head) == raw_material ? max_raw_bytes : max_nook_bytes);
  const std::uint64_t said = container_size(head);
  if (said != size)
    throw std::runtime_error(path.string() + ": the file's size is wrong (got " + std::to_string(size) +
                             " bytes, need " + std::to_string(said) + "); it was cut or extended");
}

template <class Read>
std::vector<std::byte> reading(Read&& read) {
  try {
    return read();
  } catch (const platform::Stopped&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw ToolError(exit_bad_input, error.what());
  }
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path) {
  return reading([&] {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error) return platform::read_input(path, max_nook_bytes, file_events(true));  // the message says why
    std::vector<std::byte> head(std::min<std::uint64_t>(size, container_head_bytes));
    std::ifstream(path, std::ios::binary)
        .read(reinterpret_cast<char*>(head.data()), std::streamsize(head.size()));
    if (container_kind(head) == 0) return head;
    check_nook_size(path, head, size);
    return platform::read_input(path, size, file_events(true));
  });
}

std::vector<std::byte> read_any_file(const std::filesystem::path& path) {
  return reading([&] {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (!error) check_size(path, size, max_raw_bytes);
    return platform::read_input(path, max_raw_bytes, file_events(true));
  });
}

namespace {

namespace fs = std::filesystem;

// Two paths name the same file if their identities are equal. The identity of an existing file is its device
// and inode. The identity of a file that does not exist yet is the device and inode of its folder, and its
// name.
struct Identity {
  dev_t device = 0;
  ino_t inode = 0;
  std::string name;

  bool operator==(const Identity&) const = default;
};

struct KnownFile {
  std::string option;
  fs::path path;
  Identity identity;
  bool is_character_device;
};

std::optional<KnownFile> identify(const NamedFile& file) {
  if (file.path.empty()) return std::nullopt;
  struct stat there;
  if (stat(file.path.c_str(), &there) == 0)
    return KnownFile{file.option, file.path, {there.st_dev, there.st_ino, ""}, S_ISCHR(there.st_mode)};
  const fs::path target = platform::followed(file.path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (stat(folder.c_str(), &there) != 0)
    return std::nullopt;  // the folder does not exist, so nothing can be
                          // written there
  return KnownFile{file.option, file.path, {there.st_dev, there.st_ino, target.filename().string()}, false};
}

// Decodes a URI, in which a percent sign and two hexadecimal digits encode a byte.
std::string decode_uri(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    text += escaped ? char(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (escaped) i += 2;
  }
  return text;
}

// Returns the JSON of a .gltf or .glb file, or null if it cannot be read. The import reports the error later.
nlohmann::json document_of(const fs::path& path) {
  std::error_code error;
  const fs::path extension = path.extension();
  if ((extension != ".gltf" && extension != ".glb") || !fs::is_regular_file(path, error)) return {};
  std::ifstream stream(path, std::ios::binary);
  if (extension == ".gltf") return nlohmann::json::parse(stream, nullptr, false);
  // In a .glb file, the length and the type of the JSON chunk follow a header of 12 bytes (glTF 2.0, section
  // 4.4).
  std::array<unsigned char, 20> head{};
  if (!stream.read(reinterpret_cast<char*>(head.data()), head.size())) return {};
  const std::uint64_t length = head[12] | head[13] << 8 | head[14] << 16 | std::uint64_t(head[15]) << 24;
  if (length > fs::file_size(path, error) || error) return {};
  std::string text(length, 0);
  stream.read(text.data(), std::streamsize(length));
  return nlohmann::json::parse(text, nullptr, false);
}

// Returns the files that a glTF file refers to in its lists `kinds`, such as "buffers" and "images".
std::vector<NamedFile> referred_files(const NamedFile& gltf, std::initializer_list<const char*> kinds) {
  std::vector<NamedFile> files;
  const auto document = document_of(gltf.path);
  if (!document.is_object()) return files;
  for (const char* kind : kinds) {
    const auto list = document.find(kind);
    if (list == document.end() || !list->is_array()) continue;
    for (const auto& entry : *list)
      if (entry.is_object() && entry.contains("uri") && entry["uri"].is_string()) {
        const std::string uri = entry["uri"];
        if (!uri.starts_with("data:"))
          files.push_back({"a file of " + gltf.option, gltf.path.parent_path() / decode_uri(uri)});
      }
  }
  return files;
}

std::vector<NamedFile> files_in(const NamedFile& folder) {
  std::vector<NamedFile> files;
  std::error_code error;
  if (!fs::is_directory(folder.path, error)) return files;
  for (fs::directory_iterator entry(folder.path, error), end; !error && entry != end; entry.increment(error))
    files.push_back({"a file of " + folder.option, entry->path()});
  return files;
}

std::vector<KnownFile> identify_all(const std::vector<NamedFile>& files) {
  std::vector<KnownFile> known;
  for (const NamedFile& file : files)
    if (auto one = identify(file)) known.push_back(std::move(*one));
  return known;
}

[[noreturn]] void refuse(const KnownFile& output, const KnownFile& other) {
  std::string text =
      output.option + " and " + other.option + " name the same file (got " + output.path.string();
  if (output.path != other.path) text += " and " + other.path.string();
  throw ToolError(exit_bad_arguments, text + "); choose another place for " + output.option);
}

// Throws if the file is in the folder of the pictures, because a picture could replace it.
void require_not_among_pictures(const KnownFile& file, const fs::path& images) {
  const fs::path extension = file.path.extension();
  if (extension != ".png" && extension != ".svg") return;
  std::error_code error;
  const fs::path target = platform::followed(file.path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (fs::equivalent(folder, images, error))
    throw ToolError(exit_bad_arguments,
                    file.option +
                        " lies in the folder of --images, where a picture could overwrite it (got " +
                        file.path.string() + "); choose another folder for --images");
}

}  // namespace

void require_distinct_files(const CommandFiles& files) {
  std::vector<NamedFile> read = files.inputs;
  for (const NamedFile& input : files.inputs)
    for (const std::vector<NamedFile>& more : {referred_files(input, {"buffers", "images"}), files_in(input)})
      read.insert(read.end(), more.begin(), more.end());
  const std::vector<KnownFile> inputs = identify_all(read), outputs = identify_all(files.outputs);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const KnownFile& input : inputs)
      if (outputs[i].identity == input.identity && !input.is_character_device) refuse(outputs[i], input);
    for (std::size_t j = 0; j < i; ++j)
      if (outputs[i].identity == outputs[j].identity && !outputs[i].is_character_device)
        refuse(outputs[i], outputs[j]);
  }
  if (files.images.empty()) return;
  for (const std::vector<KnownFile>* known : {&inputs, &outputs})
    for (const KnownFile& file : *known) require_not_among_pictures(file, files.images);
}

std::vector<fs::path> files_read(const CommandFiles& files, bool with_images) {
  std::vector<fs::path> read;
  for (const NamedFile& input : files.inputs) {
    if (input.path.empty()) continue;
    std::error_code error;
    if (!fs::is_directory(input.path, error)) read.push_back(input.path);
    std::vector<NamedFile> more = referred_files(input, {"buffers"});
    if (with_images)
      for (NamedFile& image : referred_files(input, {"images"})) more.push_back(std::move(image));
    for (NamedFile& file : files_in(input)) more.push_back(std::move(file));
    std::vector<fs::path> names;
    for (const NamedFile& file : more)
      if (fs::is_regular_file(file.path, error)) names.push_back(file.path);
    std::sort(names.begin(), names.end());
    read.insert(read.end(), names.begin(), names.end());
  }
  return read;
}

void make_image_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw ToolError(exit_other, "--images: " + folder.string() + " cannot be made (" +
                                    (error ? error.message() : "it is a file") + "); choose another folder");
  if (faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    throw ToolError(exit_other, "--images: no file can be made in " + folder.string() + " (" +
                                    std::strerror(errno) + "); choose another folder");
}

std::string as_file_name(const std::string& name) {
  std::string safe = name;
  for (char& c : safe)
    if (c == '/' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
  return safe;
}

}  // namespace nook::tool
