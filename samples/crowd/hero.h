// A character as the sample needs it: shape, skin and clips, through the public interface of the bakers.
#pragma once

#include <nook/nook_bake.h>

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace crowd {

class BakeError : public std::runtime_error {
 public:
  BakeError(nook_result result, const char* text) : std::runtime_error(text), result_(result) {}
  nook_result result() const { return result_; }

 private:
  nook_result result_;
};

// Throws BakeError with the last message of the bakers' library where a call failed.
void bake_check(nook_result result);

using Bones = std::vector<float>;  // 12 floats a bone, rows of a 3x4 matrix

struct Clip {
  std::uint32_t index;
  std::string name;
  float duration_s;
};

class Hero {
 public:
  explicit Hero(std::span<const unsigned char> glb_bytes);
  explicit Hero(const std::string& path);  // a .gltf may have files beside it

  nook_bake_character handle() const { return character_.get(); }
  std::uint32_t vertex_count() const { return info_.file_vertex_count; }
  std::uint32_t bone_count() const { return info_.bone_count; }
  // Clips fit for a crowd that stands and moves; never empty, the rest pose stands in.
  const std::vector<Clip>& clips() const { return clips_; }
  // phase in [0, 1) runs once through the clip.
  Bones pose(std::size_t clip, float phase) const;

  // World positions and normals of a pose, three floats a vertex.
  void skin(const Bones& bones, std::vector<float>& positions_ws, std::vector<float>& normals_ws) const;

  std::vector<float> positions_m, normals;  // rest pose
  std::vector<std::uint32_t> triangles;     // three a triangle
  std::vector<std::uint16_t> joints;        // four a vertex
  std::vector<float> weights;               // four a vertex

 private:
  struct Release {
    void operator()(nook_bake_character character) const { nook_bake_character_destroy(&character); }
  };
  void read();

  std::unique_ptr<nook_bake_character_s, Release> character_;
  nook_bake_character_info info_{};
  std::vector<Clip> clips_;
};

}  // namespace crowd
