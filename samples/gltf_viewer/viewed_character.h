// Reads a rigged glTF file for a viewer: one mesh, skins, nodes and clips. Vertices are in the order of the
// file, and primitives follow the order of the nodes, which is also the order of Nook's AO. A mesh with
// EXT_mesh_gpu_instancing appears once for each instance. Meshes that a bake leaves out are not read: hidden
// meshes, lower levels of detail, and meshes that the caller names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace viewer {

struct Node {
  std::string name;
  int parent = -1;
  bool has_matrix = false;  // such a node has `matrix` and cannot move
  glm::mat4 matrix{1};
  glm::vec3 translation{0};
  glm::quat rotation{1, 0, 0, 0};
  glm::vec3 scale{1};
};

struct Skin {
  std::vector<int> joints;  // nodes
  std::vector<glm::mat4> inverse_bind;
  std::uint32_t first_matrix = 0;  // index in Pose::matrices
  bool has_mesh = false;           // false: no part of the character uses it
};

struct Vertex {
  glm::vec3 position, normal, albedo;
  std::uint16_t matrices[4];  // indices in Pose::matrices
  glm::vec4 weights;          // their sum is 1
};

struct Channel {
  enum Path { translation, rotation, scale };
  int node = 0;
  Path path = translation;
  bool has_steps = false;
  std::vector<float> times_s;
  std::vector<glm::vec4> values;
};

struct Clip {
  std::string name;
  float duration_s = 0;
  std::vector<Channel> channels;
};

// The matrices of a frame: first global(joint) * inverse bind for each skin, then the global matrix of each
// node. Parts without a skin are drawn with the node's matrix.
struct Pose {
  std::vector<glm::mat4> matrices;
};

struct CharacterFile {
  std::vector<Node> nodes;
  std::vector<int> parents_first;  // all nodes, each after its parent
  std::vector<Skin> skins;         // in the order of the file
  std::uint32_t first_node_matrix = 0;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> triangles;
  std::vector<Clip> clips;

  // Reads a .glb or .gltf file with triangle lists, without the nodes with these names. Throws
  // std::runtime_error with a text that names the file.
  explicit CharacterFile(const std::filesystem::path& path, const std::vector<std::string>& without = {});

  // An empty name means the first clip; if the file has no clips, returns null. For an unknown name, throws
  // std::runtime_error with a list of the clips.
  const Clip* find_clip(const std::string& name) const;
  // If `clip` is null, returns the pose of the file.
  Pose pose(const Clip* clip, float time_s) const;
  // Returns the positions of the vertices in a pose.
  std::vector<glm::vec3> skinned(const Pose& pose) const;
};

}  // namespace viewer
