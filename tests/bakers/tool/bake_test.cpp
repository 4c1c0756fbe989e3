#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

using Names = std::vector<std::string>;

// A bake of a second.
Names small_bake(const std::string& in, const std::string& out, const Names& more = {}) {
  Names arguments{"bake", "character",          in,  "-o",     out, "--preset", "draft", "--auto-poses",
                  "30",   "--samples-per-clip", "5", "--rays", "4", "--steps",  "30",    "--spheres",
                  "6",    "--key-points",       "20"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

// Writes a .glb file as a .gltf file and its buffer, which it names by `uri`.
void write_parts(const std::string& glb, const std::string& gltf, const std::string& buffer,
                 const std::string& uri) {
  constexpr std::size_t head = 12, chunk_head = 8;
  const std::size_t json = head + chunk_head, json_bytes = word_at(glb, head);
  auto document = nlohmann::json::parse(glb.substr(json, json_bytes));
  document["buffers"][0]["uri"] = uri;
  write_text(gltf, document.dump());
  write_text(buffer, glb.substr(json + json_bytes + chunk_head));
}

}  // namespace

TEST_CASE("bake writes the model and the report, and nothing else") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"bend", "wave", "T-Pose"}));
  const ToolRun run = folder.run(
      small_bake(folder.path("hero.glb"), folder.path("hero.nook"), {"--report", folder.path("r.json")}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(folder.names() == Names{"hero.glb", "hero.nook", "r.json"});
  CHECK(read_text(folder.path("hero.nook")).substr(0, 4) == "NOOK");
  CHECK(has(run.out, "mse_train"));
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  CHECK(report.at("clips") == Names{"bend", "wave"});  // the T-pose shows no motion
  // 30 automatic poses, five of each clip, and one variant of each of these; some are the same pose.
  CHECK(report.at("train_poses").get<int>() <= 50);
  // Off a terminal progress comes as plain lines.
  CHECK(has(run.error, "ray tracing: "));
  CHECK_FALSE(has(run.error, "\r"));
}

TEST_CASE("quiet says nothing, and the number of threads changes nothing") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"bend"}));
  const ToolRun one =
      folder.run(small_bake(folder.path("hero.glb"), folder.path("1.nook"), {"--quiet", "--threads", "1"}));
  const ToolRun two =
      folder.run(small_bake(folder.path("hero.glb"), folder.path("2.nook"), {"--quiet", "--threads", "2"}));
  REQUIRE(one.exit_code == 0);
  REQUIRE(two.exit_code == 0);
  CHECK(one.out.empty());
  CHECK(one.error.empty());
  CHECK(read_text(folder.path("1.nook")) == read_text(folder.path("2.nook")));
  const ToolRun other =
      folder.run(small_bake(folder.path("hero.glb"), folder.path("2.nook"), {"--quiet", "--seed", "7"}));
  REQUIRE(other.exit_code == 0);
  CHECK(read_text(folder.path("1.nook")) != read_text(folder.path("2.nook")));
}

TEST_CASE("half of the clips in byte order of their names") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"walk", "Run", "jump", "sit"}));
  const ToolRun run = folder.run(small_bake(folder.path("hero.glb"), folder.path("hero.nook"),
                                            {"--split", "half", "--report", folder.path("r.json")}));
  REQUIRE(run.exit_code == 0);
  // Capital letters come first in byte order.
  CHECK(nlohmann::json::parse(read_text(folder.path("r.json"))).at("clips") == Names{"Run", "sit"});
}

TEST_CASE("a family of clips is fitted whole or left whole") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"Jump", "JumpTwice", "Jump2", "Jump_Start", "sit"}));
  const ToolRun run = folder.run(small_bake(folder.path("hero.glb"), folder.path("hero.nook"),
                                            {"--split", "families", "--report", folder.path("r.json")}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(nlohmann::json::parse(read_text(folder.path("r.json"))).at("clips") ==
        Names{"Jump", "Jump2", "JumpTwice", "Jump_Start"});
}

TEST_CASE("bad arguments exit with 2, name the fault and write nothing") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"walk", "jump"}));
  const std::string in = folder.path("hero.glb"), out = folder.path("hero.nook");
  ToolRun run;
  std::string expected;
  SECTION("nothing") {
    run = folder.run({});
    expected = "a command is missing";
  }
  SECTION("no output") {
    run = folder.run({"bake", "character", in});
    expected = "--output";
  }
  SECTION("an unknown option") {
    run = folder.run(small_bake(in, out, {"--sphere", "3"}));
    expected = "--sphere";
  }
  SECTION("an unknown preset") {
    run = folder.run({"bake", "character", in, "-o", out, "--preset", "best"});
    expected = "best not in {draft,production,standard}";
  }
  SECTION("a number out of range") {
    run = folder.run(small_bake(in, out, {"--gamma", "0.5"}));
    expected = "--gamma";
  }
  SECTION("an unknown clip, with a list of those there are") {
    run = folder.run(small_bake(in, out, {"--clips", "jump,fly"}));
    expected = "no clip \"fly\"; the file has these:\n  jump\n  walk";
  }
  SECTION("clips that --poses does not use") {
    run = folder.run(small_bake(in, out, {"--clips", "jump", "--poses", "auto"}));
    expected = "uses no clips";
  }
  SECTION("clips of one family, split by families") {
    write_text(in, glb_tube({"Walk_Start", "WalkLoop", "walk2"}));
    run = folder.run(small_bake(in, out, {"--split", "families"}));
    expected = "all 3 clips begin with the same word";
  }
  SECTION("a negative seed") {
    run = folder.run(small_bake(in, out, {"--seed", "-1"}));
    expected = "--seed: \"-1\" is not a whole number from 0 to 18446744073709551615";
  }
  SECTION("a seed above 64 bits") {
    run = folder.run(small_bake(in, out, {"--seed", "18446744073709551616"}));
    expected = "\"18446744073709551616\" is not a whole number from 0 to 18446744073709551615";
  }
  SECTION("a negative number of threads: the message has the range of the option, not of its type") {
    run = folder.run(small_bake(in, out, {"--threads", "-1"}));
    expected = "--threads: \"-1\" is not a whole number from 0 to 1024";
  }
  SECTION("a number of rays that is not whole") {
    run = folder.run(small_bake(in, out, {"--rays", "1.5"}));
    expected = "--rays: \"1.5\" is not a whole number from 1 to 65536";
  }
  INFO(run.error);
  CHECK(run.exit_code == 2);
  CHECK(has(run.error, expected));
  CHECK(folder.names() == Names{"hero.glb"});
}

TEST_CASE("files outside of the folder of a .gltf file are read where they are allowed") {
  const TestFolder folder;
  std::filesystem::create_directory(folder.path("scene"));
  const std::string in = folder.path("scene/hero.gltf"), out = folder.path("hero.nook");
  write_parts(glb_tube({"bend"}), in, folder.path("hero.bin"), "../hero.bin");
  const ToolRun refused = folder.run(small_bake(in, out));
  CHECK(refused.exit_code == 3);
  CHECK(has(refused.error, "hero.bin\", which is outside the folder of this file"));
  const ToolRun baked = folder.run(small_bake(in, out, {"--allow-outside-files"}));
  INFO(baked.error);
  REQUIRE(baked.exit_code == 0);
  CHECK(folder.run({"evaluate", "character", in, out, "--rays", "4"}).exit_code == 3);
  const ToolRun measured =
      folder.run({"evaluate", "character", in, out, "--rays", "4", "--allow-outside-files"});
  INFO(measured.error);
  CHECK(measured.exit_code == 0);
}

TEST_CASE("bad input exits with 3, names the file and writes nothing") {
  const TestFolder folder;
  const std::string in = folder.path("bad.glb"), out = folder.path("bad.nook");
  const std::string good = glb_tube({"walk"});
  Names left{"bad.glb"};
  SECTION("no such file") {
    left.clear();
  }
  SECTION("no glTF at all") {
    write_text(in, "This is a text, and no character at all.");
  }
  SECTION("empty") {
    write_text(in, "");
  }
  SECTION("truncated") {
    write_text(in, good.substr(0, good.size() - 400));
  }
  const ToolRun run = folder.run(small_bake(in, out));
  INFO(run.error);
  CHECK(run.exit_code == 3);
  CHECK(has(run.error, "bad.glb: "));
  CHECK(folder.names() == left);
}

TEST_CASE("a place that cannot be written is found before the bake") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({}));
  const ToolRun run = folder.run(small_bake(folder.path("hero.glb"), folder.path("nowhere/hero.nook")));
  CHECK(run.exit_code == 1);
  CHECK(has(run.error, "nowhere/hero.nook: cannot be written"));
  CHECK_FALSE(has(run.error, "ray tracing"));
}

TEST_CASE("an interrupt stops cleanly and an older file stays as it was") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({}));
  write_text(folder.path("hero.nook"), "older");
  // Minutes of work: whenever the signal comes, it comes before the end.
  const Names arguments{"bake",    "character", folder.path("hero.glb"), "-o",   folder.path("hero.nook"),
                        "--poses", "auto",      "--auto-poses",          "2000", "--rays",
                        "65536",   "--report",  folder.path("r.json")};
  const ToolRun run = folder.run_and_signal(arguments, SIGINT, "ray tracing");
  CHECK(run.exit_code == 1);
  CHECK(has(run.error, "stopped; nothing was written"));
  CHECK(read_text(folder.path("hero.nook")) == "older");
  CHECK(folder.names() == Names{"hero.glb", "hero.nook"});
}

TEST_CASE("the rational kernel is not an option of a bake") {
  const TestFolder folder;
  const ToolRun run =
      folder.run({"bake", "character", "hero.glb", "-o", folder.path("hero.nook"), "--kernel", "rational"});
  CHECK(run.exit_code == 2);
  CHECK(has(run.error, "--kernel"));
  CHECK(has(run.error, "paper"));
}

TEST_CASE("help names the options and exits with 0") {
  const TestFolder folder;
  const ToolRun run = folder.run({"bake", "character", "--help"});
  CHECK(run.exit_code == 0);
  for (const char* option :
       {"--preset", "--spheres", "--key-points", "--poses", "--clips", "--split", "--rays", "--form",
        "--kernel", "--gamma", "--fit", "--time-limit", "--threads", "--seed", "--report", "--quiet"})
    CHECK(has(run.out, option));
  CHECK(folder.run({"--version"}).out == NOOK_VERSION_TEXT "\n");
}

TEST_CASE("bake lod: a model for another mesh of the same rig, and an error for another skeleton") {
  const TestFolder folder;
  write_text(folder.path("tube.glb"), glb_tube({"bend"}));
  const ToolRun full =
      folder.run({"bake", "character", folder.path("tube.glb"), "-o", folder.path("full.nook"), "--preset",
                  "draft", "--steps", "20", "--rays", "8", "--auto-poses", "8", "--quiet"});
  INFO(full.error);
  REQUIRE(full.exit_code == 0);
  const ToolRun lod = folder.run({"bake", "lod", folder.path("full.nook"), folder.path("tube.glb"), "-o",
                                  folder.path("lod.nook"), "--auto-poses", "8", "--rays", "8"});
  INFO(lod.error);
  REQUIRE(lod.exit_code == 0);
  CHECK(lod.out.find("vertices_full") != std::string::npos);
  CHECK(folder.run({"inspect", folder.path("lod.nook")}).exit_code == 0);

  const ToolRun no_model = folder.run(
      {"bake", "lod", folder.path("tube.glb"), folder.path("tube.glb"), "-o", folder.path("other.nook")});
  CHECK(no_model.exit_code != 0);
  CHECK(no_model.error.find("tube.glb") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.path("other.nook")));
}
