#include "bakers/measure/nnao/calibration.h"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/catch.h"

using nook::bake::nnao::Calibration;

namespace {

const float sky = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("dark parts are those of the truth, and the sky does not count") {
  Calibration calibration;
  CHECK(calibration.dark_bias() == 0);
  CHECK(calibration.largest_bias() == 0);
  const std::vector<float> ao{0.5f, 0.4f, 0.9f, 0.0f}, truth{0.3f, 0.2f, 0.36f, 0.3f}, depth{1, 1, 1, sky};
  calibration.add(ao, truth, depth);
  CHECK(std::abs(calibration.dark_bias() - 0.2) < 1e-6);
}

TEST_CASE("the largest bias is that of a tenth of the prediction, not of single pixels") {
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
