// The sample as a user runs it, without a display: what it prints, and what AO does to crowd and heroes.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/samples/sample_run.h"

using nook::test::Folder, nook::test::quoted;

namespace {

constexpr int width = 1280, height = 400, panel_width = width / 2;

using Picture = nook::test::SamplePicture<unsigned char>;

const std::string inputs = quoted(CLIPS_CHARACTER) + " " + quoted(CLIPS_MODEL) + " " + quoted(CLIPS_FILE);

int run(const std::string& arguments) {
  return nook::test::exit_code(quoted(CLIPS_SAMPLE) + " " + arguments);
}

// A pixel of a body: in the left panel without AO, in the right one with it.
struct Pixel {
  int x, y, open, darkened;
};

// The heroes are orange; the crowd, the ground and the sky are not.
bool is_hero(const unsigned char* rgb) {
  return rgb[0] > rgb[2] + 60;
}

// The pixels that AO changes, of heroes or of the crowd, from top to bottom.
std::vector<Pixel> body_pixels(const Picture& picture, bool heroes) {
  std::vector<Pixel> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < panel_width; ++x) {
      const unsigned char *left = &picture.at(x, y), *right = &picture.at(x + panel_width, y);
      if (right[1] < left[1] && is_hero(left) == heroes) pixels.push_back({x, y, left[1], right[1]});
    }
  return pixels;
}

// The share that AO leaves of a pixel, in the darkest tenth: between limbs and where bodies meet.
double darkest_tenth(const std::vector<Pixel>& pixels) {
  std::vector<double> shares;
  for (const Pixel& p : pixels) shares.push_back(double(p.darkened) / p.open);
  std::ranges::sort(shares);
  return shares[shares.size() / 10];
}

}  // namespace

TEST_CASE("the crowd of clips is as dark between its limbs as live heroes are") {
  const Folder folder;
  const std::filesystem::path path = folder.path / "crowd.png", printed = folder.path / "printed.txt";
  REQUIRE(run(inputs + " " + quoted(path) + " > " + quoted(printed)) == 0);

  std::ifstream stream(printed);
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  INFO(text);
  std::smatch found;
  REQUIRE(
      std::regex_search(text, found, std::regex("20 members play 2 clips of \\d+ frames and (\\d+) modes")));
  const double modes = std::stod(found[1]);
  REQUIRE(std::regex_search(text, found, std::regex("differs by at most ([0-9.]+)")));
  // Weights are half floats of ten bits below one in the shader, and each mode has one; see tests/gl.
  CHECK(std::stod(found[1]) < modes * 0.6 / 4096);

  const Picture shown = nook::test::read_picture<unsigned char>(path, width, height);
  int brighter = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < panel_width; ++x) brighter += shown.at(x + panel_width, y) > shown.at(x, y);
  CHECK(brighter == 0);
  const std::vector<Pixel> heroes = body_pixels(shown, true), crowd = body_pixels(shown, false);
  INFO(heroes.size() << " pixels of heroes, " << crowd.size() << " of the crowd");
  CHECK(heroes.size() > 10000);
  CHECK(crowd.size() > 55000);
  // The crowd stands over the whole width, in five columns.
  for (int column = 0; column < 5; ++column) {
    INFO("column " << column);
    CHECK(std::ranges::count_if(crowd, [&](const Pixel& p) { return p.x / (panel_width / 5) == column; }) >
          5000);
  }
  // Members of the crowd have more neighbours than the heroes, and are a little darker. This holds only if
  // both parts of their AO are there, once: without the part of the clips the crowd is 0.02 brighter than the
  // heroes, without the part of ground and neighbours 0.3, and heroes with AO of a clip as well are 0.09
  // darker.
  const double of_heroes = darkest_tenth(heroes), of_crowd = darkest_tenth(crowd);
  INFO("AO leaves " << of_heroes << " of the heroes and " << of_crowd << " of the crowd");
  CHECK(of_crowd < of_heroes);
  CHECK(of_crowd > of_heroes - 0.05);
}

TEST_CASE("clips: bad arguments end with code 2, bad files with 3, and leave no picture") {
  const Folder folder;
  const std::string picture = quoted(folder.path / "none.png"), silent = " > /dev/null 2>&1";
  CHECK(run(silent) == 2);
  CHECK(run(quoted(CLIPS_CHARACTER) + " no_such_model.nook " + quoted(CLIPS_FILE) + " " + picture + silent) ==
        3);
  // The model in place of the clips.
  CHECK(run(quoted(CLIPS_CHARACTER) + " " + quoted(CLIPS_MODEL) + " " + quoted(CLIPS_MODEL) + " " + picture +
            silent) == 3);
  CHECK(run(quoted(CLIPS_MODEL) + " " + quoted(CLIPS_MODEL) + " " + quoted(CLIPS_FILE) + " " + picture +
            silent) == 3);
  CHECK_FALSE(std::filesystem::exists(folder.path / "none.png"));
}
