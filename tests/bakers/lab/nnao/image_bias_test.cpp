#include "bakers/lab/nnao/image_bias.h"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/catch.h"

using namespace nook::lab;

namespace {

constexpr std::uint32_t width = 200, height = 160;

// The planted difference of AO and truth at a pixel.
template <class Error>
BorderBias bias_of(const Error& error, const std::vector<float>& depth) {
  const std::vector<float> truth(width * height, 0.5f);
  std::vector<float> ao = truth;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) ao[y * width + x] += error(x, y);
  BorderBias bias;
  bias.add(ao, truth, depth, width);
  return bias;
}

const std::vector<float> surface_everywhere(width* height, 1.0f);

}  // namespace

TEST_CASE("each band of each border has the error that was planted in it") {
  // Quarters and eighths are exact floats.
  const BorderBias left = bias_of(
      [](std::uint32_t x, std::uint32_t) {
        return x < 5 ? -0.25f : x < 20 ? 0.125f : x < 60 ? 0.25f : 0;
      },
      surface_everywhere);
  CHECK(left.at(0, 0) == -0.25);
  CHECK(left.at(0, 1) == 0.125);
  CHECK(left.at(0, 2) == 0.25);
  CHECK(left.inside() == 0);
  for (std::size_t band = 0; band < 3; ++band) CHECK(left.at(1, band) == 0);
  const BorderBias top =
      bias_of([](std::uint32_t, std::uint32_t y) { return y >= height - 5 ? 0.25f : 0; }, surface_everywhere);
  CHECK(top.at(3, 0) == 0.25);
  CHECK(top.at(3, 1) == 0);
  CHECK(top.at(2, 0) == 0);
}

TEST_CASE("an error that is the same everywhere is not a rim, and a dark rim is below 0") {
  CHECK(bias_of([](std::uint32_t, std::uint32_t) { return 0.125f; }, surface_everywhere).rim() == 0);
  const auto dark_rim = [](std::uint32_t x, std::uint32_t y) {
    return x < 20 || y < 20 || x >= width - 20 || y >= height - 20 ? -0.25f : 0.125f;
  };
  CHECK(bias_of(dark_rim, surface_everywhere).rim() == -0.375);
}

TEST_CASE("sky does not count towards a rim") {
  std::vector<float> depth = surface_everywhere;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < 5; ++x) depth[y * width + x] = std::numeric_limits<float>::infinity();
  const BorderBias bias = bias_of([](std::uint32_t x, std::uint32_t) { return x < 5 ? -0.25f : 0; }, depth);
  CHECK(bias.at(0, 0) == 0);
  CHECK(bias.rim() == 0);
}

namespace {

const float sky = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("the truth decides which parts are dark, and the sky does not count") {
  Calibration calibration;
  CHECK(calibration.dark_bias() == 0);
  CHECK(calibration.largest_bias() == 0);
  const std::vector<float> ao{0.5f, 0.4f, 0.9f, 0.0f}, truth{0.3f, 0.2f, 0.36f, 0.3f}, depth{1, 1, 1, sky};
  calibration.add(ao, truth, depth);
  CHECK(std::abs(calibration.dark_bias() - 0.2) < 1e-6);
}

TEST_CASE("the largest bias is taken over a tenth of the prediction, not of single pixels") {
  // 600 pixels in the tenth from 0.5 are right in the mean, 398 from 0.8 too bright by 0.125; one pixel is
  // far off, and one is 1, which belongs to the last tenth.
  std::vector<float> ao, truth;
  for (int i = 0; i < 600; ++i) {
    ao.push_back(0.55f);
    truth.push_back(i % 2 ? 0.3f : 0.8f);
  }
  for (int i = 0; i < 398; ++i) {
    ao.push_back(0.875f);
    truth.push_back(0.75f);
  }
  ao.insert(ao.end(), {0.05f, 1.0f});
  truth.insert(truth.end(), {1.0f, 0.0f});
  const std::vector<float> depth(ao.size(), 1.0f);
  Calibration calibration;
  calibration.add(ao, truth, depth);
  CHECK(std::abs(calibration.largest_bias() - 0.125) < 1e-6);
  // The same pixels twice, as two images that are added.
  const Calibration once = calibration;
  calibration.add(once);
  CHECK(std::abs(calibration.largest_bias() - once.largest_bias()) < 1e-12);
  CHECK(std::abs(calibration.dark_bias() - once.dark_bias()) < 1e-12);
}
