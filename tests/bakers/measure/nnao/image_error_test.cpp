#include "bakers/measure/nnao/image_error.h"

#include <cmath>
#include <limits>
#include <vector>

#include "bakers/raytrace/random.h"
#include "tests/catch.h"

using namespace nook::measure;

namespace {

constexpr std::uint32_t side = 32;
const std::vector<float> flat_depth(side* side, 1.0f);

std::vector<float> noise(std::uint64_t seed) {
  nook::bake::Random random(seed);
  std::vector<float> values(side * side);
  for (float& value : values) value = random.unit();
  return values;
}

ImageError error_of(const std::vector<float>& a, const std::vector<float>& b) {
  ImageError error;
  error.add(a, b, flat_depth, side);
  return error;
}

}  // namespace

TEST_CASE("equal images have no error") {
  const std::vector<float> image = noise(1);
  const ImageError error = error_of(image, image);
  CHECK(error.mse() == 0);
  CHECK(std::abs(error.ssim() - 1) < 1e-9);
  CHECK(std::abs(error.correlation() - 1) < 1e-9);
}

TEST_CASE("a constant offset, a reversed image and independent noise") {
  const std::vector<float> image = noise(1), other = noise(2);
  std::vector<float> offset = image, reversed = image;
  for (float& v : offset) v += 0.25f;
  for (float& v : reversed) v = 1 - v;
  CHECK(std::abs(error_of(offset, image).mse() - 0.0625) < 1e-6);  // floats near 1 round by 6e-8
  CHECK(std::abs(error_of(offset, image).correlation() - 1) < 1e-6);
  CHECK(std::abs(error_of(reversed, image).correlation() + 1) < 1e-6);
  CHECK(error_of(reversed, image).ssim() < -0.5);
  // Uniform variables: 1/6, and no correlation; 1024 of them err by about 3 %.
  CHECK(std::abs(error_of(image, other).mse() - 1.0 / 6) < 0.02);
  CHECK(std::abs(error_of(image, other).correlation()) < 0.1);
}

TEST_CASE("structural similarity of constant images has a closed form") {
  // Variances vanish: (2 a b + c1) / (a^2 + b^2 + c1), c1 = 1e-4.
  const std::vector<float> a(side * side, 0.5f), b(side * side, 0.25f);
  CHECK(std::abs(error_of(a, b).ssim() - (0.25 + 1e-4) / (0.3125 + 1e-4)) < 1e-9);
  CHECK(error_of(a, b).correlation() == 0);
}

TEST_CASE("pixels of the sky do not count") {
  std::vector<float> a(side * side, 0.5f), depth = flat_depth;
  const std::vector<float> b = a;
  a[100] = 1;
  depth[100] = std::numeric_limits<float>::infinity();
  ImageError error;
  error.add(a, b, depth, side);
  CHECK(error.mse() == 0);
}
