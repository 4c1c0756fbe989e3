// The sample as a user runs it: pictures without a display, and a window on a virtual one.
#include <algorithm>
#include <fstream>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/samples/sample_run.h"

namespace {

using nook::test::exit_code;
using nook::test::Folder;
using nook::test::quoted;

int run(const std::string& arguments) {
  return exit_code(std::string("'" CROWD "' --quiet ").append(arguments).append(" > /dev/null"));
}

double mean(const std::filesystem::path& picture, int width, int height) {
  const auto pixels = nook::test::read_picture<float>(picture, width, height).values;
  double sum = 0;
  for (const float value : pixels) sum += double(value);
  return sum / double(pixels.size());
}

}  // namespace

TEST_CASE("a small crowd is drawn, and ambient occlusion darkens it") {
  const Folder folder;
  REQUIRE(run("--context egl --characters 12 --frames 2 --size 320x240 --out " + quoted(folder.path)) == 0);
  // A picture of one colour of this size has less than a kilobyte.
  for (const char* name : {"frame_0000.png", "frame_0001.png", "without_ao.png"})
    CHECK(std::filesystem::file_size(folder.path / name) > 5000);
  // Bodies and the floor between them are a good part of the picture.
  const double with = mean(folder.path / "frame_0000.png", 320, 240),
               without = mean(folder.path / "without_ao.png", 320, 240);
  CAPTURE(with, without);
  CHECK(with < 0.98 * without);
  CHECK(with > 0.5 * without);
}

TEST_CASE("bad arguments end with code 2, a bad character with 3") {
  CHECK(run("--size 3 2> /dev/null") == 2);
  CHECK(run("--tier 40 2> /dev/null") == 2);
  CHECK(run("--debug bones 2> /dev/null") == 2);
  CHECK(run("--context egl --debug spheres 2> /dev/null") == 2);
  CHECK(run("--context egl --window-picture picture.png 2> /dev/null") == 2);
  CHECK(run("no_such_file.glb 2> /dev/null") == 2);
  const Folder folder;
  std::ofstream(folder.path / "broken.glb") << "not a character";
  CHECK(run(quoted(folder.path / "broken.glb") + " 2> /dev/null") == 3);
}

#ifdef XVFB_RUN
TEST_CASE("a window shows the crowd with spheres and links") {
  const Folder folder;
  const std::string glb = glb_tube({"bend"});
  std::ofstream(folder.path / "tube.glb", std::ios::binary).write(glb.data(), std::streamsize(glb.size()));
  const auto draw = [&](const std::string& name, const std::string& debug) {
    REQUIRE(exit_code("'" XVFB_RUN "' -a -s '-screen 0 640x480x24' '" CROWD
                      "' --quiet --context window --size 640x480 --characters 2 " +
                      debug + " --window-picture " + quoted(folder.path / name) + " --out " +
                      quoted(folder.path) + " " + quoted(folder.path / "tube.glb")) == 0);
    return nook::test::read_picture<float>(folder.path / name, 640, 480).values;
  };
  const std::vector<float> plain = draw("plain.png", ""), debug = draw("debug.png", "--debug spheres,links");
  CHECK(*std::max_element(plain.begin(), plain.end()) > 0.8f);
  // Spheres of one body have thousands of pixels of circles; the panel's ticks and times have fewer.
  std::size_t changed = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) changed += std::abs(plain[i] - debug[i]) > 0.1f;
  CHECK(changed > 6000);
}
#endif
