// The sample as a user runs it, without a display: what its picture shows of the light.

#include <array>
#include <filesystem>
#include <fstream>
#include <nook/nook.hpp>
#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/samples/sample_run.h"

namespace {

constexpr int width = 1280, height = 540;

using Picture = nook::test::SamplePicture<unsigned char>;

int run(const std::string& arguments) {
  return nook::test::exit_code(nook::test::quoted(PROBE_SAMPLE) + " " + arguments);
}

// Red light from +x, blue light from -x, a little white everywhere.
std::string write_probe() {
  const nook::Context context;
  nook_probe_fit_desc fit_desc;
  nook::check(nook_probe_fit_desc_init(&fit_desc));
  const float axes[6] = {1, 0, 0, -1, 0, 0};
  fit_desc.lobe_count = 2;
  fit_desc.axes = axes;
  fit_desc.sharpness = 4;
  fit_desc.ambient = 1;
  const float coefficients[9] = {2, 0.1f, 0.1f, 0.1f, 0.1f, 2, 0.1f, 0.1f, 0.1f};
  nook_probe_fit fit = nullptr;
  nook::check(nook_probe_fit_create(context.get(), &fit_desc, &fit));
  nook_probe_desc desc;
  nook::check(nook_probe_desc_init(&desc));
  desc.functions = fit;
  desc.coefficients = coefficients;
  nook_probe probe = nullptr;
  nook::check(nook_probe_create(context.get(), &desc, &probe));
  std::size_t size = 0;
  nook::check(nook_probe_save(probe, NOOK_PROBE_PACKING_FLOAT, nullptr, &size));
  std::vector<char> bytes(size);
  nook::check(nook_probe_save(probe, NOOK_PROBE_PACKING_FLOAT, bytes.data(), &size));
  nook_probe_destroy(&probe);
  nook_probe_fit_destroy(&fit);
  const std::string path = PROBE_OUT "/two_lights.nook";
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
  return path;
}

}  // namespace

TEST_CASE("spheres are red on the red light's side and blue on the blue one's, glossy ones the more so") {
  const std::string probe = write_probe(), picture = PROBE_OUT "/two_lights.png";
  std::filesystem::remove(picture);
  REQUIRE(run("'" + probe + "' '" + picture + "'") == 0);
  const Picture shown = nook::test::read_picture<unsigned char>(picture, width, height);
  // Spheres stand 0.6 m apart from -1.5 m on, the picture is 2.17 m high round y = 1.
  const auto at = [&](float x_m, float y_m) {
    const float pixel_per_m = float(height) / (2 * 7.2f * 0.15113522f);
    const int x = int(0.5f * width + x_m * pixel_per_m), y = int(0.5f * height - (y_m - 1) * pixel_per_m);
    const unsigned char* p = &shown.at(x, y);
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  for (int i = 0; i < 6; ++i) {
    const float x = -1.5f + 0.6f * float(i);
    const auto right = at(x + 0.2f, 0.68f), left = at(x - 0.2f, 0.68f);
    INFO("plastic sphere " << i << ": right " << right[0] << " " << right[2] << ", left " << left[0] << " "
                           << left[2]);
    CHECK(right[0] > right[2] + 40);
    CHECK(left[2] > left[0] + 40);
  }
  // The glossiest metal mirrors the red light at its right edge and, straight on, the dark behind the
  // eye.
  const auto edge = at(-1.5f + 0.19f, 1.34f), middle = at(-1.5f, 1.34f);
  INFO("metal: edge " << edge[0] << " " << edge[2] << ", middle " << middle[0] << " " << middle[2]);
  // The picture's roll-off leaves less of bright colours.
  CHECK(edge[0] > edge[2] + 30);
  CHECK(edge[0] > middle[0] + 30);
}

TEST_CASE("bad arguments end with code 2, bad files with 3, and leave no picture") {
  const std::string picture = PROBE_OUT "/none.png", broken = PROBE_OUT "/broken.nook";
  std::ofstream(broken) << "not a probe";
  CHECK(run("2> /dev/null") == 2);
  CHECK(run("a b c 2> /dev/null") == 2);
  CHECK(run("no_such_file.nook '" + picture + "' 2> /dev/null") == 3);
  CHECK(run("'" + broken + "' '" + picture + "' 2> /dev/null") == 3);
  CHECK_FALSE(std::filesystem::exists(picture));
}
