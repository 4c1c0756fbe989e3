// A model's file that may change while the program runs.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <vector>

namespace crowd {

class ModelFile {
 public:
  // The file need not be there yet.
  explicit ModelFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  // True if the file differs from the one that take_change gave last.
  bool has_change() const;
  // Returns the bytes of the file once after each change. A file that cannot be read counts as unchanged.
  std::optional<std::vector<unsigned char>> take_change();

 private:
  struct State {
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
    bool operator==(const State&) const = default;
  };
  std::optional<State> state() const;

  std::filesystem::path path_;
  std::optional<State> seen_;  // no value: there was no file
};

}  // namespace crowd
