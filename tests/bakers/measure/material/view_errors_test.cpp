#include "bakers/measure/material/view_errors.h"

#include <cmath>

#include "bakers/material/btf_error.h"
#include "bakers/material/compression.h"
#include "bakers/material/raw_material.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/parabolic.h"
#include "tests/bakers/material/small_material.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;
namespace nm = nook::material;

namespace {

// A BTF that is linear in the parabolic map of the view, so that linear interpolation between views is exact.
RawMaterial linear_material(std::vector<Vec3> views) {
  RawMaterial raw = test::small_material(4, std::uint32_t(views.size()), 6, 8);
  raw.views = std::move(views);
  std::size_t at = 0;
  for (std::size_t row = 0; row < raw.light_rows(); ++row)
    for (const Vec3 view : raw.views) {
      const nm::ParabolicPoint p = nm::to_parabolic(view);
      for (std::size_t texel = 0; texel < raw.texels(); ++texel)
        raw.btf[at++] = 1 + 0.1f * float(row) + 0.8f * p.x * std::sin(float(texel)) + 0.5f * p.y;
    }
  return raw;
}

CompressionSettings full_ranks(Method method) {
  CompressionSettings s;
  s.method = method;
  s.rank_light = 12;
  s.rank_view = 24;
  s.rank_x = 6;
  s.rank_y = 8;
  s.votf_rank_x = 6;
  s.votf_rank_y = 8;
  s.visibility = nm::VisibilityForm::none;
  return s;
}

}  // namespace

TEST_CASE("a material linear in the parabolic map is right in views that the fit has not seen") {
  const RawMaterial raw = linear_material(spiral_directions(24));
  // Inside the outermost views, beyond which the value at the rim is taken.
  std::vector<Vec3> between;
  for (int i = 0; i < 9; ++i)
    between.push_back(nm::from_parabolic({0.35f * std::cos(float(i)), 0.35f * std::sin(2.0f * float(i))}));
  const RawMaterial unseen = linear_material(between);
  // A cell of the map is 1/256 wide, by which values up to 2 change by up to 0.004: 54 dB or more. K-CTA's
  // thin-plate spline reproduces linear functions too.
  for (const Method method : {Method::n_svd, Method::cta, Method::k_cta}) {
    CompressionSettings s = full_ranks(method);
    s.clusters = 6;
    s.map_side = 256;
    CHECK(measure_unseen(unseen, compress(raw, s)).se_db > 50);
  }
}

TEST_CASE("unseen views of a VOTF are counted against their own masks") {
  const RawMaterial raw = test::small_material(6, 24, 12, 16);
  CompressionSettings s = full_ranks(Method::n_svd);
  s.visibility = nm::VisibilityForm::distance;
  s.rank_light = 18;
  s.rank_x = s.votf_rank_x = 12;
  s.rank_y = s.votf_rank_y = 16;
  const nm::Material material = compress(raw, s);
  RawMaterial unseen = test::small_material(6, 15, 12, 16);
  const std::size_t wrong = *measure_unseen(unseen, material).error_texels;
  for (float& visible : unseen.mask) visible = 1 - visible;
  CHECK(*measure_unseen(unseen, material).error_texels == unseen.mask.size() - wrong);
  CHECK(wrong < unseen.mask.size() / 10);
}

TEST_CASE("a material linear in the parabolic map is right under lights that the fit has not seen") {
  const auto lit = [](std::uint32_t lights, std::uint32_t views, float max_tilt) {
    RawMaterial raw = test::small_material(lights, views, 6, 8);
    raw.lights = spiral_directions(lights, max_tilt);
    std::size_t at = 0;
    for (std::size_t row = 0; row < raw.light_rows(); ++row) {
      const nm::ParabolicPoint p = nm::to_parabolic(raw.lights[row / 3]);
      for (std::size_t i = 0; i < raw.views.size() * raw.texels(); ++i)
        raw.btf[at++] = (1 + float(i % raw.texels())) * (1 + 0.5f * p.x - 0.3f * p.y);
    }
    return raw;
  };
  const nm::Material material = compress(lit(24, 24, 75), full_ranks(Method::n_svd));
  // Inside the outermost lights, where interpolation is exact; floats leave 50 dB or more.
  CHECK(measure_unseen(lit(15, 24, 50), material).se_db > 50);
  CHECK(measure_unseen(lit(15, 9, 50), material).se_db > 50);
  CHECK_THROWS_AS(measure_unseen(test::small_material(15, 9, 6, 9), material), Failure);
}
