#include <nook/experimental/nook_recording.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bakers/import/gltf_builder.h"
#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

// The bytes of a recording of 2 x 1 pixels, combined with a layer in this way.
std::string recording_with_layer(std::int32_t layer) {
  const float depth[] = {0.95f, 0.96f}, layer_texels[] = {0.5f, 1, 0.25f, 0};
  const float projection[16] = {1.5f, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, -1.002f, -1, 0, 0, -0.2002f, 0};
  nook_context_desc context_desc;
  nook_context context = nullptr;
  REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
  REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
  nook_nnao_recording_desc desc;
  REQUIRE(nook_nnao_recording_desc_init(&desc) == NOOK_OK);
  desc.width = 2;
  desc.height = 1;
  desc.depth = depth;
  desc.layer = layer;
  desc.layer_texels = layer_texels;
  desc.radius = 0.5f;
  desc.taps = 16;
  std::copy_n(projection, 16, desc.projection);
  nook_nnao_recording recording = nullptr;
  const nook_result created = nook_nnao_recording_create(context, &desc, &recording);
  INFO(nook_last_message());
  REQUIRE(created == NOOK_OK);
  std::size_t size = 0;
  nook_nnao_recording_save(recording, nullptr, &size);
  std::string bytes(size, 0);
  REQUIRE(nook_nnao_recording_save(recording, bytes.data(), &size) == NOOK_OK);
  nook_nnao_recording_destroy(&recording);
  nook_context_destroy(&context);
  return bytes;
}

}  // namespace

TEST_CASE("inspect shows what a model holds and refuses what is none") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"walk", "run"}));
  REQUIRE(folder
              .run({"bake", "character", folder.path("hero.glb"), "-o", folder.path("hero.nook"), "--preset",
                    "draft", "--auto-poses", "20", "--rays", "4", "--steps", "20", "--spheres", "6",
                    "--key-points", "20", "--quiet"})
              .exit_code == 0);
  const ToolRun run = folder.run({"inspect", folder.path("hero.nook"), "--report", folder.path("r.json")});
  REQUIRE(run.exit_code == 0);
  const auto row = nlohmann::json::parse(read_text(folder.path("r.json"))).at("rows").at(0);
  CHECK(row.at("bones") == 2);
  CHECK(row.at("vertices") == 140);
  CHECK(row.at("spheres").get<int>() <= 6);
  CHECK(row.at("recipe_poses") == "all");
  CHECK(row.at("recipe_clips") == "3");           // both clips: two bits of one hexadecimal digit
  CHECK(row.at("bytes_RECP").get<int>() < 2600);  // half of it identifies the bake
  CHECK(row.at("world_casters").get<int>() > 0);
  CHECK(row.at("bytes_WCAS").get<int>() <= 2048);
  CHECK(run.out.find("key_points") != std::string::npos);

  const std::string bytes = read_text(folder.path("hero.nook"));
  write_text(folder.path("cut.nook"), bytes.substr(0, bytes.size() - 1));
  const ToolRun cut = folder.run({"inspect", folder.path("cut.nook")});
  CHECK(cut.exit_code == 3);
  CHECK(cut.error.find("cut.nook: ") != std::string::npos);
  CHECK(cut.out.empty());
  CHECK(folder.run({"inspect"}).exit_code == 2);
  CHECK(folder.run({"inspect", folder.path("none.nook")}).exit_code == 3);
}

TEST_CASE("inspect names every layer that a recording may have") {
  const TestFolder folder;
  // The index of a name is its value of nook_gbuffer_ao.
  const std::vector<std::string> names = {"none", "minimum", "remainder", "replace", "apart"};
  for (std::size_t layer = 0; layer < names.size(); ++layer) {
    CAPTURE(layer);
    write_text(folder.path("frame.nook"), recording_with_layer(std::int32_t(layer)));
    const ToolRun run = folder.run({"inspect", folder.path("frame.nook"), "--report", folder.path("r.json")});
    REQUIRE(run.exit_code == 0);
    const auto row = nlohmann::json::parse(read_text(folder.path("r.json"))).at("rows").at(0);
    CHECK(row.at("layer") == names[layer]);
    CHECK(row.at("view") == "result");
    CHECK(row.at("path") == "unknown");
  }
}

namespace {

// A prop of a box's two sides: a body, a spare sword, a hidden hull, a lower level, and lines.
std::string glb_of_parts() {
  nook::test::GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  const int index = file.add(std::vector<unsigned short>{0, 1, 2, 2, 1, 3}, "SCALAR", 5123);
  const nlohmann::json primitive = {{"attributes", {{"POSITION", position}}}, {"indices", index}};
  nlohmann::json lines = primitive;
  lines["mode"] = 1;
  file.document["meshes"] = {{{"name", "panel"}, {"primitives", {primitive, lines, primitive}}},
                             {{"name", "blade"}, {"primitives", nlohmann::json::array({primitive})}}};
  file.document["meshes"][0]["primitives"][2]["attributes"]["POSITION"] =
      file.add_floats({0, 0, 3, 1, 0, 3, 0, 1, 3, 1, 1, 3}, "VEC3");
  file.document["nodes"] = {
      {{"name", "root"}, {"children", {1, 2, 3, 4}}},
      {{"name", "hull"}, {"mesh", 1}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
      {{"name", "Body_LOD1"}, {"mesh", 1}},
      {{"name", "Body"}, {"mesh", 0}},
      {{"name", "Sword"}, {"mesh", 1}, {"translation", {3, 0, 0}}}};
  const std::vector<std::byte> bytes = file.glb();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

TEST_CASE("inspect lists what a bake takes of a glTF file") {
  const TestFolder folder;
  const std::string file = folder.path("hero.glb"), report = folder.path("r.json");
  write_text(file, glb_of_parts());
  const auto inspect = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"inspect", file, "--report", report});
    const ToolRun run = folder.run(options);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find("Body_LOD1") != std::string::npos);
    std::string text;
    const auto all = nlohmann::json::parse(read_text(report));
    for (const auto& row : all.at("rows"))
      text += row.at("node").get<std::string>() + " " + row.at("primitive").dump() + " " +
              row.at("triangles").dump() + " " + row.at("state").get<std::string>() + "\n";
    return text;
  };
  CHECK(inspect({}) ==
        "hull null 2 out: hidden\nBody_LOD1 null 2 out: lower level of detail\nBody 0 2 in\n"
        "Body null 0 out: no triangles\nBody 1 2 in\nSword 2 2 in\n");
  CHECK(inspect({"--without", "S*"}).find("Sword null 2 out: left out by name\n") != std::string::npos);
  CHECK(inspect({"--mesh", "Sword", "--mesh", "*_LOD1"}).find("Body_LOD1 0 2 in\n") != std::string::npos);

  const ToolRun none = folder.run({"inspect", file, "--mesh", "Axe"});
  CHECK(none.exit_code == 2);
  CHECK(none.error.find("hero.glb: no mesh and no node with a mesh is named \"Axe\"") != std::string::npos);
}

TEST_CASE("every command that bakes a glTF file names what it leaves out, and takes the choice") {
  const TestFolder folder;
  const std::string file = folder.path("hero.glb"), out = folder.path("out.nook");
  write_text(file, glb_of_parts());
  write_text(folder.path("sky.hdr"), rgbe_map(16, 8));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"bake", "character", file, "-o", out},
        {"bake", "probe", file, "--light", folder.path("sky.hdr"), "--grid", "1x1x1", "-o", out},
        {"bake", "transfer", file, "-o", out},
        {"bake", "material", "--meso", file, "-o", out}}) {
    CAPTURE(command[1]);
    std::vector<std::string> refused = command;
    refused.insert(refused.end(), {"--without", "*"});
    const ToolRun run = folder.run(refused);
    CHECK(run.exit_code == 3);
    CHECK(run.error.find("1 hidden by KHR_node_visibility (\"hull\")") != std::string::npos);
    CHECK(run.error.find("left out by name (--without) (") != std::string::npos);
  }
}
