// Errors over texels, in the way of Probulator.
#include "bakers/lab/probe/texel_error.h"

#include "tests/bakers/probe/small_maps.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::test;

namespace {

double number(const nlohmann::ordered_json& rows, const std::string& method, const char* key) {
  for (const auto& row : rows)
    if (row["method"] == method) return row[key];
  FAIL(method);
  return 0;
}

}  // namespace

TEST_CASE("a constant map has the error of the curve alone") {
  const auto rows = lab::texel_rows(map_of(64, 32, [](Vec3) { return Vec3{1, 1, 1}; }), "constant", 12);
  // The constant lobe holds the map, and the solve has floats.
  CHECK(number(rows, "least_squares, ambient", "radiance_rms") < 1e-3);
  // Light and normals share their shift of half a texel, which moves light at the poles by up to a texel of
  // 32 rows: irradiance over pi is off by less than a row's angle of pi / 32 in the mean.
  CHECK(number(rows, "sh_l2", "irradiance_rms") < 0.1);
}

TEST_CASE("over texels, least squares is the best of the lobes, and light and normals have the same axes") {
  const auto rows = lab::texel_rows(uneven_map(), "uneven", 12);
  const double best = number(rows, "least_squares", "radiance_rms");
  CHECK(number(rows, "naive", "radiance_rms") > best);
  // Least squares is the best over the samples, which are spread by solid angle; over texels, which are not,
  // a percent of it may be lost.
  CHECK(number(rows, "non_negative_least_squares", "radiance_rms") > 0.99 * best);
  CHECK(number(rows, "non_negative_least_squares", "irradiance_rms") >
        number(rows, "least_squares, bands", "irradiance_rms"));
  // Bands 0 to 2 hold this map, and half a texel of 64 x 32 is left. Light in other axes than the normals
  // would have an error of 0.6.
  const auto smooth = lab::texel_rows(map_of(64, 32,
                                             [](Vec3 d) {
                                               return Vec3{1, 1, 1} * (2 + d.x + 0.5f * d.z);
                                             }),
                                      "smooth", 12);
  CHECK(number(smooth, "sh_l2", "irradiance_rms") < 0.2);
}
