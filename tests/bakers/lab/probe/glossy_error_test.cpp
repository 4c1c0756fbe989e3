// Glossy reflection of probes: rows whose numbers are known.
#include "bakers/lab/probe/glossy_error.h"

#include <string>

#include "tests/bakers/probe/small_maps.h"
#include "tests/catch.h"

using namespace nook;

namespace {

nlohmann::ordered_json rows_of(const bake::Environment& map) {
  lab::GlossySettings settings;
  settings.surfaces = 64;
  return lab::glossy_rows(map, "map", settings, {});
}

double number(const nlohmann::ordered_json& row, const char* key) {
  return row.at(key).get<double>();
}

}  // namespace

TEST_CASE("under a constant map cube maps reflect the surface's albedo, and so do lobes of it") {
  for (const auto& row : rows_of(test::map_of(16, 8, [](Vec3) { return Vec3{2, 2, 2}; }))) {
    INFO(row.dump());
    const bool cube = row.at("form").get<std::string>().starts_with("cube");
    // The albedo's polynomials are within 1.2 % at reflectance 1; the sum of 12 lobes has ripples of up to a
    // tenth besides.
    CHECK(number(row, "map_rms") < (cube ? 0.015 : 0.1));
    CHECK(number(row, "percentile_95") <= number(row, "worst"));
    CHECK(number(row, "rms") <= number(row, "worst"));
  }
}

TEST_CASE("four lobes reflect a map's lobes at grazing views and with two widths") {
  const auto rows = rows_of(test::uneven_map());
  REQUIRE(rows.size() == 12);
  for (std::size_t kind = 0; kind < 12; kind += 4) {
    const auto& isotropic = rows[kind];
    const auto& anisotropic = rows[kind + 1];
    INFO(isotropic.dump() << anisotropic.dump());
    REQUIRE(anisotropic.at("form").get<std::string>() == "lobes, anisotropic");
    // A lamp has a third of the light, as in the maps of docs/probes.md.
    CHECK(number(anisotropic, "rms") < 0.1);
    if (kind != 4) CHECK(number(anisotropic, "rms") < 0.6 * number(isotropic, "rms"));
  }
}
