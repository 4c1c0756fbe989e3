#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tests/bakers/relief_in_file.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

// more: options that are added, or take the place of those here.
std::vector<std::string> small_bake(const TestFolder& folder, const std::string& output,
                                    const std::map<std::string, std::string>& more = {}) {
  std::map<std::string, std::string> options = {
      {"--meso", "fiber"}, {"-o", folder.path(output)}, {"--texels", "12"},   {"--directions", "12"},
      {"--detail", "0.3"}, {"--bounce-rays", "8"},      {"--view-map", "16"}, {"--ranks", "8,8,8,8"},
      {"--bits", "16"},    {"--votf-ranks", "8,8"},     {"--mixture", "2"}};
  for (const auto& [name, value] : more) options[name] = value;
  std::vector<std::string> arguments = {"bake", "material"};
  for (const auto& [name, value] : options) arguments.insert(arguments.end(), {name, value});
  return arguments;
}

}  // namespace

TEST_CASE(
    "bake material writes a material and its raw file, which evaluate compares, the same on any threads") {
  const TestFolder folder;
  const ToolRun run = folder.run(small_bake(
      folder, "a.nook",
      {{"--keep-raw", folder.path("a.raw")}, {"--report", folder.path("r.json")}, {"--threads", "1"}}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  REQUIRE(folder.run(small_bake(folder, "b.nook", {{"--threads", "2"}})).exit_code == 0);
  CHECK(read_text(folder.path("a.nook")) == read_text(folder.path("b.nook")));
  const auto baked = nlohmann::json::parse(read_text(folder.path("r.json")));
  const auto& row = baked.at("rows").at(0);
  CHECK(row.at("method") == "K-CTA");
  CHECK(row.at("views") == 12);
  CHECK(row.at("file_bytes") == read_text(folder.path("a.nook")).size());
  CHECK(baked.at("recipe").at("source").at("meso") == "fiber");

  const ToolRun measured = folder.run({"evaluate", "material", folder.path("a.raw"), folder.path("a.nook"),
                                       "--images", folder.path("images"), "--report", folder.path("e.json")});
  INFO(measured.error);
  REQUIRE(measured.exit_code == 0);
  const auto report = nlohmann::json::parse(read_text(folder.path("e.json")));
  REQUIRE(report.at("rows").size() == 1);
  CHECK(report.at("rows").at(0).at("file_bytes") == read_text(folder.path("a.nook")).size());
  CHECK(report.at("rows").at(0).at("se_db").get<double>() ==
        Approx(row.at("se_db").get<double>()).margin(1e-6));
  CHECK(!read_text(folder.path("images") + "/fiber_file.png").empty());

  // From the raw file comes the same material again.
  REQUIRE(folder
              .run({"bake", "material", "--raw", folder.path("a.raw"), "-o", folder.path("c.nook"),
                    "--view-map", "16", "--bits", "16", "--ranks", "8,8,8,8", "--votf-ranks", "8,8",
                    "--mixture", "2", "--report", folder.path("c.json")})
              .exit_code == 0);
  const auto again = nlohmann::json::parse(read_text(folder.path("c.json")));
  CHECK(again.at("rows").at(0).at("se_db") == row.at("se_db"));
}

TEST_CASE("bake material trains a neural material, which inspect describes and evaluate measures") {
  const TestFolder folder;
  const ToolRun run = folder.run(small_bake(folder, "n.nook",
                                            {{"--method", "neural"},
                                             {"--channels", "8"},
                                             {"--steps", "60"},
                                             {"--keep-raw", folder.path("n.raw")},
                                             {"--report", folder.path("r.json")}}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const auto baked = nlohmann::json::parse(read_text(folder.path("r.json")));
  CHECK(baked.at("rows").at(0).at("method") == "neural");
  const ToolRun inspected = folder.run({"inspect", folder.path("n.nook")});
  CHECK(inspected.out.find("neural_channels") != std::string::npos);

  const ToolRun measured = folder.run({"evaluate", "material", folder.path("n.raw"), folder.path("n.nook"),
                                       "--unseen", folder.path("n.raw"), "--mipmaps", "--grazing", "--images",
                                       folder.path("images"), "--report", folder.path("e.json")});
  INFO(measured.error);
  REQUIRE(measured.exit_code == 0);
  const auto row = nlohmann::json::parse(read_text(folder.path("e.json"))).at("rows").at(0);
  CHECK(row.at("method") == "file: neural");
  CHECK(row.at("se_db") == baked.at("rows").at(0).at("se_db"));
  CHECK(row.at("se_db_unseen") == row.at("se_db"));
  REQUIRE(row.at("mipmaps").size() == 2);  // of 12 texels
  CHECK(row.at("mipmaps").at(1).at("texels") == 4);
  REQUIRE(row.at("grazing").size() == 5);
  CHECK(row.at("grazing").at(0).at("of_isotropic") == 1);
  CHECK(row.at("grazing").at(1).at("fetches") == 2);
  CHECK(!read_text(folder.path("images") + "/fiber_file.png").empty());

  const ToolRun odd = folder.run(small_bake(folder, "o.nook", {{"--method", "neural"}, {"--channels", "6"}}));
  CHECK(odd.exit_code != 0);
  CHECK(odd.error.find("need a multiple of 4") != std::string::npos);
}

TEST_CASE("bake material traces a folder of maps") {
  const TestFolder folder;
  std::filesystem::create_directory(folder.path("planks"));
  // Portable pixmaps: a text head, then bytes. Two grooves across a tile of one colour.
  std::string colour = "P6\n4 4\n255\n", height = "P6\n32 32\n255\n";
  for (int i = 0; i < 16; ++i) colour += "\xc0\x80\x40";
  for (int i = 0; i < 32 * 32; ++i) height.append(3, i % 16 < 4 ? '\x20' : '\x7f');
  write_text(folder.path("planks/planks_diffuse.ppm"), colour);
  write_text(folder.path("planks/planks_height.ppm"), height);
  const std::vector<std::string> bake{"bake",         "material",
                                      "--pbr",        folder.path("planks/"),
                                      "--texels",     "12",
                                      "--directions", "12",
                                      "--ranks",      "8,8,8,8",
                                      "--view-map",   "0",
                                      "--report",     folder.path("r.json"),
                                      "-o",           folder.path("a.nook")};
  const ToolRun run = folder.run(bake);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.error.find("read planks_height.ppm") != std::string::npos);
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  CHECK(report.at("rows").at(0).at("material") == "planks");
  CHECK(report.at("rows").at(0).at("votf_error_texels_distance").is_null());
  CHECK(report.at("recipe").at("source").at("pbr") == "planks");
  auto with_relief = bake;
  with_relief.insert(with_relief.end(), {"--relief", folder.path("planks/planks_height.ppm")});
  const ToolRun image = folder.run(with_relief);
  INFO(image.error);
  REQUIRE(image.exit_code == 0);
  const auto recipe = nlohmann::json::parse(read_text(folder.path("r.json"))).at("recipe");
  CHECK(recipe.at("compression").at("relief") == "known");
  CHECK(recipe.at("relief").at("heights") == "planks_height.ppm");
  auto high = bake;
  high.insert(high.end(), {"--height-scale", "2"});
  const ToolRun refused = folder.run(high);
  CHECK(refused.exit_code == 2);
  CHECK(refused.error.find("tiles high") != std::string::npos);
  std::filesystem::remove(folder.path("planks/planks_diffuse.ppm"));
  const ToolRun missing = folder.run(bake);
  CHECK(missing.exit_code == 3);
  CHECK(missing.error.find("planks_height.ppm") != std::string::npos);
}

TEST_CASE("heights of an image are in the file at their texels, whose rows begin at its top") {
  const TestFolder folder;
  std::filesystem::create_directory(folder.path("mounds"));
  constexpr std::size_t side = 32, texels = 16;
  constexpr double turn = 6.283185307179586;
  // Waves of other heights along x and y, none of them symmetric.
  const auto height_at = [](double x, double y) {
    return 128 + 70 * std::cos(turn * (x - 0.15)) + 40 * std::sin(turn * y);
  };
  std::string colour = "P6\n32 32\n255\n", height = colour;
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t column = 0; column < side; ++column) {
      const double x = (double(column) + 0.5) / side, y = 1 - (double(row) + 0.5) / side;
      colour.append(3, char(int(128 + 60 * std::cos(turn * (2 * x + y)) + 60 * std::sin(turn * (y - x)))));
      height.append(3, char(int(std::lround(height_at(x, y)))));
    }
  write_text(folder.path("mounds/mounds_diffuse.ppm"), colour);
  write_text(folder.path("mounds/mounds_height.ppm"), height);
  const auto levels_of = [&](const std::vector<std::string>& source) {
    std::vector<std::string> arguments{
        "bake", "material",           "--ranks", "8,8,8,8",  "--view-map",
        "0",    "--height-scale",     "0.2",     "--relief", folder.path("mounds/mounds_height.ppm"),
        "-o",   folder.path("a.nook")};
    arguments.insert(arguments.end(), source.begin(), source.end());
    const ToolRun run = folder.run(arguments);
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
    return relief_in_file(read_text(folder.path("a.nook"))).levels;
  };
  const std::vector<std::uint8_t> levels =
      levels_of({"--pbr", folder.path("mounds"), "--texels", "16", "--directions", "16", "--max-tilt", "45",
                 "--bounces", "0", "--keep-raw", folder.path("a.raw")});
  REQUIRE(levels.size() == texels * texels);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    INFO("texel " << i % texels << " " << i / texels);
    const double at = height_at((double(i % texels) + 0.5) / texels, (double(i / texels) + 0.5) / texels);
    // From 18 to 238 the heights have 220 steps. Means over texels take as much from both waves, of 16 texels
    // each, and levels go from the lowest texel to the highest; extremes between texels are left.
    CHECK(std::abs(double(levels[i]) - 255 * (at - 18) / 220) < 8);
  }
  // The image has the texels of a file's material only when that is read.
  CHECK(levels_of({"--raw", folder.path("a.raw")}) == levels);
}

TEST_CASE("bake material reads the image of --relief before it traces rays or reads a material") {
  const TestFolder folder;
  write_text(folder.path("text.png"), "no image");
  // From 0 to 1, on a tile of 1 m.
  write_text(folder.path("edge.ppm"),
             std::string("P6\n2 2\n255\n") + std::string(6, '\0') + std::string(6, '\xff'));
  for (const auto& [image, code, word] :
       {std::tuple("text.png", 3, "text.png"), std::tuple("edge.ppm", 2, "tiles high")})
    for (const std::vector<std::string>& source :
         std::vector<std::vector<std::string>>{{"--meso", "weave"}, {"--raw", folder.path("none.raw")}}) {
      std::vector<std::string> arguments{"bake",           "material", "--relief", folder.path(image),
                                         "--height-scale", "0.8",      "-o",       folder.path("a.nook")};
      arguments.insert(arguments.end(), source.begin(), source.end());
      const ToolRun run = folder.run(arguments);
      INFO(run.error);
      CHECK(run.exit_code == code);
      CHECK(run.error.find(word) != std::string::npos);
      CHECK(run.error.find("ray tracing") == std::string::npos);
      CHECK(run.error.find("none.raw") == std::string::npos);
    }
}

TEST_CASE("bake material refuses what it cannot bake, by name, and leaves nothing behind") {
  const TestFolder folder;
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& word) {
    const ToolRun run = folder.run(arguments);
    INFO(run.error);
    CHECK(run.exit_code == code);
    CHECK((run.error + run.out).find(word) != std::string::npos);
    CHECK(run.error.find("ray tracing") == std::string::npos);  // at once
    CHECK(folder.names().empty());
  };
  refused({"bake", "material", "-o", folder.path("a.nook")}, 2, "--meso");
  refused({"bake", "material", "--meso", "felt", "-o", folder.path("a.nook")}, 2, "felt");
  refused(small_bake(folder, "a.nook", {{"--ranks", "8,13,8,8"}}), 2, "view rank is 13");
  refused(small_bake(folder, "a.nook", {{"--ranks", "8,8,8"}}), 2, "--ranks");
  refused(small_bake(folder, "a.nook", {{"--clusters", "20"}}), 2, "clusters is 20");
  refused(small_bake(folder, "a.nook", {{"--visibility-mapping", "wide"}}), 2, "--visibility-mapping");
  refused(small_bake(folder, "a.nook", {{"--visibility-mapping", "-1,12"}}), 2, "threshold -1");
  refused(small_bake(folder, "a.nook", {{"--radius", "0"}}), 2, "radius");
  refused(small_bake(folder, "a.nook", {{"--votf-ranks", "13,8"}}), 2, "VOTF's x rank is 13");
  refused(small_bake(folder, "a.nook", {{"--ranks", "auto"}, {"--clusters", "20"}}), 2, "clusters is 20");
  for (const auto& [option, value, word] : {std::tuple("--view-map", "1", "view map has 1"),
                                            std::tuple("--visibility-mapping", "-1,12", "threshold -1"),
                                            std::tuple("--votf-ranks", "8,13", "VOTF's y rank is 13")})
    refused(small_bake(folder, "a.nook", {{"--method", "neural"}, {option, value}}), 2, word);
  refused(small_bake(folder, "a.nook", {{"--method", "neural"}, {"--clusters", "2"}, {"--mixture", "8"}}), 2,
          "mixture K is 8");
  refused({"bake", "material", "--btf", folder.path("nowhere"), "-o", folder.path("a.nook")}, 3, "nowhere");
  refused({"bake", "material", "--raw", folder.path("none.raw"), "-o", folder.path("a.nook")}, 3, "none.raw");
  refused({"bake", "material", "--raw", folder.path("none.raw"), "-o", folder.path("a.nook"), "--relief",
           "known"},
          2, "--relief known needs");
  refused(small_bake(folder, "a.nook", {{"--relief", "none.png"}}), 3, "there is no file none.png");
}

TEST_CASE("bake material refuses another kind of .btf file and names the one it reads") {
  const TestFolder folder;
  write_text(folder.path("a.btf"), "!FMF12FCER");
  const ToolRun run =
      folder.run({"bake", "material", "--btf", folder.path("a.btf"), "-o", folder.path("a.nook")});
  CHECK(run.exit_code == 3);
  CHECK(run.error.find("a.btf") != std::string::npos);
  CHECK(run.error.find("!DFMF08FC") != std::string::npos);
}

TEST_CASE("bake material stops at a signal and leaves nothing behind") {
  const TestFolder folder;
  const ToolRun run = folder.run_and_signal({"bake", "material", "--meso", "roughhole", "-o",
                                             folder.path("a.nook"), "--texels", "96", "--directions", "100"},
                                            SIGINT, "ray tracing");
  CHECK(run.exit_code == 1);
  CHECK(run.error.find("stopped") != std::string::npos);
  CHECK(folder.names().empty());
}

TEST_CASE("evaluate material draws with modes in blocks") {
  const TestFolder folder;
  REQUIRE(folder.run(small_bake(folder, "a.nook", {{"--keep-raw", folder.path("a.raw")}})).exit_code == 0);
  const auto drawn = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"evaluate",           "material",
                                       folder.path("a.raw"), folder.path("a.nook"),
                                       "--report",           folder.path("e.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    REQUIRE(folder.run(arguments).exit_code == 0);
    return nlohmann::json::parse(read_text(folder.path("e.json"))).at("rows").at(0);
  };
  const auto plain = drawn({}), packed = drawn({"--modes", "rgtc", "--whole-light-modes", "0"});
  CHECK(packed.at("gpu_bytes_texel") < plain.at("gpu_bytes_texel"));
  CHECK(packed.at("se_db") == plain.at("se_db"));
  CHECK(packed.at("se_db_drawn") != plain.at("se_db_drawn"));
  CHECK(folder.run({"evaluate", "material", folder.path("a.raw"), folder.path("a.nook"), "--modes", "bc7"})
            .exit_code == 2);
}

TEST_CASE("evaluate material refuses files that do not belong together") {
  const TestFolder folder;
  REQUIRE(folder.run(small_bake(folder, "a.nook", {{"--keep-raw", folder.path("a.raw")}})).exit_code == 0);
  REQUIRE(folder.run(small_bake(folder, "b.nook", {{"--texels", "16"}})).exit_code == 0);
  const ToolRun run = folder.run({"evaluate", "material", folder.path("a.raw"), folder.path("b.nook")});
  CHECK(run.exit_code != 0);
  CHECK(run.error.find("b.nook") != std::string::npos);
  CHECK(folder.run({"evaluate", "material", folder.path("a.nook"), folder.path("a.raw")}).exit_code == 3);
}
