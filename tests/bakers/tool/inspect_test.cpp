#include <nook/experimental/nook_recording.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bakers/tool/glb_tube.h"
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
  CHECK(row.at("recipe_clips") == "3");  // both clips: two bits of one hexadecimal digit
  CHECK(row.at("bytes_RECP").get<int>() < 1200);
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
