#include "bakers/material/btf_file.h"

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "bakers/material/raw_material.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/material/btf_writer.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;
using test::BtfFile;

namespace {

std::string refusal(const std::vector<std::byte>& bytes, std::uint32_t texels = 0) {
  try {
    read_btf_file(bytes, texels);
  } catch (const Failure& e) {
    return e.what();
  }
  return "";
}

// Compares what was read with the values of the small file, whose channels are RGB.
void matches(const RawMaterial& raw, float relative, bool times_cosine = false) {
  const BtfFile file = test::small_btf();
  const std::size_t left = (file.width - raw.width) / 2, top = (file.height - raw.height) / 2;
  std::size_t at = 0;
  for (std::size_t l = 0; l < 2; ++l)
    for (const std::vector<float>& channel : file.channels)
      for (std::size_t v = 0; v < 3; ++v)
        for (std::size_t x = 0; x < raw.width; ++x)
          for (std::size_t y = 0; y < raw.height; ++y) {
            const std::size_t texel =
                left + x + file.width * (top + raw.height - 1 - y);  // files begin at the top
            const float wanted = channel[(l + 2 * v) * file.texels() + texel] *
                                 (times_cosine ? std::cos(file.lights[2 * l]) : 1);
            REQUIRE(raw.btf[at++] == Approx(wanted).epsilon(relative));
          }
}

using Colour = Eigen::RowVector3d;

// A colour in a model, by the model's definition turned round.
Colour encoded(const Colour& rgb, int model, const Eigen::Matrix3d& axes, const Colour& mean) {
  if (model == 0) return rgb;
  if (model == 3) return (rgb - mean) * axes.inverse();
  if (model == 12) return (rgb.array() + 1e-5).log().matrix();
  if (model == 4) {
    const double y = 0.25 * rgb[0] + 0.5 * rgb[1] + 0.25 * rgb[2];
    return {y, 0.5 * rgb[0] - 0.5 * rgb[2], rgb[1] - y};
  }
  // ITU-R BT.601: luma, and the differences to it of blue and red.
  const double y = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
  double u = (rgb[2] - y) / 2.03211, v = (rgb[0] - y) / 1.13983;
  if (model == 1) return {y, u, v};
  for (double* difference : {&u, &v}) {
    if (model == 11) *difference /= y + 1e-5;
    if (model == 10) *difference = std::copysign(std::log(std::abs(*difference) / 1e-5), *difference);
  }
  return {std::log(y + 1e-5), u, v};
}

BtfFile small_btf_in(int model) {
  BtfFile file = test::small_btf();
  file.colour_model = model;
  // Any axes will do.
  Eigen::Matrix3d axes;
  axes << 0.6, 0.6, 0.5, 0, 0.8, -0.9, -0.7, 0.1, 0.7;
  const Colour mean(0.3, 0.2, 0.1);
  for (int i = 0; i < 9; ++i) file.matrix[i] = float(axes(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) file.mean[i] = float(mean[i]);
  auto& c = file.channels;
  for (std::size_t i = 0; i < c[0].size(); ++i) {
    const Colour coded = encoded(Colour(c[0][i], c[1][i], c[2][i]), model, axes, mean);
    for (int k = 0; k < 3; ++k) c[k][i] = float(coded[k]);
  }
  return file;
}

}  // namespace

TEST_CASE("a .btf file becomes a raw material, y up, in every model of colours") {
  // Half floats have 11 bits, and the numbers of the models four digits or more.
  for (const int model : {0, 1, 3, 4, 9, 10, 11, 12}) {
    INFO(model);
    const RawMaterial raw = read_btf_file(write_btf_file(small_btf_in(model)), 0);
    REQUIRE((raw.lights.size() == 2 && raw.views.size() == 3 && raw.width == 4 && raw.height == 5 &&
             raw.mask.empty()));
    matches(raw, 2e-3f);
  }
}

TEST_CASE("forms of .btf files and the square from their middle are read alike") {
  BtfFile file = test::small_btf();
  const RawMaterial raw = read_btf_file(write_btf_file(file), 0);
  CHECK(length(raw.lights[1] - Vec3{std::sin(0.5f) * std::cos(2.0f), std::sin(0.5f) * std::sin(2.0f),
                                    std::cos(0.5f)}) < 1e-6f);
  CHECK(length(raw.views[2] - Vec3{std::sin(1.0f) * std::cos(2.0f), -std::sin(1.0f) * std::sin(2.0f),
                                   std::cos(1.0f)}) < 1e-6f);
  matches(read_btf_file(write_btf_file(file), 3), 1e-3f);
  file.texels_are_rows = file.is_half = true;
  file.rotated = false;
  file.version = 2;
  matches(read_btf_file(write_btf_file(file), 2), 1e-3f);
  file.has_cosine = false;
  matches(read_btf_file(write_btf_file(file), 0), 1e-3f, true);
}

TEST_CASE("faults of a .btf file are named, and no part of one is read past its end") {
  const std::vector<std::byte> good = write_btf_file(test::small_btf());
  for (std::size_t size = 0; size < good.size(); ++size)
    REQUIRE(!refusal({good.begin(), good.begin() + std::ptrdiff_t(size)}).empty());
  std::vector<std::byte> longer = good;
  longer.push_back({});
  CHECK(refusal(longer).find("has 1 bytes after its last channel") != std::string::npos);
  CHECK(refusal(good, 5).find("5 texels is larger than the image (4 x 5)") != std::string::npos);
  CHECK_THROWS_AS(read_btf_file(good, 0, 100), Failure);
  const auto changed = [](auto&& change) {
    BtfFile file = test::small_btf();
    change(file);
    return refusal(write_btf_file(file));
  };
  CHECK(changed([](BtfFile& f) { f.colour_model = 2; }).find("colour model 2") != std::string::npos);
  CHECK(changed([](BtfFile& f) { f.channels[1][0] = std::nanf(""); }).find("channel 1") != std::string::npos);
  CHECK(changed([](BtfFile& f) { f.views[2] = 2; }).find("upper hemisphere") != std::string::npos);
  std::vector<std::byte> wider = good;
  wider[btf_head(test::small_btf()).size() + 4 + 3 * (12 + 2 * 8)] = std::byte{6};  // behind three views
  CHECK(refusal(wider).find("columns") != std::string::npos);
}
