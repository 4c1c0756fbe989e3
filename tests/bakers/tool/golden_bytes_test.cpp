// Bakes whose bytes are written down. A bake that begins to give other bytes has to get a new generation
// (bakers/job/bake_identity.cpp); otherwise caches and build systems keep models of the old code beside new
// ones. golden_bytes.txt has the hash of every generation. After you raised one,
//
//   NOOK_BLESS=1 nook_golden_bytes_test
//
// bakes, appends the missing lines to the list and prints them. It never changes a line.
//
// Other processors, compilers and libraries round in another order. The test skips the bakes there and says
// so.
#include <gnu/libc-version.h>

#include <nook/experimental/nook_calibration.h>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <nook/nook.hpp>
#include <sstream>

#include "bakers/import/sha256.h"
#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"
#include "tests/transfer/shapes.h"

namespace {

namespace shapes = nook::transfer::test;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

struct Line {
  std::string kind, asset;
  int generation = 0;
  std::string hash;

  bool operator==(const Line&) const = default;
};

std::string text_of(const Line& line) {
  return line.kind + " " + line.asset + " " + std::to_string(line.generation) + " " + line.hash;
}

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream stream(text);
  for (std::string row; std::getline(stream, row);) {
    if (row.empty() || row[0] == '#') continue;
    Line line;
    std::istringstream words(row);
    std::string more;
    INFO("golden_bytes.txt: " << row);
    REQUIRE(words >> line.kind >> line.asset >> line.generation >> line.hash);
    REQUIRE_FALSE(words >> more);
    REQUIRE(line.hash.size() == 64);
    lines.push_back(line);
  }
  return lines;
}

// The newest line of an asset.
const Line* last_line(const std::vector<Line>& list, const Line& asset) {
  const Line* last = nullptr;
  for (const Line& line : list)
    if (line.kind == asset.kind && line.asset == asset.asset) last = &line;
  return last;
}

bool is_missing(const std::vector<Line>& list, const Line& baked) {
  const Line* const last = last_line(list, baked);
  return !last || last->generation < baked.generation;
}

// Says what is wrong with a bake and what to do; nothing if it has the bytes of its generation.
std::string problem_of(const std::vector<Line>& list, const Line& baked) {
  const Line* const last = last_line(list, baked);
  if (last && *last == baked) return "";
  const std::string what = "a bake of kind " + baked.kind + " (" + baked.asset + ")";
  if (is_missing(list, baked))
    return what + " has generation " + std::to_string(baked.generation) +
           ", which the list lacks; append to golden_bytes.txt: " + text_of(baked);
  if (last->generation > baked.generation)
    return what + " has generation " + std::to_string(baked.generation) + ", and the list has " +
           std::to_string(last->generation) + " already; generations in bake_identity.cpp only rise";
  Line next = baked;
  ++next.generation;
  return what + " gives other bytes than before; raise the generation of " + baked.kind +
         " in bakers/job/bake_identity.cpp to " + std::to_string(next.generation) +
         " and append to golden_bytes.txt: " + text_of(next);
}

template <class Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  REQUIRE(offset + sizeof(Number) <= bytes.size());
  Number number{};
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

// Hashes the kind, the version and the sections of a .nook file, but not its recipe, which names versions of
// tools. sdk/src/core/container.h describes the bytes.
std::string hash_of_results(const std::string& file) {
  constexpr std::size_t kind = 8, kind_size = 8, count = 32, table = 40, entry_size = 24;
  REQUIRE(file.substr(0, 4) == "NOOK");
  std::string results = file.substr(kind, kind_size);
  bool has_recipe = false;
  for (std::uint32_t i = 0; i < number_at<std::uint32_t>(file, count); ++i) {
    const std::size_t entry = table + entry_size * i;
    const std::string name = file.substr(entry, 4);
    if (name == "RECP") {
      has_recipe = true;
      continue;
    }
    const auto offset = number_at<std::uint64_t>(file, entry + 8),
               size = number_at<std::uint64_t>(file, entry + 16);
    REQUIRE(offset + size <= file.size());
    results += name + std::to_string(size) + ":" + file.substr(offset, size);
  }
  REQUIRE(has_recipe);
  return nook::bake::sha256(std::string_view(results));
}

struct Bake {
  std::string asset;
  Names command;          // without the output
  std::string output;     // a name in the folder
  std::string base = {};  // the output that it starts from, if any
};

// Poses of the tube as a game records them: its second joint turns by angles with rational sines.
std::string recorded_poses(const std::string& model_file) {
  nook::Context context;
  nook::CharacterModel model(context, model_file.data(), model_file.size());
  nook::Scene scene(context);
  const nook_instance_id id = scene.add_instance(model);
  std::string file;
  const float sines[][2] = {{0, 1}, {0.28f, 0.96f}, {0.6f, 0.8f}, {0.8f, 0.6f}, {-0.6f, 0.8f}, {-0.8f, 0.6f}};
  for (const auto& [s, c] : sines) {
    const float joint_x = 0.5f;
    const float bones[] = {1, 0,  0, 0,                      //
                           0, 1,  0, 0,                      //
                           0, 0,  1, 0,                      //
                           c, -s, 0, joint_x - c * joint_x,  //
                           s, c,  0, -s * joint_x,           //
                           0, 0,  1, 0};
    nook_pose_desc pose = nook::pose_desc();
    pose.kind = NOOK_POSE_REST_TO_WORLD;
    pose.layout = NOOK_TRANSFORM_ROWS_3X4;
    pose.transforms = bones;
    pose.transform_count = 2;
    scene.set_pose(id, pose);
    std::size_t size = 0;
    nook::check(nook_scene_record_pose(scene.get(), id, nullptr, &size));
    std::string record(size, '\0');
    nook::check(nook_scene_record_pose(scene.get(), id, record.data(), &size));
    file += record;
  }
  return file;
}

class Bakes {
 public:
  Bakes() {
    write_text(path("tube.glb"), glb_tube({"bend", "wave"}));
    write_text(path("person.glb"), glb_person());
    write_text(path("still.glb"), glb_tube({}, false));
    write_text(path("sky.hdr"), rgbe_map(32, 16));
    const std::vector<std::byte> ball = shapes::glb_of(shapes::ball({0, 0.25f, 0}, 0.2f, 12));
    write_text(path("ball.glb"), {reinterpret_cast<const char*>(ball.data()), ball.size()});
  }

  std::string path(const std::string& name) const { return folder_.path(name); }
  const TestFolder& folder() const { return folder_; }

  // Bakes, and returns what inspect says of the file.
  Json run(const Bake& bake) const {
    Names command{"bake"};
    command.insert(command.end(), bake.command.begin(), bake.command.end());
    command.insert(command.end(), {"-o", path(bake.output), "--isa", "x86-64-v3", "--quiet"});
    const ToolRun baked = folder_.run(command);
    INFO(baked.error);
    REQUIRE(baked.exit_code == 0);
    const ToolRun inspected =
        folder_.run({"inspect", path(bake.output), "--report", path("inspect.json"), "--quiet"});
    INFO(inspected.error);
    REQUIRE(inspected.exit_code == 0);
    return Json::parse(read_text(path("inspect.json"))).at("rows").at(0);
  }

  // The asset of a bake that starts from another file is named after the generation of that file, because it
  // changes with it.
  Line line_of(const Bake& bake) {
    const Json row = run(bake);
    const int generation = generation_[bake.output] = row.at("bake_generation");
    std::string asset = bake.asset;
    if (!bake.base.empty()) asset += "@" + std::to_string(generation_.at(bake.base));
    return {row.at("bake_kind"), asset, generation, hash_of_results(read_text(path(bake.output)))};
  }

 private:
  TestFolder folder_;
  std::map<std::string, int> generation_;  // by output
};

Bake character(const Bakes& bakes, const std::string& asset, const std::string& file,
               const Names& more = {}) {
  Names command{"character",
                bakes.path(file),
                "--preset",
                "draft",
                "--auto-poses",
                "12",
                "--samples-per-clip",
                "3",
                "--rays",
                "4",
                "--steps",
                "20",
                "--spheres",
                "6",
                "--key-points",
                "20"};
  command.insert(command.end(), more.begin(), more.end());
  return {asset, command, asset + ".nook"};
}

// Small bakes of every kind. Those behind the first need its file.
std::vector<Bake> all_bakes(const Bakes& in) {
  const std::string tube = in.path("tube.glb"), model = in.path("tube.nook");
  std::vector<Bake> bakes{
      character(in, "tube", "tube.glb"),
      {"tube", {"lod", model, tube, "--auto-poses", "8", "--rays", "4"}, "lod.nook", "tube.nook"},
      {"tube", {"bent", tube, model, "--auto-poses", "8", "--rays", "4"}, "bent.nook", "tube.nook"},
      {"tube", {"clips", tube, model, "--rays", "4", "--frames-per-second", "8"}, "clips.nook", "tube.nook"},
      {"tube",
       {"character", tube, "--model", model, "--calibrate", in.path("poses.bin"), "--rays", "8"},
       "calibrated.nook",
       "tube.nook"},
      // People have roles of bones and limits of joints, which a tube lacks.
      character(in, "person", "person.glb"),
      {"sky", {"probe", in.path("sky.hdr"), "--samples", "2048"}, "probe.nook"},
      {"still",
       {"probe", in.path("still.glb"), "--grid", "2x2x2", "--light", in.path("sky.hdr"), "--box",
        "-1,0.5,-1,1,2,1", "--samples", "256"},
       "grid.nook"},
      {"weave",
       {"material", "--meso", "weave", "--directions", "12", "--texels", "16", "--bounces", "0", "--view-map",
        "8"},
       "weave.nook"},
      {"fiber-neural",
       {"material", "--meso", "fiber", "--directions", "12", "--texels", "12", "--detail", "0.3",
        "--bounce-rays", "8", "--method", "neural", "--channels", "8", "--steps", "30"},
       "neural.nook"},
      {"weave", {"synthesis", in.path("weave.nook"), "--size", "64"}, "plane.nook", "weave.nook"},
      {"ball", {"transfer", in.path("ball.glb"), "--lobes", "42", "--ray-side", "8"}, "ball.nook"}};
  return bakes;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Why the bytes of this build cannot be compared with the list; nothing if they can.
std::string reason_to_skip(const Bakes& bakes) {
  constexpr const char* build = "Release";
  if (std::strcmp(NOOK_BUILD, build) != 0)
    return std::string("the build is \"") + NOOK_BUILD + "\", need " + build + " without further flags";
  if (std::string(gnu_get_libc_version()) != "2.36")
    return std::string("the C library is ") + gnu_get_libc_version() + ", need 2.36";
  // Embree starts its reciprocals from an approximation of the processor, and vendors approximate
  // differently.
  if (!has(read_text("/proc/cpuinfo"), "GenuineIntel")) return "the processor is not by Intel";
  const ToolRun run = bakes.folder().run({"bake", "probe", bakes.path("sky.hdr"), "-o", bakes.path("x.nook"),
                                          "--print-key", "--isa", "x86-64-v3"});
  if (has(run.error, "this processor lacks")) return "this processor lacks x86-64-v3";
  const Json row = bakes.run({"", {"probe", bakes.path("sky.hdr"), "--samples", "64"}, "x.nook"});
  for (const auto& [name, pinned] :
       {std::pair("bake_compiler", "gcc 12.2.0"), std::pair("bake_embree", "3.13.5")})
    if (row.at(name) != pinned)
      return "the tool was made with " + row.at(name).get<std::string>() + ", need " + pinned;
  return "";
}

}  // namespace

TEST_CASE("the list of golden bytes has rising generations") {
  const std::vector<Line> list = lines_of(read_text(NOOK_GOLDEN_BYTES));
  REQUIRE_FALSE(list.empty());
  std::vector<Line> seen;
  for (const Line& line : list) {
    CAPTURE(text_of(line));
    CHECK(is_missing(seen, line));
    seen.push_back(line);
  }
}

TEST_CASE("other bytes ask for a new generation, and a new generation for a line") {
  const std::vector<Line> list{{"lod", "tube", 1, "aa"}, {"lod", "tube", 3, "bb"}, {"bent", "tube", 1, "cc"}};
  CHECK(problem_of(list, {"lod", "tube", 3, "bb"}).empty());
  const std::string other = problem_of(list, {"lod", "tube", 3, "dd"});
  CHECK(has(other, "raise the generation of lod in bakers/job/bake_identity.cpp to 4"));
  CHECK(has(other, "append to golden_bytes.txt: lod tube 4 dd"));
  // The bytes of an earlier generation do not count.
  CHECK(has(problem_of(list, {"lod", "tube", 3, "aa"}), "raise the generation"));
  CHECK(has(problem_of(list, {"lod", "tube", 4, "dd"}), "append to golden_bytes.txt: lod tube 4 dd"));
  CHECK(has(problem_of(list, {"lod", "ball", 1, "dd"}), "append to golden_bytes.txt: lod ball 1 dd"));
  CHECK(has(problem_of(list, {"lod", "tube", 2, "bb"}), "only rise"));
  CHECK_FALSE(is_missing(list, {"lod", "tube", 3, "dd"}));
  CHECK(is_missing(list, {"lod", "tube", 4, "dd"}));
}

TEST_CASE("bakes have the bytes of their generation") {
  Bakes bakes;
  const std::string skipped = reason_to_skip(bakes);
  if (!skipped.empty()) {
    std::cout << "golden bytes: skipped, " << skipped << std::endl;
    return;
  }
  const std::vector<Line> list = lines_of(read_text(NOOK_GOLDEN_BYTES));
  const bool blesses = std::getenv("NOOK_BLESS") != nullptr;
  for (const Bake& bake : all_bakes(bakes)) {
    if (bake.output == "calibrated.nook")
      write_text(bakes.path("poses.bin"), recorded_poses(read_text(bakes.path("tube.nook"))));
    const Line line = bakes.line_of(bake);
    if (blesses && is_missing(list, line)) {
      std::ofstream(NOOK_GOLDEN_BYTES, std::ios::app) << text_of(line) << '\n';
      std::cout << text_of(line) << std::endl;
      continue;
    }
    INFO(problem_of(list, line));
    CHECK(problem_of(list, line).empty());
  }
}
