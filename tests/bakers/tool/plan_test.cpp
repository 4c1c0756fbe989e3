// nook plan, nook build and nook task: which bakes run after which change, and what a manifest may not say.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"
#include "tests/transfer/shapes.h"

namespace {

namespace fs = std::filesystem;
namespace shapes = nook::transfer::test;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

// Options with which a bake takes a second.
const Json small = {{"preset", "draft"}, {"auto-poses", 30}, {"samples-per-clip", 5}, {"rays", 4},
                    {"steps", 30},       {"spheres", 6},     {"key-points", 20}};
const Json small_part = {{"auto-poses", 8}, {"samples-per-clip", 2}, {"rays", 4}};

// A folder with a manifest. Its name has spaces, as all test folders'.
struct Project {
  TestFolder folder;
  std::string manifest = folder.path("nook.json");

  explicit Project(const Json& rules) {
    setenv("NOOK_ISA", "native", 1);  // the tests need no AVX2
    write(Json{{"rules", rules}});
  }
  ~Project() { unsetenv("NOOK_ISA"); }
  void write(const Json& json) const { write_text(manifest, json.dump(1)); }
  void write_file(const std::string& name, const std::string& bytes) const {
    fs::create_directories(fs::path(folder.path(name)).parent_path());
    write_text(folder.path(name), bytes);
  }
  ToolRun plan(const Names& more = {}) const { return run("plan", more); }
  ToolRun build(const Names& more = {}) const { return run("build", more); }
  std::string tasks() const { return read_text(folder.path("nook-build/tasks.txt")); }

 private:
  ToolRun run(const std::string& command, const Names& more) const {
    Names words{command, manifest};
    words.insert(words.end(), more.begin(), more.end());
    return folder.run(words);
  }
};

void require_done(const ToolRun& run) {
  INFO(run.out);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
}

// The outputs that a build writes anew.
Names baked_by(const Project& project, const ToolRun& run) {
  require_done(run);
  Names baked;
  for (std::size_t at = 0; (at = run.out.find("bake ", at)) != std::string::npos; ++at) {
    const std::size_t name = run.out.find(' ', at + 5) + 1;
    baked.push_back(run.out.substr(name, run.out.find(':', name) - name));
  }
  for (const std::string& output : baked) CHECK(fs::exists(project.folder.path(output)));
  return baked;
}

bool has_ninja() {
  return std::system("command -v ninja >/dev/null 2>&1") == 0;
}

}  // namespace

TEST_CASE("a build bakes what changed and nothing else") {
  if (!has_ninja()) return;
  const Project project(Json::array({{{"match", "characters/**/*.glb"},
                                      {"options", small},
                                      {"lods", {{"match", "{dir}/{stem}_LOD*.glb"}, {"options", small_part}}},
                                      {"bent", {{"options", small_part}}}}}));
  project.write_file("characters/it's a hero.glb", glb_tube({"bend", "wave"}));
  project.write_file("characters/it's a hero_LOD1.glb", glb_tube({"bend", "wave"}));
  project.write_file("characters/crowd/extra.glb", glb_tube({"bend"}));
  const std::string hero = "baked/characters/it's a hero.nook",
                    lod = "baked/characters/it's a hero_LOD1.nook",
                    bent = "baked/characters/it's a hero.bent.nook";
  const ToolRun dry = project.plan({"--dry-run"});
  require_done(dry);
  CHECK(has(dry.out, hero + ": new"));
  CHECK(has(dry.out, lod + ": after " + hero));
  CHECK_FALSE(fs::exists(project.folder.path("nook-build")));
  CHECK_FALSE(fs::exists(project.folder.path("baked")));

  CHECK(baked_by(project, project.build()).size() == 5);
  CHECK(fs::exists(project.folder.path("baked/characters/it's a hero.json")));
  CHECK(baked_by(project, project.build()).empty());
  CHECK(project.tasks().empty());

  // Bytes that no bake of a character reads.
  const Names unread{"characters/notes.txt", "characters/it's a hero.png"};
  for (const std::string& name : unread) project.write_file(name, "unread");
  CHECK(baked_by(project, project.build()).empty());
  // A clip of one character.
  project.write_file("characters/crowd/extra.glb", glb_tube({"bend", "wave"}));
  const ToolRun clip = project.build();
  CHECK(has(clip.out, "extra.nook: input changed: characters/crowd/extra.glb"));
  CHECK(baked_by(project, clip) ==
        Names{"baked/characters/crowd/extra.nook", "baked/characters/crowd/extra.bent.nook"});
  // An option.
  project.write({{"rules",
                  {{{"match", "characters/**/*.glb"},
                    {"options", small},
                    {"lods", {{"match", "{dir}/{stem}_LOD*.glb"}, {"options", small_part}}},
                    {"bent", {{"options", small_part}}}},
                   {{"match", "characters/it*.glb"}, {"bent", {{"options", {{"rays", 5}}}}}}}}});
  const ToolRun option = project.build();
  CHECK(has(option.out, bent + ": options changed: rays"));
  CHECK(baked_by(project, option) == Names{bent});
  // A new preset bakes the body, and what starts from it.
  fs::remove(project.folder.path(lod));
  const ToolRun gone = project.build();
  CHECK(has(gone.out, lod + ": its output no longer exists"));
  CHECK(baked_by(project, gone) == Names{lod});
}

TEST_CASE("Ninja alone plans again when an asset changes") {
  if (!has_ninja()) return;
  const Project project(Json::array({{{"match", "*.glb"}, {"options", small}}}));
  project.write_file("a b.glb", glb_tube({"bend"}));
  project.write_file("c$d.glb", glb_tube({"bend"}));
  require_done(project.plan());
  const auto ninja = [&] {
    const ToolRun run =
        project.folder.run_program("/usr/bin/env", {"ninja", "-C", project.folder.path("nook-build")});
    require_done(run);
    return run.out;
  };
  CHECK(has(ninja(), "2/2"));
  ninja();  // the folder of the outputs is new
  CHECK(has(ninja(), "no work to do"));
  const std::string before = read_text(project.folder.path("baked/a b.nook"));
  project.write_file("a b.glb", glb_tube({"bend", "wave"}));
  const std::string again = ninja();
  CHECK(has(again, "baked/a b.nook"));
  CHECK_FALSE(has(again, "baked/c$d.nook"));
  CHECK(read_text(project.folder.path("baked/a b.nook")) != before);
  // A new file in a folder that a pattern searches.
  project.write_file("e.glb", glb_tube({"bend"}));
  CHECK(has(ninja(), "baked/e.nook"));
}

TEST_CASE("a fresh checkout takes everything from the cache, and outputs that are there count") {
  if (!has_ninja()) return;
  const Project project(
      Json::array({{{"match", "*.glb"}, {"options", small}, {"bent", {{"options", small_part}}}}}));
  for (const char* name : {"a.glb", "b.glb"}) project.write_file(name, glb_tube({"bend"}));
  const Names cache{"--cache", project.folder.path("cache")};
  require_done(project.build(cache));
  const std::string model = read_text(project.folder.path("baked/a.bent.nook")),
                    report = read_text(project.folder.path("baked/a.bent.json"));
  fs::remove_all(project.folder.path("nook-build"));
  fs::remove_all(project.folder.path("baked"));
  for (const char* name : {"a.glb", "b.glb"})
    fs::last_write_time(project.folder.path(name), fs::file_time_type::clock::now());
  const ToolRun fresh = project.build(cache);
  CHECK(baked_by(project, fresh).empty());
  CHECK(has(fresh.out, "4 from the cache"));
  CHECK(read_text(project.folder.path("baked/a.bent.nook")) == model);
  CHECK(read_text(project.folder.path("baked/a.bent.json")) == report);
  // Without the cache, outputs whose recipes have the right keys count, in any order of their times.
  fs::remove_all(project.folder.path("nook-build"));
  fs::last_write_time(project.folder.path("baked/a.nook"), fs::file_time_type::clock::now());
  const ToolRun kept = project.build();
  CHECK(has(kept.out, "4 up to date"));
  CHECK(baked_by(project, kept).empty());
  const ToolRun ninja =
      project.folder.run_program("/usr/bin/env", {"ninja", "-C", project.folder.path("nook-build")});
  CHECK(has(ninja.out, "no work to do"));
}

TEST_CASE("tasks are one line for each character, the longest first, and run in a shell") {
  const Project project(
      Json::array({{{"match", "*.glb"}, {"options", small}, {"bent", {{"options", small_part}}}},
                   {{"match", "z*.glb"}, {"options", {{"preset", "production"}}}, {"bent", nullptr}},
                   {{"match", "skipped*"}, {"skip", true}}}));
  for (const char* name : {"it's \"one\".glb", "z.glb", "skipped.glb"})
    project.write_file(name, glb_tube({"bend"}));
  require_done(project.plan({"--report", project.folder.path("plan.json")}));
  const std::string tasks = project.tasks();
  CHECK(count_of(tasks, "\n") == 2);
  CHECK(tasks.find("z.glb") < tasks.find("one"));
  CHECK(count_of(tasks, "skipped") == 0);
  CHECK(count_of(tasks, " bake bent ") == 1);
  const Json rows = Json::parse(read_text(project.folder.path("plan.json"))).at("rows");
  CHECK(rows.size() == 3);
  CHECK(rows.at(0).at("state") == "missing");
  const std::string line = tasks.substr(tasks.find('\n') + 1);
  require_done(project.folder.run_program("/bin/bash", {"-c", line}));
  CHECK(fs::exists(project.folder.path("baked/it's \"one\".bent.nook")));
  CHECK(has(read_text(project.folder.path("nook-build/logs/baked/it's \"one\".nook.log")), "exit code 0"));
  require_done(project.plan());
  CHECK(count_of(project.tasks(), "\n") == 1);
}

TEST_CASE("probes, materials and transfer are baked by their rules, and again only after a change") {
  if (!has_ninja()) return;
  const Project project(Json::array(
      {{{"match", "skies/*.hdr"}, {"bake", "probe"}, {"options", {{"samples", 2048}}}},
       {{"match", "tiles/*.glb"},
        {"bake", "material"},
        {"input", "meso"},
        {"output", "materials/{stem}.nook"},
        {"options", {{"directions", 12}, {"texels", 12}, {"bounces", 0}, {"view-map", 8}, {"tile-size", 1}}}},
       {{"match", "props/*.glb"}, {"bake", "transfer"}, {"options", {{"lobes", 42}, {"ray-side", 8}}}}}));
  const auto glb = [](const shapes::Shape& shape) {
    const std::vector<std::byte> bytes = shapes::glb_of(shape);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  project.write_file("skies/noon.hdr", rgbe_map(32, 16));
  shapes::Shape floor = shapes::plane(1, 8, 1);
  shapes::append(floor, shapes::ball({0, 0.1f, 0}, 0.2f, 12));
  project.write_file("tiles/floor.glb", glb(floor));
  project.write_file("props/ball.glb", glb(shapes::ball({0, 0.25f, 0}, 0.2f, 12)));
  const Names outputs{"baked/skies/noon.nook", "materials/floor.nook", "baked/props/ball.nook"};
  CHECK(baked_by(project, project.build()).size() == outputs.size());
  for (const std::string& output : outputs) {
    INFO(output);
    const ToolRun inspected = project.folder.run({"inspect", project.folder.path(output)});
    CHECK(inspected.exit_code == 0);
    CHECK(has(inspected.out, "key"));
  }
  CHECK(baked_by(project, project.build()).empty());
  project.write_file("props/ball.glb", glb(shapes::ball({0, 0.25f, 0}, 0.3f, 12)));
  CHECK(baked_by(project, project.build()) == Names{"baked/props/ball.nook"});
  project.write_file("skies/noon.hdr", rgbe_map(64, 32));
  CHECK(baked_by(project, project.build()) == Names{"baked/skies/noon.nook"});
}

TEST_CASE("one failure does not stop the others, and the exit code says so") {
  if (!has_ninja()) return;
  const Project project(Json::array({{{"match", "*.glb"}, {"options", small}}}));
  project.write_file("bad.glb", "not a character");
  project.write_file("good.glb", glb_tube({"bend"}));
  const ToolRun run = project.build();
  CHECK(run.exit_code == 1);
  CHECK(has(run.out, "baked/bad.nook: bad.glb"));
  CHECK(has(run.error, "1 of 2 bakes failed"));
  CHECK(fs::exists(project.folder.path("baked/good.nook")));
  // Exit code 3 is not repeated.
  const std::string log = read_text(project.folder.path("nook-build/logs/baked/bad.nook.log"));
  CHECK(count_of(log, "exit code 3") == 1);
  fs::remove(project.folder.path("bad.glb"));
  CHECK(project.build().exit_code == 0);
}

TEST_CASE("a manifest with a fault is refused at its place, before anything runs") {
  const Project project(Json::array());
  project.write_file("a.glb", glb_tube({"bend"}));
  project.write_file("b/a.glb", glb_tube({"bend"}));
  const auto refused = [&](const std::string& text, const Names& parts) {
    write_text(project.manifest, text);
    const ToolRun run = project.plan();
    CAPTURE(text, run.error);
    CHECK(run.exit_code == 3);
    CHECK(has(run.error, "nook.json: "));
    CHECK(count_of(run.error, "\n") == 1);
    for (const std::string& part : parts) CHECK(has(run.error, part));
    CHECK_FALSE(fs::exists(project.folder.path("nook-build")));
  };
  refused("{\"rules\": [\n  {\"match\": }]}", {"line 2, column 13"});
  refused(R"({"rules": [{"match": "a.glb", "match": "a.glb"}]})", {"\"match\" twice"});
  refused(R"([])", {"needs an object"});
  refused(R"({"rule": []})", {"no key \"rule\"", "rules"});
  refused(R"({"rules": []})", {"at least one rule"});
  refused(R"({"rules": [{"options": {}}]})", {"rules[0]", "match"});
  refused(R"({"rules": [{"match": "*.glb", "preset": "draft"}]})", {"rules[0]", "\"preset\"", "\"options\""});
  refused(R"({"rules": [{"match": "*.glb", "bake": "cake"}]})", {"rules[0].bake", "cake", "character"});
  refused(R"({"rules": [{"match": "*.fbx"}]})", {"rules[0].match", "*.fbx", "matches no file"});
  refused(R"({"rules": [{"match": "../*.glb"}]})", {"rules[0].match", "below the manifest's folder"});
  refused(R"({"rules": [{"match": "/tmp/*.glb"}]})", {"rules[0].match", "below the manifest's folder"});
  refused(R"({"rules": [{"match": "*.glb", "output": "../{stem}.nook"}]})", {"rules[0].output"});
  refused(R"({"rules": [{"match": "*.glb", "output": "{stem}.bin"}]})", {"rules[0].output", ".nook"});
  refused(R"({"rules": [{"match": "*.glb", "output": "{name}.nook"}]})", {"{dir} and {stem}"});
  refused(R"({"rules": [{"match": "**/*.glb", "output": "{stem}.nook"}]})",
          {"a.glb", "b/a.glb", "the same output", "a.nook"});
  refused(R"({"rules": [{"match": "*.glb", "options": {"prest": "draft"}}]})",
          {"rules[0].options.prest", "nook bake character --help"});
  refused(R"({"rules": [{"match": "*.glb", "options": {"rays": 0}}]})", {"rules[0].options.rays"});
  refused(R"({"rules": [{"match": "*.glb", "options": {"rays": {}}}]})", {"rules[0].options.rays"});
  refused(R"({"rules": [{"match": "*.glb", "options": {"output": "x.nook"}}]})", {"sets this option"});
  refused(R"({"rules": [{"match": "*.glb", "bent": {"options": {"gamma": 1}}}]})",
          {"rules[0].bent.options.gamma"});
  refused(R"({"rules": [{"match": "*.glb", "options": {"rig": "../rig.json"}}]})",
          {"outside the manifest's folder"});
  refused(R"({"rules": [{"match": "*.glb", "lods": {"match": "{stem}_LOD*.glb"}}]})",
          {"matches no file of any"});
  refused(R"({"rules": [{"match": "*.glb", "skip": true}]})", {"the rules skip every file"});
  refused(R"({"rules": [{"match": "*.glb", "output": "x\n.nook"}]})", {"line break"});
  // A body that its own LOD is baked from.
  refused(
      R"({"rules": [{"match": "a.glb", "output": "a.nook", "options": {"calibrate": "p", "model": "b.nook"}},
                        {"match": "b/a.glb", "output": "b.nook", "options": {"calibrate": "p", "model": "a.nook"}}]})",
      {"circle", "a.nook needs b.nook needs a.nook"});
  project.write_file("c\nd.glb", "");
  refused(R"({"rules": [{"match": "*.glb"}]})", {"line break"});
}

TEST_CASE("a task repeats what may pass, keeps one log, and gives the exit code") {
  const TestFolder folder;
  write_text(folder.path("bad.glb"), "not a character");
  const std::string log = folder.path("logs/a task.log");
  const auto task = [&](const Names& words, const Names& options = {}) {
    Names all{"task", "--log", log};
    all.insert(all.end(), options.begin(), options.end());
    all.push_back("--");
    all.insert(all.end(), words.begin(), words.end());
    return folder.run(all);
  };
  CHECK(task({"inspect", folder.path("bad.glb")}).exit_code == 3);
  CHECK(count_of(read_text(log), "attempt") == 1);
  CHECK(task({"bake", "character", "--no-such-option"}).exit_code == 2);
  CHECK(count_of(read_text(log), "attempt") == 1);
  // A report that cannot be written is exit code 1, which may pass.
  write_text(folder.path("a.glb"), glb_tube({"bend"}));
  const Names full{"inspect", folder.path("a.glb"), "--report", folder.path("no folder/x.json")};
  const ToolRun again = task(full, {"--retries", "1"});
  CHECK(again.exit_code == 1);
  CHECK(has(again.error, "cannot be written"));
  CHECK(count_of(read_text(log), "attempt") == 2);
  CHECK(task({"inspect", folder.path("a.glb"), "--quiet"}).exit_code == 0);
  CHECK(has(read_text(log), "exit code 0"));
  CHECK(task({"task", "--", "inspect"}).exit_code == 2);
  const ToolRun without = folder.run({"task", "bake", "character", "a.glb", "-o", "a.nook", "--rays=4"});
  CHECK(without.exit_code == 2);
  CHECK(has(without.error, "is not an option of nook task; put -- before the command"));
}

TEST_CASE("a task that is told to stop stops its bake, and its log can be read") {
  const TestFolder folder;
  write_text(folder.path("a.glb"), glb_tube({"bend"}));
  const std::string log = folder.path("task.log"), out = folder.path("a.nook");
  const int child =
      folder.start({"task", "--log", log, "--", "bake", "character", folder.path("a.glb"), "-o", out,
                    "--preset", "draft", "--auto-poses", "30", "--rays", "4", "--steps", "10000000"});
  for (int waits = 0; waits < 3000 && !has(read_text(log), "fitting"); ++waits) usleep(20000);
  kill(child, SIGTERM);
  const ToolRun run = folder.finish(child);
  CHECK(run.exit_code == 1);
  CHECK(has(read_text(log), "stopped; nothing was written"));
  CHECK(count_of(read_text(log), "attempt") == 1);
  CHECK_FALSE(fs::exists(out));
  CHECK(folder.names() == Names{"a.glb", "task.log"});
}
