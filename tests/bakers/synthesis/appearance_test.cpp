// The looks of texels: distances of the short vectors against distances of all radiances.
#include "bakers/material/appearance.h"

#include <cmath>

#include "bakers/material/btf_error.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::bake::material;

namespace {

nook::material::test::SampleSize size_of_sample() {
  nook::material::test::SampleSize size;
  size.lights = 12;
  size.views = 20;
  size.width = 10;
  size.height = 8;
  size.rank_x = 8;
  size.rank_y = 7;
  size.visibility = nook::material::VisibilityForm::none;
  return size;
}

// The raw material that a compressed one decodes to.
RawMaterial decoded(const nook::material::Material& material) {
  RawMaterial raw;
  raw.lights.assign(material.lights.begin(), material.lights.end());
  raw.views.assign(material.views.begin(), material.views.end());
  raw.width = material.btf.shape.width;
  raw.height = material.btf.shape.height;
  raw.btf.resize(raw.light_rows() * raw.views.size() * raw.texels());
  const std::vector<float> basis(material.light_basis.begin(), material.light_basis.end());
  for (std::size_t view = 0; view < raw.views.size(); ++view) {
    const auto values = decode_btf_view(basis, material.btf, view);
    for (std::size_t row = 0; row < raw.light_rows(); ++row)
      for (std::size_t i = 0; i < raw.texels(); ++i)
        raw.btf[(row * raw.views.size() + view) * raw.texels() + i] =
            values(Eigen::Index(row), Eigen::Index(i));
  }
  return raw;
}

// The correlation of the squared distances of pairs of texels in the looks with those in all radiances.
double correlation(const bake::tensor::Matrix& looks, const RawMaterial& raw) {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0, n = 0;
  const std::size_t images = raw.light_rows() * raw.views.size();
  for (std::size_t i = 0; i < raw.texels(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      // Looks are in the order y * width + x, radiances in x * height + y.
      const auto at = [&](std::size_t row) { return row % raw.width * raw.height + row / raw.width; };
      double truth = 0;
      for (std::size_t image = 0; image < images; ++image) {
        const double d = raw.btf[image * raw.texels() + at(i)] - raw.btf[image * raw.texels() + at(k)];
        truth += d * d;
      }
      const double mine = double((looks.row(Eigen::Index(i)) - looks.row(Eigen::Index(k))).squaredNorm());
      a += mine;
      b += truth;
      aa += mine * mine;
      bb += truth * truth;
      ab += mine * truth;
      ++n;
    }
  return (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n));
}

}  // namespace

TEST_CASE("distances of looks equal distances of radiances, from a compressed and from a raw material") {
  const nook::material::Material material = nook::material::test::sample_material(4, size_of_sample());
  const RawMaterial raw = decoded(material);
  // 256 sums keep a squared distance to about sqrt(2 / 256) = 9 % of itself, over pairs whose distances
  // differ by about as much again; 64 channels leave nothing else out.
  CHECK(correlation(appearance_of(material, 1, 64), raw) > 0.8);
  CHECK(correlation(appearance_of(raw, 1, 64), raw) > 0.8);
}
