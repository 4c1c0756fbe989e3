// Debug views in pictures.
#include <OpenImageIO/imageio.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace {

std::vector<float> pixels(const std::filesystem::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  REQUIRE(input);
  const OIIO::ImageSpec& spec = input->spec();
  std::vector<float> all(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, all.data()));
  return all;
}

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<float> draw(const std::string& debug) {
  const std::filesystem::path out = std::filesystem::path(CROWD_OUT) / ("debug_" + debug);
  std::filesystem::remove_all(out);
  REQUIRE(run("'" CROWD
              "' --quiet --no-sheets --no-light --screen-space off --characters 4 --frames 1 --size "
              "320x240 --out '" +
              out.string() + "' " + (debug.empty() ? "" : "--debug " + debug) + " > /dev/null") == 0);
  return pixels(out / "frame_0000.png");
}

double changed_share(const std::vector<float>& a, const std::vector<float>& b) {
  REQUIRE(a.size() == b.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < a.size(); ++i) changed += std::abs(a[i] - b[i]) > 0.04f;
  return double(changed) / double(a.size());
}

}  // namespace

TEST_CASE("each debug view is drawn over the picture and leaves the rest of it") {
  const std::vector<float> plain = draw("");
  // A body fills at least a hundredth of this picture, and all four of them less than half.
  for (const char* view : {"spheres", "key-points", "links", "levels", "error"}) {
    CAPTURE(view);
    const double share = changed_share(plain, draw(view));
    CHECK(share > 0.0005);
    CHECK(share < 0.5);
  }
}

TEST_CASE("an unknown debug view is refused") {
  CHECK(run("'" CROWD "' --debug bones > /dev/null 2>&1") == 2);
}
