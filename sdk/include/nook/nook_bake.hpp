// C++17 wrappers of the bakers' library: nook_bake.h. A failed call throws nook::Error with the message of
// nook_bake_last_message().
#ifndef NOOK_BAKE_HPP
#define NOOK_BAKE_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nook_bake.h"
#include "nook_handle.hpp"

namespace nook {
inline namespace wrapper {

namespace bake {

// Throws Error, with the message of the bakers' library, unless the call succeeded.
inline void check(nook_result result) {
  if (result != NOOK_OK) throw Error(result, nook_bake_last_message());
}

inline nook_bake_source_desc source_desc() {
  nook_bake_source_desc desc;
  check(nook_bake_source_desc_init(&desc));
  return desc;
}

class Character : public Unique<nook_bake_character, nook_bake_character_destroy> {
 public:
  explicit Character(const nook_bake_source_desc& desc) : Unique(create(desc)) {}
  // Imports a .glb or .gltf file; `path` is UTF-8.
  explicit Character(const std::string& path) : Unique(import(path)) {}

  nook_bake_character_info info() const {
    nook_bake_character_info info{};
    info.struct_size = sizeof info;
    check(nook_bake_character_describe(get(), &info));
    return info;
  }
  // Returns NULL if the index is out of range. The text is valid while the character lives.
  const char* name(nook_bake_name kind, std::uint32_t index) const {
    return nook_bake_character_name(get(), kind, index);
  }
  // Reads `count` elements of an array, without gaps. nook_bake_array describes the elements.
  void read(nook_bake_array array, void* out, std::uint32_t count) const {
    check(nook_bake_character_read(get(), array, out, count, 0));
  }
  float clip_duration(std::uint32_t clip) const {
    float seconds = 0;
    check(nook_bake_character_clip_duration(get(), clip, &seconds));
    return seconds;
  }
  // Returns 12 floats for each bone.
  std::vector<float> sample_clip(std::uint32_t clip, float time_s) const {
    const std::uint32_t bones = info().bone_count;
    std::vector<float> pose(12 * std::size_t(bones));
    check(nook_bake_character_sample_clip(get(), clip, time_s, pose.data(), bones));
    return pose;
  }

 private:
  static nook_bake_character create(const nook_bake_source_desc& desc) {
    nook_bake_character handle = nullptr;
    check(nook_bake_character_create(&desc, &handle));
    return handle;
  }
  static nook_bake_character import(const std::string& path) {
    nook_bake_source_desc desc = source_desc();
    desc.path = path.c_str();
    return create(desc);
  }
};

// A job of a bake. The destructor cancels the job and waits until it ends.
class Job : public Unique<nook_bake_job, nook_bake_job_destroy> {
 public:
  // Pass any bake descriptor, such as nook_bake_character_desc.
  template <class Desc>
  explicit Job(const Desc& desc) : Unique(start(&desc)) {}

  nook_bake_progress progress() const {
    nook_bake_progress progress{};
    progress.struct_size = sizeof progress;
    check(nook_bake_job_poll(get(), &progress));
    return progress;
  }
  void cancel() const { check(nook_bake_job_cancel(get())); }
  void wait() const { check(nook_bake_job_wait(get())); }
  // Waits until the job ends, and returns the bytes of the .nook file.
  std::vector<unsigned char> file() const {
    wait();
    const void* bytes = nullptr;
    std::size_t size = 0;
    check(nook_bake_job_file(get(), &bytes, &size));
    const auto* const first = static_cast<const unsigned char*>(bytes);
    return {first, first + size};
  }
  // Waits until the job ends, and returns its report as JSON text. The text is valid while the job lives.
  const char* report() const {
    wait();
    const char* json = nullptr;
    check(nook_bake_job_report(get(), &json));
    return json;
  }

 private:
  static nook_bake_job start(const void* desc) {
    nook_bake_job handle = nullptr;
    check(nook_bake_start(desc, &handle));
    return handle;
  }
};

}  // namespace bake

}  // namespace wrapper
}  // namespace nook
#endif
