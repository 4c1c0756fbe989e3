// C++17 wrappers of recorded frames: nook_recording.h.
#ifndef NOOK_RECORDING_HPP
#define NOOK_RECORDING_HPP

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "../nook_handle.hpp"
#include "nook_recording.h"

namespace nook {
inline namespace wrapper {

// Returns the defaults. You must set the size, the depth, the projection and the radius.
inline nook_nnao_recording_desc nnao_recording_desc() {
  nook_nnao_recording_desc desc;
  check(nook_nnao_recording_desc_init(&desc));
  return desc;
}

// A recorded frame of the screen-space pass.
class Recording : public Unique<nook_nnao_recording, nook_nnao_recording_destroy> {
 public:
  Recording() = default;
  // Takes ownership of a handle, for example from nook_nnao_record.
  explicit Recording(nook_nnao_recording handle) noexcept : Unique(handle) {}
  Recording(const Context& context, const nook_nnao_recording_desc& desc) : Unique(create(context, desc)) {}
  Recording(const Context& context, const void* bytes, std::size_t size)
      : Unique(load(context, bytes, size)) {}

  // The pointers of the result are valid while this object lives.
  nook_nnao_recording_desc desc() const {
    nook_nnao_recording_desc desc{};
    desc.struct_size = sizeof desc;
    check(nook_nnao_recording_describe(get(), &desc));
    return desc;
  }
  std::vector<unsigned char> save() const {
    std::size_t size = 0;
    check(nook_nnao_recording_save(get(), nullptr, &size));
    std::vector<unsigned char> bytes(size);
    check(nook_nnao_recording_save(get(), bytes.data(), &size));
    return bytes;
  }
  // Writes a new temporary file in the same folder and then renames it, so that no incomplete file can
  // appear. If the file exists, the new file keeps its permissions. If the path is a symbolic link, the
  // function replaces the target of the link. Throws std::runtime_error with a text that names the file.
  void write(const std::filesystem::path& file) const {
    const std::vector<unsigned char> bytes = save();
    std::error_code error;
    std::filesystem::path target = std::filesystem::canonical(file, error), part;
    const bool replaces = !error;
    if (!replaces) target = file;
    for (int i = 0; part.empty() || std::filesystem::exists(part, error); ++i)
      (part = target) += ".nook-part-recording-" + std::to_string(i);
    std::ofstream out(part, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    bool written = static_cast<bool>(out);
    if (written && replaces)
      std::filesystem::permissions(part, std::filesystem::status(target, error).permissions(), error);
    if (written) std::filesystem::rename(part, target, error);
    written = written && !error;
    if (!written) {
      std::filesystem::remove(part, error);
      throw std::runtime_error("nook::Recording::write: " + file.string() + " cannot be written");
    }
  }

 private:
  static nook_nnao_recording create(const Context& context, const nook_nnao_recording_desc& desc) {
    nook_nnao_recording handle = nullptr;
    check(nook_nnao_recording_create(context.get(), &desc, &handle));
    return handle;
  }
  static nook_nnao_recording load(const Context& context, const void* bytes, std::size_t size) {
    nook_nnao_recording handle = nullptr;
    check(nook_nnao_recording_load(context.get(), bytes, size, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
