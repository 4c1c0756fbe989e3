// What a studio's pipeline relies on: keys, depfiles, the cache, the order of outputs, pinned instruction
// sets.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/gltf_parts.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"
#include "tests/transfer/shapes.h"

namespace {

namespace fs = std::filesystem;
namespace shapes = nook::transfer::test;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

Names joined(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool is_key(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// A bake of a second.
Names small_bake(const std::string& in, const std::string& out, const Names& more = {}) {
  return joined({"bake", "character",          in,   "-o",     out, "--preset", "draft", "--auto-poses",
                 "30",   "--samples-per-clip", "5",  "--rays", "4", "--steps",  "30",    "--spheres",
                 "6",    "--key-points",       "20", "--quiet"},
                more);
}

std::string key_of(const TestFolder& folder, const Names& command) {
  const ToolRun run = folder.run(joined(command, {"--print-key"}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  REQUIRE(run.out.size() == 65);
  REQUIRE(is_key(run.out.substr(0, 64)));
  return run.out.substr(0, 64);
}

Json inspected(const TestFolder& folder, const std::string& path) {
  const ToolRun run = folder.run({"inspect", path, "--report", folder.path("inspect.json"), "--quiet"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  return Json::parse(read_text(folder.path("inspect.json"))).at("rows").at(0);
}

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

struct Pair {
  Names base, first, second;
};

// Bakes that differ in one option. Every option that decides about a file appears.
std::vector<Pair> pairs_of_characters(const TestFolder& folder) {
  const Names base{"bake", "character", folder.path("hero.glb"), "-o", folder.path("x.nook"), "--quiet"};
  const std::string rig = folder.path("rig.json"), other_rig = folder.path("other_rig.json");
  return {{base, {"--gamma", "2"}, {"--gamma", "1.5"}},
          {base, {"--gamma", "1"}, {"--gamma", "learned"}},
          {base, {"--saturation", "0"}, {}},
          {base, {"--saturation", "1"}, {"--saturation", "2"}},
          {base, {"--preset", "draft"}, {"--preset", "standard"}},
          {base, {"--preset", "production"}, {"--preset", "standard"}},
          {base, {"--poses", "auto"}, {"--poses", "all"}},
          {base, {"--poses", "clips"}, {"--poses", "single-joint"}},
          {base, {"--clips", "bend"}, {"--clips", "wave"}},
          {base, {"--clips", "bend,wave"}, {"--clips", "wave"}},
          {base, {"--split", "half"}, {}},
          {base, {"--form", "paper"}, {}},
          {base, {"--kernel", "paper"}, {}},
          {base, {"--fit", "paper"}, {}},
          {base, {"--spheres", "10"}, {"--spheres", "11"}},
          {base, {"--key-points", "20"}, {"--key-points", "21"}},
          {base, {"--rays", "4"}, {"--rays", "5"}},
          {base, {"--steps", "30"}, {"--steps", "31"}},
          {base, {"--auto-poses", "30"}, {"--auto-poses", "31"}},
          {base, {"--samples-per-clip", "5"}, {"--samples-per-clip", "6"}},
          {base, {"--seed", "1"}, {"--seed", "2"}},
          {base, {"--time-limit", "1"}, {"--time-limit", "2"}},
          {base, {"--rig", rig}, {}},
          {base, {"--rig", rig}, {"--rig", other_rig}},
          {base, {"--mesh", "*"}, {}},
          {base, {"--mesh", "body"}, {"--mesh", "mesh_0"}}};
}

std::vector<Pair> pairs_of_models(const TestFolder& folder) {
  const std::string glb = folder.path("hero.glb"), model = folder.path("hero.nook"),
                    out = folder.path("x.nook");
  const Names lod{"bake", "lod", model, glb, "-o", out, "--quiet"},
      bent{"bake", "bent", glb, model, "-o", out, "--quiet"},
      clips{"bake", "clips", glb, model, "-o", out, "--quiet"};
  return {{lod, {"--auto-poses", "20"}, {"--auto-poses", "21"}},
          {lod, {"--samples-per-clip", "2"}, {"--samples-per-clip", "3"}},
          {lod, {"--rays", "8"}, {"--rays", "9"}},
          {lod, {"--seed", "1"}, {"--seed", "2"}},
          {bent, {"--auto-poses", "20"}, {"--auto-poses", "21"}},
          {bent, {"--samples-per-clip", "2"}, {"--samples-per-clip", "3"}},
          {bent, {"--rays", "8"}, {"--rays", "9"}},
          {bent, {"--seed", "1"}, {"--seed", "2"}},
          {clips, {"--clips", "bend"}, {"--clips", "wave"}},
          {clips, {"--frames-per-second", "10"}, {"--frames-per-second", "11"}},
          {clips, {"--rays", "8"}, {"--rays", "9"}},
          {clips, {"--max-error", "0.02"}, {"--max-error", "0.03"}},
          {clips, {"--max-bytes", "0.2"}, {"--max-bytes", "0.3"}},
          {clips, {"--max-modes", "8"}, {"--max-modes", "12"}},
          {clips, {"--seed", "1"}, {"--seed", "2"}}};
}

std::vector<Pair> pairs_of_others(const TestFolder& folder) {
  const std::string out = folder.path("x.nook");
  const Names probe{"bake", "probe", folder.path("map.hdr"), "-o", out, "--quiet"},
      material{"bake", "material", "--meso", "weave", "-o", out, "--quiet"},
      transfer{"bake", "transfer", folder.path("ball.glb"), "-o", out, "--quiet"};
  return {{probe, {"--lobes", "8"}, {"--lobes", "9"}},
          {probe, {"--sharpness", "2"}, {"--sharpness", "3"}},
          {probe, {"--ambient"}, {}},
          {probe, {"--hemisphere"}, {}},
          {probe, {"--method", "moments"}, {}},
          {probe, {"--constraint", "none"}, {}},
          {probe, {"--basis", "harmonics"}, {"--basis", "dice"}},
          {probe, {"--packing", "half"}, {}},
          {probe, {"--sampling", "uniform"}, {"--sampling", "luminance"}},
          {probe, {"--samples", "1000"}, {"--samples", "1001"}},
          {probe, {"--seed", "1"}, {"--seed", "2"}},
          {material, {"--directions", "12"}, {"--directions", "13"}},
          {material, {"--lights", "12"}, {"--lights", "13"}},
          {material, {"--max-tilt", "70"}, {"--max-tilt", "71"}},
          {material, {"--texels", "32"}, {"--texels", "36"}},
          {material, {"--samples", "1"}, {"--samples", "2"}},
          {material, {"--bounces", "0"}, {"--bounces", "1"}},
          {material, {"--bounce-rays", "8"}, {"--bounce-rays", "9"}},
          {material, {"--count", "3"}, {"--count", "4"}},
          {material, {"--method", "cta"}, {"--method", "n-svd"}},
          {material, {"--votf", "none"}, {"--votf", "binary"}},
          {material, {"--view-map", "8"}, {"--view-map", "9"}},
          {material, {"--step-penalty", "1"}, {"--step-penalty", "2"}},
          {material, {"--ranks", "4,8,8,8"}, {"--ranks", "auto"}},
          {material, {"--bits", "8"}, {"--bits", "16"}},
          {material, {"--seeding", "values"}, {}},
          {material, {"--relief", "known"}, {}},
          {material, {"--seed", "1"}, {"--seed", "2"}},
          {transfer, {"--lobes", "162"}, {"--lobes", "163"}},
          {transfer, {"--ray-side", "8"}, {"--ray-side", "9"}},
          {transfer, {"--bounces", "0"}, {"--bounces", "1"}}};
}

void write_sources(const TestFolder& folder) {
  write_text(folder.path("hero.glb"), glb_tube({"bend", "wave"}));
  write_text(folder.path("map.hdr"), rgbe_map(32, 16));
  write_text(folder.path("rig.json"), R"({"bones": {"tip": {"role": "tail"}}})");
  write_text(folder.path("other_rig.json"), R"({"bones": {"tip": {"role": "leg"}}})");
  const std::vector<std::byte> ball = shapes::glb_of(shapes::ball({0, 0.25f, 0}, 0.2f, 12));
  write_text(folder.path("ball.glb"), {reinterpret_cast<const char*>(ball.data()), ball.size()});
}

}  // namespace

TEST_CASE("bakes that differ in one option have different keys") {
  const TestFolder folder;
  write_sources(folder);
  const ToolRun baked = folder.run(small_bake(folder.path("hero.glb"), folder.path("hero.nook")));
  INFO(baked.error);
  REQUIRE(baked.exit_code == 0);
  std::vector<Pair> pairs = pairs_of_characters(folder);
  for (const auto& more : {pairs_of_models(folder), pairs_of_others(folder)})
    pairs.insert(pairs.end(), more.begin(), more.end());
  REQUIRE(pairs.size() >= 40);
  for (const Pair& pair : pairs) {
    CAPTURE(pair.base, pair.first, pair.second);
    CHECK(key_of(folder, joined(pair.base, pair.first)) != key_of(folder, joined(pair.base, pair.second)));
  }
  // Nothing was baked.
  CHECK_FALSE(fs::exists(folder.path("x.nook")));
}

TEST_CASE("what decides about nothing changes no key") {
  const TestFolder folder;
  write_sources(folder);
  const std::string glb = folder.path("hero.glb"), out = folder.path("x.nook");
  const std::string key = key_of(folder, small_bake(glb, out, {"--seed", "4", "--clips", "bend,wave"}));
  CHECK(key == key_of(folder, joined({"bake", "character", "--clips", "wave,bend", "--seed", "4"},
                                     {glb, "--key-points", "20", "--spheres", "6", "--steps", "30", "--rays",
                                      "4", "--samples-per-clip", "5", "--auto-poses", "30", "--preset",
                                      "draft", "--threads", "1", "--report", folder.path("r.json")})));
  // The order of meshes chooses nothing either.
  CHECK(key_of(folder, small_bake(glb, out, {"--mesh", "*", "--mesh", "?*"})) ==
        key_of(folder, small_bake(glb, out, {"--mesh", "?*", "--mesh", "*", "--mesh", "*"})));
}

TEST_CASE("the key follows what is read, and not the bytes of the file") {
  const TestFolder folder;
  const std::string glb = glb_tube({"bend"});
  write_text(folder.path("hero.glb"), glb);
  const auto key = [&](const char* name) {
    return key_of(folder, small_bake(folder.path(name), folder.path("x.nook")));
  };
  write_gltf_parts(glb, folder.path("hero.gltf"), folder.path("hero.bin"), "hero.bin");
  CHECK(key("hero.gltf") == key("hero.glb"));
  // A texture, a material, another generator.
  write_text(folder.path("skin.png"), "not read");
  write_gltf_parts(glb, folder.path("painted.gltf"), folder.path("hero.bin"), "hero.bin",
                   {{"images", {{{"uri", "skin.png"}}}},
                    {"textures", {{{"source", 0}}}},
                    {"materials", {{{"name", "skin"}}}},
                    {"asset", {{"version", "2.0"}, {"generator", "another"}}}});
  CHECK(key("painted.gltf") == key("hero.glb"));
  // A clip that moves otherwise.
  write_text(folder.path("clip.glb"), glb_tube({"bend", "wave"}));
  CHECK(key("clip.glb") != key("hero.glb"));
  // A vertex that moves by the last bit of one coordinate.
  std::string moved = read_text(folder.path("hero.bin"));
  std::size_t at = 0;
  while (word_at(moved, at) == 0) at += 4;
  moved[at] = char(moved[at] ^ 1);
  write_text(folder.path("moved.bin"), moved);
  write_gltf_parts(glb, folder.path("moved.gltf"), folder.path("unused.bin"), "moved.bin");
  CHECK(key("moved.gltf") != key("hero.glb"));
}

TEST_CASE("every kind of baked file holds the key that its bake printed") {
  const TestFolder folder;
  write_sources(folder);
  const std::string glb = folder.path("hero.glb"), model = folder.path("hero.nook");
  const std::vector<std::pair<std::string, Names>> bakes = {
      {"character", small_bake(glb, model)},
      {"lod", {"bake", "lod", model, glb, "-o", folder.path("lod.nook"), "--auto-poses", "8", "--rays", "4"}},
      {"bent",
       {"bake", "bent", glb, model, "-o", folder.path("bent.nook"), "--auto-poses", "8", "--rays", "4"}},
      {"clips",
       {"bake", "clips", glb, model, "-o", folder.path("clips.nook"), "--rays", "4", "--frames-per-second",
        "8"}},
      {"probe", {"bake", "probe", folder.path("map.hdr"), "-o", folder.path("probe.nook")}},
      {"material",
       {"bake", "material", "--meso", "weave", "--directions", "12", "--texels", "16", "--bounces", "0",
        "--view-map", "8", "-o", folder.path("weave.nook")}},
      {"synthesis",
       {"bake", "synthesis", folder.path("weave.nook"), "--size", "64", "-o", folder.path("plane.nook")}},
      {"transfer",
       {"bake", "transfer", folder.path("ball.glb"), "--lobes", "42", "--ray-side", "8", "-o",
        folder.path("ball.nook")}}};
  for (const auto& [kind, command] : bakes) {
    CAPTURE(kind);
    const ToolRun baked = folder.run(joined(command, {"--report", folder.path(kind + ".json")}));
    INFO(baked.error);
    REQUIRE(baked.exit_code == 0);
    const auto output = std::find(command.begin(), command.end(), "-o") + 1;
    const Json row = inspected(folder, *output);
    CHECK(row.at("key") == key_of(folder, command));
    CHECK(row.at("of_this_tool") == "yes");
    CHECK(row.at("bake_kind") == kind);
    const std::map<std::string, int> later = {{"character", 6}, {"lod", 2}, {"clips", 2}};
    CHECK(row.at("bake_generation") == (later.contains(kind) ? later.at(kind) : 1));
  }
}

TEST_CASE("inspect says in what the tool of a file differs, and knows files without a key") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"bend"}));
  const std::string model = folder.path("hero.nook");
  REQUIRE(folder.run(small_bake(folder.path("hero.glb"), model, {"--isa", "x86-64-v2"})).exit_code == 0);
  CHECK(inspected(folder, model).at("bake_isa") == "x86-64-v2");
  const std::string said = inspected(folder, model).at("of_this_tool");
  // A processor of level 2 bakes with this set by itself.
  if (said != "yes") {
    CHECK(said.starts_with("no: isa x86-64-v2, here x86-64"));
  }
}

TEST_CASE("a depfile names what a bake reads, with the escapes of Ninja") {
  const TestFolder folder;
  const std::string glb = glb_tube({"bend"});
  write_text(folder.path("skin.png"), "not read");
  write_gltf_parts(glb, folder.path("my hero.gltf"), folder.path("a $#.bin"), "a%20$%23.bin",
                   {{"images", {{{"uri", "skin.png"}}}}});
  write_text(folder.path("rig.json"), R"({"bones": {"tip": {"role": "tail"}}})");
  const ToolRun run = folder.run(small_bake(folder.path("my hero.gltf"), folder.path("my hero.nook"),
                                            {"--depfile", folder.path("hero.d")}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  std::string where;
  for (const char c : folder.path("")) where += c == ' ' ? "\\ " : std::string(1, c);
  CHECK(read_text(folder.path("hero.d")) ==
        where + "my\\ hero.nook: \\\n  " + where + "my\\ hero.gltf \\\n  " + where + "a\\ $$\\#.bin\n");
  // The body of a level of detail, and the scene's textures where they are read.
  const ToolRun lod = folder.run({"bake", "lod", folder.path("my hero.nook"), folder.path("my hero.gltf"),
                                  "-o", folder.path("lod.nook"), "--auto-poses", "8", "--rays", "4",
                                  "--depfile", folder.path("lod.d")});
  INFO(lod.error);
  REQUIRE(lod.exit_code == 0);
  CHECK(has(read_text(folder.path("lod.d")), "my\\ hero.nook \\\n"));
  CHECK_FALSE(has(lod.error, "Ninja 1.11"));
  // An apostrophe ends a name for Ninja 1.11, and no escape helps.
  const ToolRun cut = folder.run(
      small_bake(folder.path("my hero.gltf"), folder.path("it's.nook"), {"--depfile", folder.path("c.d")}));
  CHECK(cut.exit_code == 0);
  CHECK(has(cut.error, "Ninja 1.11 cuts off the name"));
  CHECK(has(cut.error, "it's.nook"));
  const ToolRun broken = folder.run(
      small_bake(folder.path("my hero.gltf"), folder.path("a\nb.nook"), {"--depfile", folder.path("n.d")}));
  CHECK(broken.exit_code == 2);
  CHECK(has(broken.error, "line break"));
  const ToolRun same = folder.run(
      small_bake(folder.path("my hero.gltf"), folder.path("x.nook"), {"--depfile", folder.path("x.nook")}));
  CHECK(same.exit_code == 2);
  CHECK(has(same.error, "--depfile"));
}

TEST_CASE("the report is complete before the model file exists") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"bend"}));
  // Nothing fits onto this device, so that the last step of the bake fails.
  if (!fs::is_character_file("/dev/full")) return;
  const ToolRun run =
      folder.run(small_bake(folder.path("hero.glb"), "/dev/full", {"--report", folder.path("r.json")}));
  CHECK(run.exit_code == 1);
  CHECK(Json::parse(read_text(folder.path("r.json"))).contains("mse_train"));
}

TEST_CASE("the cache gives the same files again, and refuses damaged ones") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"bend"}));
  const std::string cache = folder.path("cache");
  const auto bake = [&](const std::string& name, const Names& more = {}) {
    Names command = small_bake(folder.path("hero.glb"), folder.path(name + ".nook"),
                               joined({"--report", folder.path(name + ".json"), "--cache", cache}, more));
    std::erase(command, "--quiet");
    const ToolRun run = folder.run(command);
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
    return run;
  };
  const ToolRun first = bake("first"), again = bake("again", {"--threads", "1"});
  CHECK_FALSE(has(first.error, "taken from the cache"));
  CHECK(has(again.error, "taken from the cache"));
  CHECK(again.out == first.out);
  CHECK(read_text(folder.path("again.nook")) == read_text(folder.path("first.nook")));
  // The report of a hit has the times of its bake.
  CHECK(read_text(folder.path("again.json")) == read_text(folder.path("first.json")));
  CHECK_FALSE(has(bake("other", {"--seed", "2"}).error, "taken from the cache"));
  // A bake with a time limit depends on the machine.
  CHECK_FALSE(has(bake("limited", {"--time-limit", "1000"}).error, "taken from the cache"));

  const std::string key = inspected(folder, folder.path("first.nook")).at("key");
  const std::string entry = cache + "/" + key.substr(0, 2) + "/" + key;
  for (const char* extension : {".nook", ".json"}) {
    CAPTURE(extension);
    std::string bytes = read_text(entry + extension);
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
    write_text(entry + extension, bytes);
    const ToolRun damaged = bake("again");
    CHECK_FALSE(has(damaged.error, "taken from the cache"));
    CHECK(has(damaged.error, "checksum"));
    CHECK(read_text(folder.path("again.nook")) == read_text(folder.path("first.nook")));
    CHECK(has(bake("again").error, "taken from the cache"));
  }
  // A model without its report, as a program leaves that was killed, is not a hit.
  fs::remove(entry + ".json");
  CHECK_FALSE(has(bake("again").error, "taken from the cache"));
  // A folder that cannot be made is refused before the bake.
  write_text(folder.path("file"), "");
  CHECK(
      folder.run(small_bake(folder.path("hero.glb"), folder.path("x.nook"), {"--cache", folder.path("file")}))
          .exit_code == 1);
}

TEST_CASE("cache prune removes by age and by size, and nothing else") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"bend"}));
  const std::string cache = folder.path("cache");
  std::vector<std::string> models;
  for (const char* seed : {"1", "2", "3"}) {
    const std::string model = folder.path(std::string(seed) + ".nook");
    REQUIRE(folder.run(small_bake(folder.path("hero.glb"), model, {"--cache", cache, "--seed", seed}))
                .exit_code == 0);
    const std::string key = inspected(folder, model).at("key");
    models.push_back(cache + "/" + key.substr(0, 2) + "/" + key);
  }
  write_text(cache + "/README", "kept");
  const auto age = [&](std::size_t model, int days) {
    for (const char* extension : {".nook", ".json"})
      fs::last_write_time(models[model] + extension,
                          fs::file_time_type::clock::now() - std::chrono::hours(24 * days));
  };
  age(0, 40);
  age(1, 10);
  age(2, 5);
  CHECK(folder.run({"cache", "prune", "--cache", cache}).exit_code == 2);
  CHECK(folder.run({"cache", "prune", "--older", "30"}).exit_code == 2);
  const ToolRun old = folder.run({"cache", "prune", "--cache", cache, "--older", "30"});
  INFO(old.error);
  REQUIRE(old.exit_code == 0);
  CHECK_FALSE(fs::exists(models[0] + ".nook"));
  CHECK_FALSE(fs::exists(models[0] + ".json"));
  CHECK(fs::exists(models[1] + ".nook"));
  // One entry and a half fit.
  const double entry = double(fs::file_size(models[2] + ".nook") + fs::file_size(models[2] + ".json"));
  REQUIRE(
      folder.run({"cache", "prune", "--cache", cache, "--size", std::to_string(1.5e-6 * entry)}).exit_code ==
      0);
  CHECK_FALSE(fs::exists(models[1] + ".nook"));
  CHECK(fs::exists(models[2] + ".nook"));
  CHECK(fs::exists(models[2] + ".json"));
  CHECK(read_text(cache + "/README") == "kept");
}

TEST_CASE("a pinned instruction set has bytes and a key of its own, again and again") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"bend"}));
  std::map<std::string, std::string> keys, files;
  for (const std::string isa : {"x86-64-v2", "x86-64-v3", "native"})
    for (const std::string round : {"1", "2"}) {
      CAPTURE(isa, round);
      const std::string model = folder.path(isa + round + ".nook");
      const Names command = small_bake(folder.path("hero.glb"), model, {"--isa", isa, "--threads", round});
      const ToolRun run = folder.run(command);
      INFO(run.error);
      if (has(run.error, "this processor lacks")) continue;
      REQUIRE(run.exit_code == 0);
      const auto known = files.emplace(isa, read_text(model)).first;
      CHECK(known->second == read_text(model));
      CHECK(keys.emplace(isa, key_of(folder, command)).first->second == key_of(folder, command));
    }
  const ToolRun unknown =
      folder.run(small_bake(folder.path("hero.glb"), folder.path("x.nook"), {"--isa", "x86-64-v9"}));
  CHECK(unknown.exit_code == 2);
  CHECK(has(unknown.error, "x86-64-v9"));
  if (!keys.contains("x86-64-v3")) return;
  CHECK(keys.at("x86-64-v2") != keys.at("x86-64-v3"));
  CHECK(files.at("x86-64-v2") != files.at("x86-64-v3"));
}
