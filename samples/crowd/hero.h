// The character of the crowd: its mesh, its clips and its baked model, which come from nook_bake.
#pragma once

#include <filesystem>
#include <nook/nook_bake.hpp>
#include <vector>

namespace crowd {

// A pose of one character: 12 floats for each bone, the three rows of a matrix from rest space to world space
// (NOOK_POSE_REST_TO_WORLD). The skinning matrices of an engine start in the space of the mesh instead.
using Bones = std::vector<float>;

struct Clip {
  std::uint32_t index;  // in the character's file
  float duration_s;
};

class Hero {
 public:
  explicit Hero(const std::filesystem::path& glb);

  const nook::bake::Character& character() const { return character_; }
  std::uint32_t vertex_count() const { return info_.file_vertex_count; }
  std::uint32_t bone_count() const { return info_.bone_count; }
  // The clips in which a character stands or moves. If the file has none, the rest pose is the only clip.
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
  nook::bake::Character character_;
  nook_bake_character_info info_;
  std::vector<Clip> clips_;
};

// Makes the built-in character and returns the path of its file in the folder.
std::filesystem::path built_in_glb(const std::filesystem::path& folder);

// Returns the bytes of the model's file for a character from the cache. If the cache has no model, bakes one
// with the draft preset and shows the progress. gamma is the exponent of the norm that adds up shadows; 0
// means the value of the preset.
std::vector<unsigned char> cached_model(const Hero& hero, const std::filesystem::path& cache, bool quiet,
                                        float gamma = 0);

}  // namespace crowd
