// Files and streams as systems give them: closed, full, waiting, protected, linked, damaged. The tool is
// right, or its message names the fault; nothing of the user's is lost.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A bake of a tenth of a second.
Names small_probe(const TestFolder& folder, const std::string& out, const Names& more = {}) {
  if (!fs::exists(folder.path("map.hdr"))) write_text(folder.path("map.hdr"), rgbe_map(16, 8));
  Names arguments{"bake", "probe", folder.path("map.hdr"), "-o", out, "--samples", "64"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// Runs the tool by a shell, whose redirections come after its arguments.
ToolRun shell(const TestFolder& folder, const Names& arguments, const std::string& redirections) {
  Names words{"-c", "\"$0\" \"$@\" " + redirections, NOOK_TOOL};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return folder.run_program("/bin/sh", words);
}

unsigned mode_of(const std::string& path) {
  struct stat there;
  return stat(path.c_str(), &there) == 0 ? there.st_mode & 07777 : 0;
}

// A pipe by name that nobody has opened.
std::string fifo(const TestFolder& folder, const char* name) {
  REQUIRE(mkfifo(folder.path(name).c_str(), 0600) == 0);
  return folder.path(name);
}

// The tool says within 2 s that it waits, and the signal ends it. The bound has room for a busy machine; a
// wait that does not end stops the test by its own limit.
void check_wait(const TestFolder& folder, const Names& arguments, int signal, const char* what) {
  const auto began = std::chrono::steady_clock::now();
  const ToolRun run = folder.run_and_signal(arguments, signal, what);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - began;
  INFO(run.error);
  CHECK(run.exit_code == 1);
  CHECK(has(run.error, what));
  CHECK(has(run.error, "stopped"));
  CHECK(seconds.count() > 1.9);
  CHECK(seconds.count() < 60);
}

}  // namespace

TEST_CASE("a program without an error stream writes no message into its output") {
  const TestFolder folder;
  REQUIRE(folder.run(small_probe(folder, folder.path("right.nook"), {"--quiet"})).exit_code == 0);
  const std::string right = read_text(folder.path("right.nook"));
  for (const char* closed : {"2>&-", "2>&- <&-", "<&- 2>&- >&-", ">&-"}) {
    INFO(closed);
    const ToolRun run = shell(folder, small_probe(folder, folder.path("p.nook")), closed);
    INFO(run.error);
    CHECK(run.exit_code == 0);
    CHECK(read_text(folder.path("p.nook")) == right);
    fs::remove(folder.path("p.nook"));
  }
}

TEST_CASE("a result that has no output stream is an error, and one in a file is not") {
  const TestFolder folder;
  REQUIRE(folder.run(small_probe(folder, folder.path("p.nook"))).exit_code == 0);
  const std::string p = folder.path("p.nook"), report = folder.path("r.json");
  for (const Names& command : {Names{"inspect", p}, Names{"--help"}, Names{"--version"},
                               Names{"evaluate", "probe", folder.path("map.hdr"), "--seeds", "1"},
                               small_probe(folder, "/dev/stdout")}) {
    const ToolRun run = shell(folder, command, ">&-");
    INFO(command[0] << ": " << run.error);
    CHECK(run.exit_code == 1);
    CHECK(!run.error.empty());
  }
  CHECK(shell(folder, {"inspect", p, "--report", report}, ">&-").exit_code == 0);
  CHECK(has(read_text(report), "light probe"));
  CHECK(shell(folder, {"inspect", p, "--quiet"}, ">&-").exit_code == 0);
}

TEST_CASE("text that does not get out is an error for every writer") {
  if (access("/dev/full", W_OK) != 0) return;
  const TestFolder folder;
  REQUIRE(folder.run(small_probe(folder, folder.path("p.nook"))).exit_code == 0);
  const Names commands[] = {{"--help"},
                            {"--version"},
                            {"bake", "--help"},
                            {"bake", "character", "--help"},
                            {"inspect", folder.path("p.nook")},
                            {"evaluate", "probe", folder.path("map.hdr"), "--seeds", "1"},
                            small_probe(folder, folder.path("q.nook"))};
  for (const Names& command : commands) {
    const ToolRun run = shell(folder, command, "> /dev/full");
    INFO(command[0] << ": " << run.error);
    CHECK(run.exit_code == 1);
    CHECK(has(run.error, "output stream"));
  }
}

TEST_CASE("files of the user beside an output stay, whatever they are called") {
  const TestFolder folder;
  const Names own{"m.nook.part-00",        "m.nook.part-1",    "m.nook.part-999999999",
                  "m.nook.nook-part-1",    "m.nook.nook-part", "m.nook.nook-part-999999999",
                  "m.nook.nook-part-00-1", "m.nook.part",      "m.nook.tmp"};
  // The last one looks like a part of another process.
  for (const std::string& name : own) write_text(folder.path(name), "mine: " + name);
  write_text(folder.path("m.nook.nook-part-999999998"), "nook: an unfinished file of process 999999997");
  write_text(folder.path("m.nook"), "old");
  REQUIRE(folder.run(small_probe(folder, folder.path("m.nook"))).exit_code == 0);
  for (const std::string& name : own) CHECK(read_text(folder.path(name)) == "mine: " + name);
  CHECK(fs::exists(folder.path("m.nook.nook-part-999999998")));
  CHECK(read_text(folder.path("m.nook")).substr(0, 4) == "NOOK");
  CHECK(folder.names().size() == own.size() + 3);
}

TEST_CASE("a file that is replaced keeps its mode, and a new one follows the umask") {
  const TestFolder folder;
  for (const unsigned mode : {0600u, 0640u, 0755u, 0666u, 0200u}) {
    write_text(folder.path("m.nook"), "old");
    REQUIRE(chmod(folder.path("m.nook").c_str(), mode) == 0);
    REQUIRE(folder.run(small_probe(folder, folder.path("m.nook"), {"--report", folder.path("r.json")}))
                .exit_code == 0);
    CHECK(mode_of(folder.path("m.nook")) == mode);
    chmod(folder.path("m.nook").c_str(), 0600);
    CHECK(read_text(folder.path("m.nook")).substr(0, 4) == "NOOK");
  }
  const mode_t before = umask(027);
  REQUIRE(folder.run(small_probe(folder, folder.path("new.nook"))).exit_code == 0);
  umask(before);
  CHECK(mode_of(folder.path("new.nook")) == 0640);
  if (geteuid() != 0) return;
  REQUIRE(chown(folder.path("m.nook").c_str(), 1234, 2345) == 0);
  REQUIRE(folder.run(small_probe(folder, folder.path("m.nook"))).exit_code == 0);
  struct stat there;
  REQUIRE(stat(folder.path("m.nook").c_str(), &there) == 0);
  CHECK(there.st_uid == 1234);
  CHECK(there.st_gid == 2345);
}

TEST_CASE("the tool warns before it replaces a file that has other names") {
  const TestFolder folder;
  write_text(folder.path("m.nook"), "old");
  fs::create_symlink("m.nook", folder.path("link.nook"));
  const ToolRun linked = folder.run(small_probe(folder, folder.path("link.nook")));
  CHECK(linked.exit_code == 0);
  CHECK(has(linked.error, "the link is replaced by a file"));
  CHECK_FALSE(fs::is_symlink(folder.path("link.nook")));
  CHECK(read_text(folder.path("m.nook")) == "old");
  write_text(folder.path("m.nook"), "old");
  fs::create_hard_link(folder.path("m.nook"), folder.path("hard.nook"));
  const ToolRun hard = folder.run(small_probe(folder, folder.path("m.nook")));
  CHECK(hard.exit_code == 0);
  CHECK(has(hard.error, "2 names (hard links); the other names keep the old file"));
  CHECK(read_text(folder.path("hard.nook")) == "old");
  fs::remove(folder.path("link.nook"));
  fs::create_symlink("m.nook", folder.path("link.nook"));
  CHECK(folder.run(small_probe(folder, folder.path("link.nook"), {"--quiet"})).error.empty());
}

TEST_CASE("places that cannot be written are named before the work") {
  const TestFolder folder;
  write_text(folder.path("m.nook"), "kept");
  chmod(folder.path("m.nook").c_str(), 0444);
  fs::create_directory(folder.path("d"));
  const std::string long_name(300, 'x');
  struct Place {
    std::string path, words;
    int code;
  };
  const Place places[] = {{folder.path("m.nook"), "write-protected", 1},
                          {folder.path("d"), "it is a folder", 1},
                          {folder.path("d/"), "it is a folder", 1},
                          {folder.path("none/m.nook"), "No such file", 1},
                          {folder.path("m.nook/below"), "Not a directory", 1},
                          {folder.path(long_name), "File name too long", 1},
                          {"-", "/dev/stdout", 2},
                          {"", "empty", 2}};
  for (const Place& place : places) {
    const ToolRun run = folder.run(small_probe(folder, place.path));
    INFO(place.path << ": " << run.error);
    CHECK(run.exit_code == place.code);
    CHECK(has(run.error, place.words));
    CHECK_FALSE(has(run.error, "fitting"));
  }
  CHECK(read_text(folder.path("m.nook")) == "kept");
  CHECK(folder.names() == Names{"d", "m.nook", "map.hdr"});
  // A name as long as the system allows has no room for the end of a part's name.
  const std::string longest(255, 'y');
  CHECK(folder.run(small_probe(folder, folder.path(longest))).exit_code == 0);
  CHECK(read_text(folder.path(longest)).substr(0, 4) == "NOOK");
  CHECK(folder.names() == Names{"d", "m.nook", "map.hdr", longest});
  if (geteuid() == 0) return;
  chmod(folder.path("d").c_str(), 0555);
  CHECK(folder.run(small_probe(folder, folder.path("d/m.nook"))).exit_code == 1);
  chmod(folder.path("d").c_str(), 0755);
}

TEST_CASE("the tool says that it waits for a pipe, and signals end it") {
  const TestFolder folder;
  const std::string pipe = fifo(folder, "pipe"), report = fifo(folder, "report"),
                    map = fifo(folder, "in.hdr");
  const std::string reads = "waits for a program that reads it",
                    writes = "waits for a program that writes to it";
  SECTION("an output without a reader") {
    check_wait(folder, small_probe(folder, pipe), SIGTERM, reads.c_str());
    check_wait(folder, small_probe(folder, folder.path("p.nook"), {"--report", report, "--quiet"}), SIGINT,
               reads.c_str());
  }
  SECTION("an input without a writer") {
    check_wait(folder, {"bake", "probe", map, "-o", folder.path("p.nook")}, SIGTERM, writes.c_str());
    check_wait(folder, {"bake", "character", pipe, "-o", folder.path("p.nook"), "--quiet"}, SIGINT,
               writes.c_str());
    check_wait(folder, {"inspect", pipe}, SIGTERM, writes.c_str());
    check_wait(folder, {"evaluate", "probe", map}, SIGTERM, writes.c_str());
    check_wait(folder, {"bake", "material", "--relief", pipe, "--meso", "weave", "-o", folder.path("p.nook")},
               SIGTERM, writes.c_str());
  }
  SECTION("a writer that stops in the middle, and a reader that does not read") {
    const int writer = open(pipe.c_str(), O_RDWR | O_NONBLOCK);
    REQUIRE(write(writer, "NOOK", 4) == 4);
    check_wait(folder, {"inspect", pipe}, SIGTERM, writes.c_str());
    std::vector<char> filling(1 << 16, 'x');
    while (write(writer, filling.data(), filling.size()) > 0) {
    }
    check_wait(folder, small_probe(folder, pipe), SIGTERM, reads.c_str());
    close(writer);
  }
  CHECK_FALSE(fs::exists(folder.path("p.nook")));
  for (const std::string& name : folder.names()) CHECK_FALSE(has(name, "-part-"));
}

TEST_CASE("pipes bring inputs as files do") {
  const TestFolder folder;
  const std::string right = folder.path("right.nook"), out = folder.path("p.nook");
  REQUIRE(folder.run(small_probe(folder, right, {"--quiet"})).exit_code == 0);
  const std::string map = fifo(folder, "in.hdr");
  const int child = folder.start({"bake", "probe", map, "-o", out, "--samples", "64", "--quiet"});
  std::thread writer([&] {
    const int descriptor = open(map.c_str(), O_WRONLY);
    const std::string bytes = read_text(folder.path("map.hdr"));
    // In two pieces with a pause, as over a network.
    (void)!write(descriptor, bytes.data(), 100);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    (void)!write(descriptor, bytes.data() + 100, bytes.size() - 100);
    close(descriptor);
  });
  const ToolRun run = folder.finish(child);
  writer.join();
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  // The recipe has the name of the source.
  const ToolRun inspected = folder.run({"inspect", out});
  CHECK(has(inspected.out, "in.hdr"));
  CHECK(fs::file_size(out) + 1 == fs::file_size(right));  // "in.hdr" for "map.hdr"
  // The standard input as a pipe.
  const ToolRun piped =
      folder.run_program("/bin/sh", {"-c", "cat \"$1\" | \"$0\" inspect /dev/stdin", NOOK_TOOL, right});
  INFO(piped.error);
  CHECK(piped.exit_code == 0);
  CHECK(has(piped.out, "light probe"));
  // Messages name what the user named.
  const ToolRun wrong =
      folder.run_program("/bin/sh", {"-c", "echo wrong | \"$0\" inspect /dev/stdin", NOOK_TOOL});
  CHECK(wrong.exit_code == 3);
  CHECK(has(wrong.error, "nook: /dev/stdin: "));
}

TEST_CASE("sizes are checked before memory is taken") {
  const TestFolder folder;
  const std::string nook = folder.path("m.nook"), large = folder.path("large.nook");
  REQUIRE(folder.run(small_probe(folder, nook)).exit_code == 0);
  constexpr std::uintmax_t sparse = std::uintmax_t{40} << 30;
  // A .nook file that was extended, one that says its size, and something else.
  std::string head = read_text(nook);
  for (const bool honest : {false, true})
    for (const bool is_nook : {true, false}) {
      std::string bytes = is_nook ? head : std::string(1000, 'x');
      if (honest)
        for (int i = 0; i < 8; ++i) bytes[std::size_t(16 + i)] = char(sparse >> (8 * i) & 255);
      write_text(large, bytes);
      std::error_code no_sparse_files;
      fs::resize_file(large, sparse, no_sparse_files);
      if (no_sparse_files) return;
      for (const Names& command :
           {Names{"inspect", large}, Names{"export", "casters", large, "-o", folder.path("o")},
            Names{"bake", "material", "--raw", large, "-o", folder.path("o")}}) {
        const ToolRun run = folder.run(command);
        INFO(command[0] << ": " << run.error);
        CHECK(run.exit_code == 3);
        CHECK(has(run.error, large));
        CHECK_FALSE(has(run.error, "memory; use"));
      }
    }
  fs::remove(large);
  // One byte too few and too many.
  write_text(nook, head.substr(0, head.size() - 1));
  CHECK(has(folder.run({"inspect", nook}).error, "cut or extended"));
  write_text(nook, head + "x");
  CHECK(has(folder.run({"inspect", nook}).error, "cut or extended"));
}

TEST_CASE("commands are named where one is missing or lives in nook-lab") {
  const TestFolder folder;
  const auto error = [&](const Names& command) {
    const ToolRun run = folder.run(command);
    CHECK(run.exit_code == 2);
    return run.error;
  };
  CHECK(
      has(error({}), "need one of bake, evaluate, train, export, cache, plan, build, task, inspect, report"));
  CHECK(has(error({"bake"}), "need one of character, bent"));
  const std::string grid = error({"evaluate", "grid"});
  CHECK(has(grid, "there is no command grid"));
  CHECK(has(grid, "need one of character"));
  CHECK(has(grid, "nook-lab evaluate --help"));
  CHECK(has(error({"evaluate", "character", "a", "b", "--peers"}), "nook-lab evaluate character"));
  CHECK(has(error({"evaluate", "material", "a", "b", "--sweep=1,2"}), "nook-lab evaluate material"));
  CHECK(has(error({"evaluate", "nnao", "room.glb"}), "nook-lab evaluate nnao"));
  CHECK(has(error({"evaluate", "nnao", "--frame", "x", "--mover", "y"}), "nook-lab evaluate nnao"));
  CHECK_FALSE(has(error({"bake", "character", "a", "-o", "b", "--peers"}), "nook-lab"));
}
