// The sample's character through the public interface of the bakers: its shape and its clips.
#pragma once

#include <nook/nook_bake.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace crowd {

// A call of the bakers' library failed.
class BakeError : public std::runtime_error {
 public:
  BakeError(nook_result result, const char* text) : std::runtime_error(text), result_(result) {}
  nook_result result() const { return result_; }

 private:
  nook_result result_;
};

// Throws BakeError with the message of the call that failed.
void check_bake(nook_result result);

// The skinning matrices of one character: 12 floats for each bone, the three rows of a matrix that takes the
// rest pose to world space.
using Bones = std::vector<float>;

struct Clip {
  std::uint32_t index;  // in the character's file
  std::string name;
  float duration_s;
};

class Hero {
 public:
  explicit Hero(std::span<const unsigned char> glb_bytes);
  // A .gltf file may have other files beside it.
  explicit Hero(const std::filesystem::path& path);

  nook_bake_character handle() const { return character_.get(); }
  // A hash of the file's bytes, after which cached models are named.
  std::uint64_t source_hash() const { return source_hash_; }
  std::uint32_t vertex_count() const { return info_.file_vertex_count; }
  std::uint32_t bone_count() const { return info_.bone_count; }
  // The clips in which a character stands or moves. If the file has none, this is the rest pose as a clip.
  const std::vector<Clip>& clips() const { return clips_; }
  // The pose of a clip at a phase from 0 to 1, which runs once through the clip.
  Bones pose(std::size_t clip, float phase) const;

  // The positions and normals of a pose in world space, three floats for each vertex.
  void skin(const Bones& bones, std::vector<float>& positions_ws, std::vector<float>& normals_ws) const;

  std::vector<float> positions_m, normals;  // in the rest pose, three for each vertex
  std::vector<std::uint32_t> triangles;     // three indices each
  std::vector<std::uint16_t> joints;        // four for each vertex
  std::vector<float> weights;               // four for each vertex

 private:
  struct Release {
    void operator()(nook_bake_character character) const { nook_bake_character_destroy(&character); }
  };
  void read();

  std::unique_ptr<nook_bake_character_s, Release> character_;
  std::uint64_t source_hash_ = 0;
  nook_bake_character_info info_{};
  std::vector<Clip> clips_;
};

// Makes the built-in character and leaves its .glb in the cache, where other tools find it.
std::vector<unsigned char> built_in_glb(const std::filesystem::path& cache);

}  // namespace crowd
