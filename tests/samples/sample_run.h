// Samples as a user runs them: programs, their exit codes, folders and pictures.
#pragma once

#include <OpenImageIO/imageio.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace nook::test {

// An argument of a shell's command: names of folders may have spaces.
inline std::string quoted(const std::filesystem::path& path) {
  return std::string("'").append(path.string()).append("'");
}

// The exit code of a shell's command; -1 where a signal ended it.
inline int exit_code(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Of its own for each case, because cases run side by side, and gone with it.
struct Folder {
  std::filesystem::path path;

  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "nook_sample_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
    path = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

// Floats from 0 to 1, or bytes; the upper row first.
template <class Value>
struct SamplePicture {
  int width = 0, channels = 0;
  std::vector<Value> values;

  // The first channel; the others follow.
  const Value& at(int x, int y) const {
    return values[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels)];
  }
};

template <class Value>
SamplePicture<Value> read_picture(const std::filesystem::path& path, int width, int height) {
  const auto input = OIIO::ImageInput::open(path.string());
  REQUIRE(input);
  REQUIRE(input->spec().width == width);
  REQUIRE(input->spec().height == height);
  SamplePicture<Value> picture{width, input->spec().nchannels, {}};
  picture.values.resize(std::size_t(width) * std::size_t(height) * std::size_t(picture.channels));
  REQUIRE(
      input->read_image(0, 0, 0, picture.channels, OIIO::BaseTypeFromC<Value>::value, picture.values.data()));
  return picture;
}

}  // namespace nook::test
