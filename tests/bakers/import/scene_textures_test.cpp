// Colour textures of static scenes: which image, how it is read, and what is refused by name.
#include "tests/catch.h"

#include <cmath>

#include "bakers/import/static_scene.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/import/gltf_builder.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

// A triangle whose material's base colour is an image in a buffer view, and its emission one in a data URI.
GltfBuilder textured_triangle() {
  GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int first = file.add_floats({0, 0, 0.5f, 0, 0, 0.25f}, "VEC2");
  const int second = file.add_floats({1, 2, 3, 4, 5, 6}, "VEC2");
  const int view = file.add_view(std::vector<unsigned char>{1, 2, 3});
  file.document["images"] = Json::array({{{"bufferView", view}, {"mimeType", "image/png"}, {"name", "wood"}},
                                         {{"uri", "data:image/png;base64,CQgH"}}});
  file.document["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
  file.document["textures"] = Json::array({{{"source", 1}}, {{"source", 0}, {"sampler", 0}}});
  file.document["materials"] = Json::array(
      {{{"name", "unused"}},
       {{"pbrMetallicRoughness",
         {{"baseColorFactor", {0.5, 0.5, 0.5, 0.75}}, {"baseColorTexture", {{"index", 1}}}}},
        {"emissiveFactor", {1.0, 1.0, 1.0}},
        {"emissiveTexture",
         {{"index", 0},
          {"texCoord", 0},
          {"extensions",
           {{"KHR_texture_transform",
             {{"texCoord", 1}, {"offset", {0.0, 1.0}}, {"rotation", 1.5707963}, {"scale", {0.5, 0.25}}}}}}}},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.25}}});
  file.document["meshes"] = Json::array(
      {{{"primitives",
         Json::array(
             {{{"attributes", {{"POSITION", position}, {"TEXCOORD_0", first}, {"TEXCOORD_1", second}}},
               {"material", 1}}})}}});
  file.document["nodes"] = Json::array({{{"mesh", 0}}});
  return file;
}

std::string failure_of(const GltfBuilder& file) {
  try {
    import_static_scene(file.glb(), SceneTextures::read);
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    return failure.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a static scene has its surfaces' textures, still encoded, and their coordinates") {
  const StaticScene scene = import_static_scene(textured_triangle().glb(), SceneTextures::read);
  REQUIRE(scene.image.size() == 2);
  CHECK(scene.image[0].bytes == std::vector<std::byte>{std::byte{1}, std::byte{2}, std::byte{3}});
  CHECK(scene.image[0].name == "material 1, baseColorTexture: image 0 (\"wood\")");
  CHECK(scene.image[1].bytes == std::vector<std::byte>{std::byte{9}, std::byte{8}, std::byte{7}});
  const Surface& surface = scene.surface[1];
  CHECK_FALSE(scene.surface[0].base_colour_texture.is_used());
  CHECK(surface.alpha == 0.75f);
  CHECK(surface.alpha_cutoff == 0.25f);
  const TextureUse &base = surface.base_colour_texture, &emission = surface.emission_texture;
  CHECK(base.image == 0);
  CHECK(base.uv_set == 0);
  CHECK(base.wrap_u == TextureWrap::clamped);
  CHECK(base.wrap_v == TextureWrap::mirrored);
  CHECK(base.nearest);
  CHECK(emission.image == 1);
  CHECK(emission.uv_set == 1);
  CHECK(emission.wrap_u == TextureWrap::repeat);
  CHECK_FALSE(emission.nearest);
  // A quarter turn: (u, v) goes to (0.25 v, 1 - 0.5 u), the lower left of the image.
  const float expected[6] = {0, 0.25f, 0, -0.5f, 0, 1};
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(emission.transform[i] - expected[i]) < 1e-6f);
  REQUIRE(scene.uv.size() == 3);
  CHECK(scene.uv[1][0].u == 0.5f);
  CHECK(scene.uv[2][0].v == 0.25f);
  CHECK(scene.uv[2][1].u == 5);
  CHECK(scene.uv[2][1].v == 6);
}

TEST_CASE("textures that are skipped cost nothing and cause no failure") {
  GltfBuilder file = textured_triangle();
  file.document["images"][0] = {{"uri", "nowhere.png"}};
  const StaticScene scene = import_static_scene(file.glb());
  CHECK(scene.image.empty());
  CHECK(scene.uv.empty());
  CHECK_FALSE(scene.surface[1].base_colour_texture.is_used());
  CHECK(scene.surface[1].alpha_cutoff == 0);
}

TEST_CASE("textures that cannot be read are refused by name") {
  const struct {
    const char* at;
    Json value;
    const char* message;
  } faults[] = {
      {"/images/0", {{"uri", "nowhere.png"}}, "image 0 (\"nowhere.png\") cannot be read"},
      {"/textures/1/source", 5, "baseColorTexture refers to image 5, but the file has only 2"},
      {"/textures/1", {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}, "only in a glTF extension"},
      {"/textures/1/sampler", 3, "refers to sampler 3, but the file has only 1"},
      {"/materials/1/emissiveTexture/index", 7,
       "emissiveTexture refers to texture 7, but the file has only 2"},
      {"/materials/1/pbrMetallicRoughness/baseColorTexture/texCoord", 2, "uses TEXCOORD_2"},
      {"/materials/1/emissiveTexture/extensions/KHR_texture_transform/scale", {1e60, 1}, "not finite"},
      {"/accessors/2/count", 2, "has 2 TEXCOORD_1 (need one for each of 3 vertices)"},
      {"/accessors/1/type", "VEC3", "TEXCOORD_0"},
  };
  for (const auto& fault : faults) {
    GltfBuilder file = textured_triangle();
    file.document[Json::json_pointer(fault.at)] = fault.value;
    INFO(fault.at << ": " << failure_of(file));
    CHECK(failure_of(file).find(fault.message) != std::string::npos);
  }
  GltfBuilder file = textured_triangle();
  file.document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_1");
  CHECK(failure_of(file).find("has no TEXCOORD_1, but the texture of material 1 needs it") !=
        std::string::npos);
}

TEST_CASE("an image's buffer view beyond its buffer is not an image") {
  GltfBuilder file = textured_triangle();
  const int view = file.document["images"][0]["bufferView"];
  file.document["bufferViews"][view]["byteLength"] = 1u << 30;
  CHECK_FALSE(failure_of(file).empty());
  file.document["bufferViews"][view] = {{"buffer", 0}, {"byteOffset", 1u << 30}, {"byteLength", 4}};
  CHECK_FALSE(failure_of(file).empty());
}
