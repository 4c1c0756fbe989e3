// Runs the tool as a user does and keeps what it said.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

struct ToolRun {
  int exit_code = -1;
  std::string out, error;
};

// A directory of its own, removed at the end.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> names() const;  // of everything in it, sorted, but for what run() keeps there

  ToolRun run(const std::vector<std::string>& arguments) const;
  // The same of another program.
  ToolRun run_program(const std::string& program, const std::vector<std::string>& arguments) const;
  // Sends the signal once the tool has said `text` on its error stream.
  ToolRun run_and_signal(const std::vector<std::string>& arguments, int signal,
                         const std::string& text) const;

  // In two steps: the process, and what it said when it has ended.
  int start(const std::vector<std::string>& arguments) const;
  int start_program(const std::string& program, const std::vector<std::string>& arguments) const;
  ToolRun finish(int child) const;

 private:
  std::filesystem::path folder_;
};

std::string read_text(const std::string& path);
void write_text(const std::string& path, const std::string& text);
