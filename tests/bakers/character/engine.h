// A rigged file as an engine without this library sees it: global joint matrices, inverse bind matrices, and
// vertices that it skins itself, straight from the glTF specification (section 3.7.3).
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "bakers/import/accessor.h"
#include "bakers/import/clip.h"
#include "bakers/import/gltf.h"
#include "bakers/import/gltf_document.h"
#include "bakers/import/shown_nodes.h"

namespace nook::test {

struct Engine {
  struct Skin {
    std::vector<int> joint;  // nodes
    std::vector<Affine> inverse_bind;
  };
  struct Vertex {
    int node = 0;   // of the mesh
    int skin = -1;  // in the file; -1: the mesh is rigid
    std::array<double, 3> position{};
    std::array<float, 3> normal{};                         // 0 where the file has none
    std::vector<std::pair<std::uint32_t, float>> weights;  // joint, weight
  };

  bake::ImportedCharacter imported;  // for its clips and the names of nodes
  std::vector<Skin> skins;           // all of the file
  std::vector<Vertex> vertices;      // in the order of the imported file
  std::vector<std::uint32_t> index;  // three vertices for each triangle

  explicit Engine(const std::filesystem::path& path) : imported(bake::import_gltf(path)) {
    std::ifstream stream(path, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), {});
    const tinygltf::Model model = bake::parse_gltf(std::as_bytes(std::span(bytes)), {});
    for (const tinygltf::Skin& source : model.skins) {
      Skin skin;
      skin.joint = source.joints;
      skin.inverse_bind.resize(skin.joint.size());
      if (source.inverseBindMatrices >= 0) {
        const auto columns = bake::read_floats(model, source.inverseBindMatrices, 16, "matrices").value;
        for (std::size_t j = 0; j < skin.joint.size(); ++j) {
          std::array<double, 16> matrix;
          std::copy_n(columns.begin() + static_cast<std::ptrdiff_t>(16 * j), 16, matrix.begin());
          skin.inverse_bind[j] = from_columns(matrix.data());
        }
      }
      skins.push_back(std::move(skin));
    }
    const bake::ShownNodes shown = bake::choose_nodes(model, imported.nodes, {});
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      if (shown.shows(n)) add_mesh(model, static_cast<int>(n));
  }

  // Global matrices of all nodes in a clip.
  std::vector<Affine> globals(std::size_t clip, float time_s) const {
    std::vector<Trs> locals = bake::default_locals(imported.nodes);
    bake::apply_clip(imported.clips[clip], time_s, locals);
    return bake::world_transforms(imported.nodes, locals);
  }

  // G(j) B(j) of a skin.
  std::vector<Affine> skinning_matrices(std::size_t skin, const std::vector<Affine>& globals) const {
    std::vector<Affine> out;
    for (std::size_t j = 0; j < skins[skin].joint.size(); ++j)
      out.push_back(globals[static_cast<std::size_t>(skins[skin].joint[j])] * skins[skin].inverse_bind[j]);
    return out;
  }

  std::array<double, 3> skinned(const Vertex& vertex, const std::vector<Affine>& globals) const {
    const auto [x, y, z] = vertex.position;
    if (vertex.skin < 0) return transform(globals[static_cast<std::size_t>(vertex.node)], x, y, z);
    std::array<double, 3> sum{};
    const Skin& skin = skins[static_cast<std::size_t>(vertex.skin)];
    double total = 0;
    for (const auto& [joint, weight] : vertex.weights) {
      const auto p =
          transform(globals[static_cast<std::size_t>(skin.joint[joint])] * skin.inverse_bind[joint], x, y, z);
      for (int i = 0; i < 3; ++i) sum[i] += weight * p[i];
      total += weight;
    }
    for (double& s : sum) s /= total;
    return sum;
  }

 private:
  void add_mesh(const tinygltf::Model& model, int node) {
    const tinygltf::Node& at = model.nodes[static_cast<std::size_t>(node)];
    for (const tinygltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(at.mesh)].primitives) {
      const auto position = bake::read_floats(model, primitive.attributes.at("POSITION"), 3, "positions");
      const std::size_t first = vertices.size();
      for (std::size_t v = 0; v < position.count; ++v)
        vertices.push_back({node,
                            at.skin,
                            {position.value[3 * v], position.value[3 * v + 1], position.value[3 * v + 2]},
                            {},
                            {}});
      if (primitive.indices >= 0) {
        for (const std::uint32_t v : bake::read_integers(model, primitive.indices, 1, "indices").value)
          index.push_back(static_cast<std::uint32_t>(first) + v);
      } else {
        for (std::size_t v = first; v < vertices.size(); ++v) index.push_back(static_cast<std::uint32_t>(v));
      }
      if (primitive.attributes.count("NORMAL")) {
        const auto normal = bake::read_floats(model, primitive.attributes.at("NORMAL"), 3, "normals");
        for (std::size_t v = 0; v < position.count; ++v)
          std::copy_n(&normal.value[3 * v], 3, vertices[first + v].normal.begin());
      }
      for (int set = 0; at.skin >= 0 && primitive.attributes.count("JOINTS_" + std::to_string(set)); ++set) {
        const std::string suffix = std::to_string(set);
        const auto joints =
            bake::read_integers(model, primitive.attributes.at("JOINTS_" + suffix), 4, "joints");
        const auto weights =
            bake::read_floats(model, primitive.attributes.at("WEIGHTS_" + suffix), 4, "weights");
        for (std::size_t v = 0; v < position.count; ++v)
          for (std::size_t k = 0; k < 4; ++k)
            if (weights.value[4 * v + k] > 0)
              vertices[first + v].weights.push_back({joints.value[4 * v + k], weights.value[4 * v + k]});
      }
    }
  }
};

}  // namespace nook::test
