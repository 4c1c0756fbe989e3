// Where the tool writes: what an output names is never lost, and nothing is left behind.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

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

// A network of a second, or one that is trained until it is stopped. It needs no input.
Names training(const std::string& out, const std::string& epochs) {
  return {"train",    "nnao", "-o",     out, "--scenes", "48",   "--views", "48",
          "--points", "8",    "--rays", "8", "--epochs", epochs, "--batch", "16"};
}

Names small_training(const std::string& out, const Names& more = {}) {
  Names arguments = training(out, "2");
  arguments.push_back("--quiet");
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// A bake of a tenth of a second.
Names small_probe(const TestFolder& folder, const std::string& out, const Names& more = {}) {
  if (!fs::exists(folder.path("map.hdr"))) write_text(folder.path("map.hdr"), rgbe_map(16, 8));
  Names arguments{"bake", "probe", folder.path("map.hdr"), "-o", out, "--samples", "64", "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// A memory device (null: 3, full: 7) of the test's own: a fault in the tool must not cost the machine its
// /dev/null. False where only root, or nobody, can have one.
bool make_device(const std::string& path, unsigned minor) {
  if (mknod(path.c_str(), S_IFCHR | 0666, makedev(1, minor)) != 0) return false;
  const int device = open(path.c_str(), O_WRONLY);
  if (device >= 0) close(device);
  return device >= 0;
}

// A pipe by name, held open at both ends, so that nobody waits for anybody. What the tool writes here fits
// into its buffer.
class Pipe {
 public:
  explicit Pipe(const std::string& path) {
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    descriptor_ = open(path.c_str(), O_RDWR | O_NONBLOCK);
    REQUIRE(descriptor_ >= 0);
  }
  ~Pipe() { close(descriptor_); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  // Reads the bytes that a writer has left in the pipe.
  std::string text() const {
    std::string text(65536, '\0');
    const ssize_t size = read(descriptor_, text.data(), text.size());
    text.resize(size > 0 ? std::size_t(size) : 0);
    return text;
  }

 private:
  int descriptor_ = -1;
};

}  // namespace

TEST_CASE("pipes are written to and not replaced") {
  const TestFolder folder;
  const Pipe model(folder.path("model")), report(folder.path("report"));
  const ToolRun run =
      folder.run(small_probe(folder, folder.path("model"), {"--report", folder.path("report")}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(fs::is_fifo(folder.path("model")));
  CHECK(fs::is_fifo(folder.path("report")));
  CHECK(model.text().substr(0, 4) == "NOOK");
  CHECK(has(report.text(), "\"rows\""));
  CHECK(folder.names() == Names{"map.hdr", "model", "report"});
}

TEST_CASE("devices are written to and not replaced") {
  const TestFolder folder;
  if (!make_device(folder.path("null"), 3)) return;
  // Both may go there.
  const ToolRun run = folder.run(small_probe(folder, folder.path("null"), {"--report", folder.path("null")}));
  INFO(run.error);
  CHECK(run.exit_code == 0);
  CHECK(fs::is_character_file(folder.path("null")));
  const ToolRun trained = folder.run(small_training(folder.path("null")));
  INFO(trained.error);
  CHECK(trained.exit_code == 0);
  CHECK(fs::is_character_file(folder.path("null")));
  CHECK(folder.names() == Names{"map.hdr", "null"});
}

TEST_CASE("a device without space is an error") {
  const TestFolder folder;
  if (!make_device(folder.path("full"), 7)) return;
  const ToolRun run =
      folder.run(small_probe(folder, folder.path("p.nook"), {"--report", folder.path("full")}));
  CHECK(run.exit_code == 1);
  CHECK(has(run.error, folder.path("full")));
  REQUIRE(fs::is_character_file(folder.path("full")));
}

TEST_CASE("the output stream can be named as a file") {
  const TestFolder folder;
  // A link as /dev/stdout is one.
  fs::create_symlink("/proc/self/fd/1", folder.path("out"));
  const ToolRun run =
      folder.run(small_probe(folder, folder.path("p.nook"), {"--report", folder.path("out")}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(nlohmann::json::parse(run.out).contains("rows"));
  CHECK(fs::is_symlink(folder.path("out")));
}

TEST_CASE("a symbolic link is replaced, and what it points to stays") {
  const TestFolder folder;
  fs::create_directory(folder.path("far"));
  write_text(folder.path("far/model.nook"), "shared");
  REQUIRE(chmod(folder.path("far/model.nook").c_str(), 0444) == 0);
  fs::create_symlink("far/model.nook", folder.path("link.nook"));
  fs::create_symlink("far/report.json", folder.path("new.json"));  // leads to nothing
  const ToolRun run =
      folder.run(small_probe(folder, folder.path("link.nook"), {"--report", folder.path("new.json")}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK_FALSE(fs::is_symlink(folder.path("link.nook")));
  CHECK_FALSE(fs::is_symlink(folder.path("new.json")));
  CHECK(read_text(folder.path("far/model.nook")) == "shared");
  CHECK_FALSE(fs::exists(folder.path("far/report.json")));
  CHECK(read_text(folder.path("link.nook")).substr(0, 4) == "NOOK");
  CHECK(has(read_text(folder.path("new.json")), "rows"));
}

TEST_CASE("symbolic links that form a cycle are an error") {
  const TestFolder folder;
  fs::create_symlink("b", folder.path("a"));
  fs::create_symlink("a", folder.path("b"));
  const ToolRun run = folder.run(small_probe(folder, folder.path("a")));
  CHECK(run.exit_code == 1);
  CHECK(has(run.error, folder.path("a")));
}

TEST_CASE("an output that is an input is refused, under any name") {
  const TestFolder folder;
  const std::string source = glb_tube({"bend"});
  const std::string glb = folder.path("hero.glb");
  write_text(glb, source);
  fs::create_symlink("hero.glb", folder.path("link"));
  fs::create_hard_link(glb, folder.path("hard"));
  for (const std::string& same : {glb, folder.path("./hero.glb"), folder.path("link"), folder.path("hard")}) {
    INFO(same);
    const ToolRun run = folder.run({"bake", "character", glb, "-o", same});
    CHECK(run.exit_code == 2);
    CHECK(has(run.error, "-o and the input name the same file"));
    CHECK(read_text(glb) == source);
    CHECK(folder.run({"inspect", glb, "--report", same}).exit_code == 2);
  }
  CHECK(folder.names() == Names{"hard", "hero.glb", "link"});
}

TEST_CASE("two outputs of one name are refused before any work") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"bend"}));
  const std::string both = folder.path("both"), again = folder.path("./both");
  const Names commands[] = {
      {"bake", "character", folder.path("hero.glb"), "-o", both, "--report", again},
      small_training(both, {"--report", again}),
      small_training(both, {"--report", both + ".resume"}),
      small_probe(folder, both, {"--report", again}),
      small_probe(folder, both, {"--picture", again}),
      {"bake", "material", "--meso", "weave", "-o", both, "--keep-raw", again},
      {"bake", "material", "--meso", "weave", "-o", folder.path("m"), "--keep-raw", both, "--report", again}};
  for (const Names& command : commands) {
    const ToolRun run = folder.run(command);
    INFO(run.error);
    CHECK(run.exit_code == 2);
    CHECK(has(run.error, "name the same file"));
  }
  CHECK(folder.names() == Names{"hero.glb", "map.hdr"});
}

TEST_CASE("evaluation refuses a report that is one of its files") {
  const TestFolder folder;
  for (const char* name : {"a", "b", "c"}) write_text(folder.path(name), "kept");
  const std::string a = folder.path("a"), b = folder.path("b"), c = folder.path("c");
  const Names commands[] = {{"evaluate", "character", a, b, "--report", b},
                            {"evaluate", "casters", a, b, "--report", a},
                            {"evaluate", "material", a, b, "--unseen", c, "--report", c},
                            {"evaluate", "probe", a, "--report", a},
                            {"evaluate", "probe", "--scene", a, "--light", b, c, "--report", b},
                            {"evaluate", "nnao", "--frame", a, "--report", a},
                            {"evaluate", "nnao", "--frame", a, "--network", b, "--report", b},
                            {"bake", "material", "--raw", a, "-o", a},
                            {"bake", "probe", a, "--grid", "1x1x1", "--light", b, "-o", b}};
  for (const Names& command : commands) {
    const ToolRun run = folder.run(command);
    INFO(run.error);
    CHECK(run.exit_code == 2);
    CHECK(has(run.error, "name the same file"));
  }
  for (const std::string& path : {a, b, c}) CHECK(read_text(path) == "kept");
}

TEST_CASE("an output that a .gltf refers to, or that lies in a folder of images, is refused") {
  const TestFolder folder;
  write_text(folder.path("hero.gltf"),
             R"({"asset":{"version":"2.0"},"buffers":[{"uri":"my%20data.bin","byteLength":4}]})");
  write_text(folder.path("my data.bin"), "kept");
  const ToolRun run =
      folder.run({"bake", "character", folder.path("hero.gltf"), "-o", folder.path("my data.bin")});
  CHECK(run.exit_code == 2);
  CHECK(has(run.error, "-o and a file of the input name the same file"));
  fs::create_directory(folder.path("btf"));
  write_text(folder.path("btf/tl000_pl000_tv000_pv000.png"), "kept");
  CHECK(folder
            .run({"bake", "material", "--btf", folder.path("btf"), "-o",
                  folder.path("btf/tl000_pl000_tv000_pv000.png")})
            .exit_code == 2);
  // Pictures of --images could replace the report.
  fs::create_directory(folder.path("images"));
  const ToolRun pictures = folder.run({"evaluate", "nnao", "--frame", folder.path("a"), "--images",
                                       folder.path("images"), "--report", folder.path("images/a.png")});
  CHECK(pictures.exit_code == 2);
  CHECK(has(pictures.error, "--images"));
}

TEST_CASE("a folder of pictures that cannot be made is known before the work") {
  const TestFolder folder;
  write_text(folder.path("file"), "");
  const ToolRun run = folder.run({"bake", "material", "--meso", "weave", "-o", folder.path("w.nook"),
                                  "--images", folder.path("file/images")});
  CHECK(run.exit_code == 1);
  CHECK(has(run.error, "--images"));
  CHECK_FALSE(has(run.error, "ray tracing"));
  CHECK(folder.names() == Names{"file"});
}

TEST_CASE("a hang-up leaves nothing behind, but for a program that ignores it") {
  const TestFolder folder;
  const Names endless = training(folder.path("n.nook"), "100000");
  const ToolRun run = folder.run_and_signal(endless, SIGHUP, "ray tracing");
  CHECK(run.exit_code == 1);
  CHECK(has(run.error, "stopped"));
  for (const std::string& name : folder.names()) CHECK_FALSE(has(name, "-part-"));
  // SIGHUP is ignored, as under nohup.
  std::signal(SIGHUP, SIG_IGN);
  const ToolRun ignoring = folder.run_and_signal(training(folder.path("m.nook"), "2"), SIGHUP, "ray tracing");
  std::signal(SIGHUP, SIG_DFL);
  CHECK(ignoring.exit_code == 0);
}

TEST_CASE("the next run removes the parts of dead processes and keeps the parts of living ones") {
  const TestFolder folder;
  const Names endless = training(folder.path("n.nook"), "100000");
  const ToolRun killed = folder.run_and_signal(endless, SIGKILL, "ray tracing");
  CHECK(killed.exit_code == 128 + SIGKILL);
  Names parts = folder.names();
  REQUIRE(parts.size() == 1);
  CHECK(has(parts[0], "n.nook.nook-part-"));
  // The part of a process of this number.
  const auto left_by = [](int process) {
    std::string mark = "nook: an unfinished file of process " + std::to_string(process);
    mark.resize(63, ' ');
    return mark + "\nand more";
  };
  write_text(folder.path("n.nook.nook-part-999999999"), left_by(999999999));
  write_text(folder.path("n.nook.nook-part-999999998-3"), left_by(999999998));
  write_text(folder.path("n.nook.nook-part-999999997"), left_by(999999996));
  write_text(folder.path("n.nook.nook-part-of-mine"), left_by(999999999));
  write_text(folder.path("other.nook.nook-part-999999999"), left_by(999999999));
  const int living = folder.start(endless);
  const std::string of_living = "n.nook.nook-part-" + std::to_string(living);
  while (!fs::exists(folder.path(of_living))) usleep(2000);
  const ToolRun run = folder.run(small_probe(folder, folder.path("n.nook")));
  INFO(run.error);
  CHECK(run.exit_code == 0);
  CHECK(fs::exists(folder.path(of_living)));
  kill(living, SIGTERM);
  folder.finish(living);
  Names left = folder.names();
  std::erase(left, "n.nook.resume");
  CHECK(left == Names{"map.hdr", "n.nook", "n.nook.nook-part-999999997", "n.nook.nook-part-of-mine",
                      "other.nook.nook-part-999999999"});
}

TEST_CASE("previews of a grid are replaced by the last version") {
  const TestFolder folder;
  write_text(folder.path("scene.glb"), glb_tube({"bend"}));
  write_text(folder.path("map.hdr"), rgbe_map(16, 8));
  const Names bake{"bake",
                   "probe",
                   folder.path("scene.glb"),
                   "--light",
                   folder.path("map.hdr"),
                   "--grid",
                   "2x2x2",
                   "--samples",
                   "2048",
                   "--error",
                   "0",
                   "-o",
                   folder.path("g.nook"),
                   "--preview-every",
                   "0.001"};
  const ToolRun run = folder.run(bake);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(has(run.error, "preview written"));
  CHECK(folder.names() == Names{"g.nook", "map.hdr", "scene.glb"});
  CHECK(folder.run({"inspect", folder.path("g.nook")}).exit_code == 0);
  const Pipe pipe(folder.path("pipe"));
  Names to_pipe = bake;
  to_pipe[12] = folder.path("pipe");
  const ToolRun refused = folder.run(to_pipe);
  CHECK(refused.exit_code == 2);
  CHECK(has(refused.error, "--preview-every"));
}
