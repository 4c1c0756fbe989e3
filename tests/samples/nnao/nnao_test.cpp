// The sample as a user runs it: its pictures, and its exit codes.
#include <OpenImageIO/imageio.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace {

struct Picture {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;
  float at(int x, int y) const { return values[(std::size_t(y) * width + x) * channels]; }
};

Picture read(const std::filesystem::path& path) {
  Picture picture;
  const auto input = OIIO::ImageInput::open(path.string());
  REQUIRE(input);
  const OIIO::ImageSpec& spec = input->spec();
  picture.width = spec.width;
  picture.height = spec.height;
  picture.channels = spec.nchannels;
  picture.values.resize(std::size_t(spec.width) * spec.height * spec.nchannels);
  REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.values.data()));
  return picture;
}

int run(const std::string& arguments) {
  const int status = std::system((std::string(NNAO_SAMPLE) + " " + arguments + " 2> /dev/null").c_str());
  return WEXITSTATUS(status);
}

// Of its own for each case: they run side by side.
struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "nook_nnao_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

}  // namespace

TEST_CASE("sample nnao: its pictures show a room that AO darkens, in the corners and nowhere else") {
  const Folder folder;
  REQUIRE(run(folder.path.string()) == 0);
  const Picture before = read(folder.path / "before.png"), after = read(folder.path / "after.png"),
                ao = read(folder.path / "ao.png");
  REQUIRE((before.width == 960 && before.height == 540 && ao.width == 960 && after.height == 540));
  // Open floor, sky above the walls, the corner of wall and wall, the floor under the ball.
  CHECK(ao.at(480, 500) > 0.95f);
  CHECK(ao.at(600, 5) == 1);
  CHECK(ao.at(370, 150) < 0.8f);
  CHECK(ao.at(541, 362) < 0.7f);
  float brighter = 0;
  for (std::size_t i = 0; i < before.values.size(); ++i)
    brighter = std::max(brighter, after.values[i] - before.values[i]);
  CHECK(brighter <= 0);
  CHECK(after.at(480, 500) > before.at(480, 500) - 0.03f);
  CHECK(after.at(541, 362) < before.at(541, 362) - 0.08f);
}

TEST_CASE("sample nnao: bad arguments and folders have exit codes of their own") {
  const Folder folder;
  CHECK(run(folder.path.string() + " 0") == 2);
  CHECK(run("a b c") == 2);
  CHECK(run((folder.path / "absent").string()) == 1);
  CHECK(std::filesystem::is_empty(folder.path));
}
