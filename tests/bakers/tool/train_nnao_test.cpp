#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

std::vector<std::string> tiny_training(const std::string& output, const std::string& threads) {
  return {"train",    "nnao", "-o",     output, "--scenes", "48", "--views",   "48",
          "--points", "64",   "--rays", "16",   "--epochs", "2",  "--threads", threads};
}

}  // namespace

TEST_CASE("train nnao writes a network that inspect reads, the same on any number of threads") {
  const TestFolder folder;
  auto arguments = tiny_training(folder.path("a.nook"), "1");
  arguments.insert(arguments.end(), {"--report", folder.path("r.json")});
  const ToolRun run = folder.run(arguments);
  REQUIRE(run.exit_code == 0);
  REQUIRE(folder.run(tiny_training(folder.path("b.nook"), "2")).exit_code == 0);
  CHECK(read_text(folder.path("a.nook")) == read_text(folder.path("b.nook")));
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  CHECK(report.at("rows").at(0).at("method") == "constant");
  CHECK(report.at("rows").at(4).at("taps") == 64);
  CHECK(report.at("recipe").at("epochs") == 2);
  CHECK(run.out.find("mse_blurred") != std::string::npos);
  const ToolRun inspected = folder.run({"inspect", folder.path("a.nook")});
  CHECK(inspected.exit_code == 0);
  CHECK(inspected.out.find("screen-space network") != std::string::npos);
}

TEST_CASE("train nnao that is killed or stopped goes on to the same bits, and leaves no half file") {
  const TestFolder folder;
  auto arguments = tiny_training(folder.path("a.nook"), "2");
  for (std::string& a : arguments)
    if (a == "2" && &a != &arguments.back()) a = "120";  // epochs
  // A farm kills without a warning, and starts the same command again.
  const int child = folder.start(arguments);
  const auto wait_started = std::chrono::steady_clock::now();
  while (!std::filesystem::exists(folder.path("a.nook.resume")) &&
         std::chrono::steady_clock::now() - wait_started < std::chrono::minutes(5))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(child, SIGKILL);
  REQUIRE(folder.finish(child).exit_code == 128 + SIGKILL);
  REQUIRE(std::filesystem::exists(folder.path("a.nook.resume")));
  CHECK_FALSE(std::filesystem::exists(folder.path("a.nook")));
  const ToolRun stopped = folder.run_and_signal(arguments, SIGINT, "validation mse");
  REQUIRE(stopped.exit_code == 1);
  CHECK(stopped.error.find("continuing after") != std::string::npos);
  CHECK(stopped.error.find("a.nook.resume") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"a.nook.resume"});
  const ToolRun resumed = folder.run(arguments);
  REQUIRE(resumed.exit_code == 0);
  CHECK(resumed.error.find("continuing after") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"a.nook"});
  auto whole = arguments;
  for (std::string& a : whole)
    if (a == folder.path("a.nook")) a = folder.path("b.nook");
  REQUIRE(folder.run(whole).exit_code == 0);
  CHECK(read_text(folder.path("a.nook")) == read_text(folder.path("b.nook")));
}

TEST_CASE("train nnao stops at its time limit as at a signal") {
  const TestFolder folder;
  auto arguments = tiny_training(folder.path("a.nook"), "2");
  for (std::string& a : arguments)
    if (a == "2" && &a != &arguments.back()) a = "100000";  // epochs, far more than four seconds'
  arguments.insert(arguments.end(), {"--time-limit", "4"});
  const ToolRun run = folder.run(arguments);
  CHECK(run.exit_code == 1);
  CHECK(run.error.find("a.nook.resume") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"a.nook.resume"});
  CHECK(folder.run({"train", "nnao", "-o", folder.path("b.nook"), "--time-limit", "0"}).exit_code == 2);
}

TEST_CASE("train nnao refuses bad arguments and a checkpoint of something else") {
  const TestFolder folder;
  CHECK(folder.run({"train", "nnao"}).exit_code == 2);
  CHECK(folder.run({"train", "nnao", "-o", folder.path("a.nook"), "--scenes", "3"}).exit_code == 2);
  CHECK(folder.run({"train", "nnao", "-o", folder.path("a.nook"), "--form", "other"}).exit_code == 2);
  CHECK(folder.run({"train", "nnao", "-o", folder.path("no/such/a.nook")}).exit_code != 0);
  write_text(folder.path("a.nook.resume"), "not a checkpoint");
  const ToolRun run = folder.run(tiny_training(folder.path("a.nook"), "2"));
  CHECK(run.exit_code == 3);
  CHECK(run.error.find("a.nook.resume") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"a.nook.resume"});
}
