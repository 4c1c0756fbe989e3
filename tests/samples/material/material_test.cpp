// The sample as a user runs it: its pictures, its report, and its exit codes.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sdk/src/material/material_file.h"
#include "tests/catch.h"
#include "tests/material/open_weave.h"
#include "tests/samples/sample_run.h"

using namespace nook::material;

namespace {

constexpr int width = 160, height = 90;

struct Picture {
  std::vector<float> values;  // red, green, blue, rows from the top
  float brightness(std::size_t pixel) const {
    return (values[3 * pixel] + values[3 * pixel + 1] + values[3 * pixel + 2]) / 3;
  }
  // The background is one colour, which the upper left corner shows.
  bool is_background(std::size_t pixel) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(values[3 * pixel + c] - values[c]) > 0.02f) return false;
    return true;
  }
  std::size_t background() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < values.size() / 3; ++i) count += is_background(i);
    return count;
  }
};

Picture read(const std::filesystem::path& path) {
  auto picture = nook::test::read_picture<float>(path, width, height);
  REQUIRE(picture.channels == 3);
  return {std::move(picture.values)};
}

int run(const std::string& arguments) {
  return nook::test::exit_code(nook::test::quoted(MATERIAL_SAMPLE) + " " + arguments + " > /dev/null 2>&1");
}

struct Folder : nook::test::Folder {
  std::string write(const char* name, const std::vector<std::byte>& bytes) const {
    const std::filesystem::path file = path / name;
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return file.string();
  }
};

}  // namespace

TEST_CASE("sample material: pictures of a weave with holes under a moving light") {
  const Folder folder;
  const std::string file = folder.write(
      "weave.nook", write_material(test::open_weave({4, 16, 16, VisibilityForm::distance, 0.05f})));
  REQUIRE(run(file + " --frames 2 --size 160x90 --tile 1 --quiet --out " + folder.path.string()) == 0);
  const Picture flat = read(folder.path / "weave_flat.png"), first = read(folder.path / "weave_000.png"),
                second = read(folder.path / "weave_001.png");
  // Shapes fill a good part of the picture; holes let more of the background through, but by far not all of
  // it.
  const std::size_t pixels = std::size_t(width) * height;
  CHECK(flat.background() > pixels / 4);
  CHECK(flat.background() < pixels * 3 / 4);
  CHECK(first.background() > flat.background() + 50);
  CHECK(first.background() < flat.background() + pixels / 4);
  // Where both frames show cloth, the light has moved.
  double change = 0;
  std::size_t shared = 0;
  for (std::size_t i = pixels * 3 / 4; i < pixels; ++i)
    if (!first.is_background(i) && !second.is_background(i)) {
      change += std::abs(first.brightness(i) - second.brightness(i));
      ++shared;
    }
  CHECK(shared > 500);
  CHECK(change / double(shared) > 0.03);

  const auto report = nlohmann::json::parse(std::ifstream(folder.path / "report.json"));
  REQUIRE(report["rows"].size() == 1);
  const auto& row = report["rows"][0];
  CHECK(row["material"] == "weave");
  // Three terms of 12 light modes and one group of four view modes at two places, their coefficients, their
  // clusters.
  CHECK(row["decode_fetches"] == 2 * 3 * 12 + 3 + 1);
  CHECK(row["light_fetches"] == 9);
  CHECK(row["occlusion_fetches"] == 2 * 3 + 3 + 1);
  CHECK(row["ms"].get<double>() > 0);
}

TEST_CASE("sample material: without a VOTF everything is seen, and what is nowhere visible is not drawn") {
  const Folder folder;
  const test::WeaveSize size{2, 4, 8, VisibilityForm::none};
  const std::string solid = folder.write("solid.nook", write_material(test::open_weave(size)));
  Material hidden = test::open_weave({2, 4, 8});
  for (float& core : hidden.votf.cores) core = -1;
  const std::string gone = folder.write("gone.nook", write_material(hidden));
  REQUIRE(run(solid + " " + gone + " --frames 1 --size 160x90 --fetches 0 --quiet --out " +
              folder.path.string()) == 0);
  CHECK(read(folder.path / "solid_000.png").values == read(folder.path / "solid_flat.png").values);
  CHECK(read(folder.path / "gone_000.png").background() == std::size_t(width) * height);
  CHECK(read(folder.path / "gone_flat.png").background() < std::size_t(width) * height * 3 / 4);
}

TEST_CASE("sample material: bad input has the tool's exit codes") {
  const Folder folder;
  std::vector<std::byte> bytes = write_material(test::open_weave({1, 4, 4}));
  bytes.back() ^= std::byte{1};
  const std::string damaged = folder.write("damaged.nook", bytes);
  const std::string out = " --out " + (folder.path / "out").string();
  CHECK(run(damaged + out) == 3);
  CHECK(run((folder.path / "absent.nook").string() + out) == 2);
  CHECK(run(damaged + out + " --frames 0") == 2);
  CHECK(run(damaged + out + " --fetches 9") == 2);
  CHECK(run(damaged + out + " --size 3x4") == 2);
  CHECK(run(out) == 2);
  CHECK(run("--help") == 0);
}
