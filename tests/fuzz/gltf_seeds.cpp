#include <meshoptimizer.h>

#include "tests/bakers/import/tube_file.h"
#include "tests/fuzz/seeds.h"

namespace nook::test {
namespace {

// A quad of two triangles, of bytes and shorts, with sparse positions, a second skin's influences and clips
// of every kind.
GltfBuilder flag() {
  GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  const int joint =
      file.add(std::vector<std::uint16_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4", 5123);
  const int weight =
      file.add(std::vector<std::uint8_t>{128, 127, 0, 0, 255, 0, 0, 0, 200, 55, 0, 0, 255, 0, 0, 0}, "VEC4",
               5121, true);
  const int index = file.add(std::vector<std::uint8_t>{0, 1, 2, 3}, "SCALAR", 5121);
  const int sparse_index = file.add_view(std::vector<std::uint16_t>{2});
  const int sparse_value = file.add_view(std::vector<float>{0, 1, 0.5f});
  file.document["accessors"][position]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", sparse_index}, {"componentType", 5123}}},
      {"values", {{"bufferView", sparse_value}}}};
  file.document["nodes"] = {{{"name", "pole"}, {"children", {1, 2, 3}}, {"rotation", {0, 0, 0.6, 0.8}}},
                            {{"name", "hem"}, {"translation", {1, 0, 0}}, {"scale", {1, 2, 1}}},
                            {{"name", "cloth"}, {"mesh", 0}, {"skin", 0}},
                            {{"mesh", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1}}}};
  const Json strip = {{"attributes", {{"POSITION", position}, {"JOINTS_0", joint}, {"WEIGHTS_0", weight}}},
                      {"indices", index},
                      {"mode", 5}};
  const Json fan = {{"attributes", {{"POSITION", position}}}, {"mode", 6}};
  file.document["meshes"] =
      Json::array({{{"primitives", Json::array({strip})}, {"weights", Json::array({0.0})}},
                   {{"primitives", Json::array({fan})}}});
  file.document["skins"] = Json::array({{{"joints", {0, 1}}, {"skeleton", 0}}});
  file.add_animation("wave");
  file.add_channel(1, "translation", {0, 0.5f, 1}, {1, 0, 0, 1, 1, 0, 1, 0, 0}, "STEP");
  file.add_channel(0, "scale", {0.5f, 1}, {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0},
                   "CUBICSPLINE");
  file.add_animation("wave");
  file.add_channel(0, "rotation", {0, 1}, {0, 0, 0, 1, 1, 0, 0, 0});
  return file;
}

// No skin: a clip moves one of two meshes.
GltfBuilder rigid_parts() {
  GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  const int index = file.add(std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}, "SCALAR", 5125);
  file.document["nodes"] = {{{"name", "stand"}, {"children", Json::array({1})}, {"mesh", 0}},
                            {{"name", "arm"}, {"mesh", 0}, {"translation", {0, 1, 0}}}};
  file.document["meshes"] = Json::array(
      {{{"primitives",
         Json::array({{{"attributes", {{"POSITION", position}}}, {"indices", index}, {"material", 0}}})}}});
  file.document["materials"] = Json::array({{{"name", "paint"}}});
  file.add_animation("");
  file.add_channel(1, "rotation", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});
  return file;
}

// A triangle with two textures, of a buffer view and of a data URI, transformed and masked.
GltfBuilder textured() {
  GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int uv = file.add(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 32768}, "VEC2", 5123, true);
  const int view = file.add_view(std::vector<unsigned char>{1, 2, 3});
  file.document["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_emissive_strength"};
  file.document["images"] = Json::array({{{"bufferView", view}, {"mimeType", "image/png"}, {"name", "wood"}},
                                         {{"uri", "data:image/png;base64,CQgH"}}});
  file.document["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
  file.document["textures"] = Json::array({{{"source", 1}}, {{"source", 0}, {"sampler", 0}}});
  const Json transform = {
      {"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", 1.5}, {"scale", {0.5, 2}}}}};
  file.document["materials"] =
      Json::array({{{"pbrMetallicRoughness",
                     {{"baseColorFactor", {0.5, 0.5, 0.5, 0.75}}, {"baseColorTexture", {{"index", 1}}}}},
                    {"emissiveFactor", {1.0, 0.5, 1.0}},
                    {"emissiveTexture", {{"index", 0}, {"texCoord", 0}, {"extensions", transform}}},
                    {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4.0}}}}},
                    {"alphaMode", "MASK"},
                    {"alphaCutoff", 0.25}}});
  file.document["meshes"] = Json::array(
      {{{"primitives",
         Json::array({{{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}, {"material", 0}}})}}});
  file.document["nodes"] = Json::array({{{"mesh", 0}}});
  return file;
}

// Positions compressed by meshopt, with room for them in a second buffer.
GltfBuilder compressed_by_meshopt() {
  GltfBuilder file = rigid_parts();
  const std::vector<float> position{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4, 12));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), position.data(), 4, 12));
  const int source = file.add_view(bytes);
  const char* name = "EXT_meshopt_compression";
  const Json compressed = {{"buffer", 0},
                           {"byteOffset", file.document["bufferViews"][source]["byteOffset"]},
                           {"byteLength", bytes.size()},
                           {"byteStride", 12},
                           {"count", 4},
                           {"mode", "ATTRIBUTES"},
                           {"filter", "NONE"}};
  file.document["bufferViews"].push_back(
      {{"buffer", 1}, {"byteLength", 48}, {"byteStride", 12}, {"extensions", {{name, compressed}}}});
  file.document["accessors"][0]["bufferView"] = source + 1;
  file.document["extensionsRequired"] = {name};
  file.room = {{"byteLength", 48}, {"extensions", {{name, {{"fallback", true}}}}}};
  return file;
}

// The head of Draco's format, without the rest: what follows is the fuzzer's.
GltfBuilder compressed_by_draco() {
  GltfBuilder file = rigid_parts();
  const int view = file.add_view(std::vector<unsigned char>{'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 4,
                                                            4,   0,   1,   0,   0,   2, 1, 3, 1, 2, 3});
  file.document["accessors"][0].erase("bufferView");
  file.document["accessors"][1].erase("bufferView");
  file.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  return file;
}

}  // namespace

std::vector<Seed> seeds() {
  return {{"tube.glb", tube_file().glb()},
          {"flag.glb", flag().glb()},
          {"flag.gltf", flag().gltf()},
          {"parts.glb", rigid_parts().glb()},
          {"textured.glb", textured().glb()},
          {"textured.gltf", textured().gltf()},
          {"meshopt.glb", compressed_by_meshopt().glb()},
          {"draco.glb", compressed_by_draco().glb()}};
}

}  // namespace nook::test
