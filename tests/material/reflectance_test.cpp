// The light that a material reflects as a whole, against sums over lights, views and texels.
#include "sdk/src/material/reflectance.h"

#include <cmath>
#include <numbers>

#include "tests/catch.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::material;

namespace {

// The radical inverse of i in a base, evenly spread over [0, 1).
float spread(std::uint32_t i, std::uint32_t base) {
  float value = 0, digit = 1;
  for (; i > 0; i /= base) {
    digit /= float(base);
    value += digit * float(i % base);
  }
  return value;
}

// Radiosity over irradiance under even light, with views weighted by their cosine and lights evenly spread.
Vec3 summed_reflectance(const MaterialTables& tables) {
  constexpr std::uint32_t samples = 60000;
  constexpr float two_pi = 2 * std::numbers::pi_v<float>;
  double sum[3] = {};
  for (std::uint32_t i = 1; i <= samples; ++i) {
    const float r = std::sqrt(spread(i, 2)), view_phi = two_pi * spread(i, 3);
    const float z = spread(i, 5), across = std::sqrt(1 - z * z), light_phi = two_pi * spread(i, 7);
    Sample sample;
    sample.u = spread(i, 11);
    sample.v = spread(i, 13);
    sample.view = {r * std::cos(view_phi), r * std::sin(view_phi), std::sqrt(1 - r * r)};
    sample.light = {across * std::cos(light_phi), across * std::sin(light_phi), z};
    const Radiance radiance = evaluate_btf(tables, sample);
    const float channel[3] = {radiance.red, radiance.green, radiance.blue};
    for (int c = 0; c < 3; ++c) sum[c] += double(two_pi * channel[c]) / samples;
  }
  return {float(sum[0]), float(sum[1]), float(sum[2])};
}

Material positive_material(float scale) {
  test::SampleSize size;
  size.lights = 40;
  Material material = test::sample_material(6, size);
  for (auto* values : {&material.btf.cores, &material.btf.x_bases, &material.btf.y_bases,
                       &material.btf.rows.coefficients, &material.light_basis})
    for (float& value : *values) value = std::abs(value);
  for (float& value : material.light_basis) value *= scale;
  return material;
}

}  // namespace

TEST_CASE("the mean reflectance equals sums over lights, views and texels") {
  const float whole = summed_reflectance(make_tables(positive_material(1), {}, default_memory(), 32)).x;
  const MaterialTables tables = make_tables(positive_material(0.4f / whole), {}, default_memory(), 32);
  const Vec3 wanted = summed_reflectance(tables), got = mean_reflectance(tables);
  // 256 views and 4,096 lights here, 60,000 samples there, of random numbers.
  CHECK(wanted.x == Approx(0.4f).epsilon(0.01));
  CHECK(got.x == Approx(wanted.x).epsilon(0.03));
  CHECK(got.y == Approx(wanted.y).epsilon(0.03));
  CHECK(got.z == Approx(wanted.z).epsilon(0.03));
}

TEST_CASE("no material reflects more light than it gets") {
  const float whole = summed_reflectance(make_tables(positive_material(1), {}, default_memory(), 32)).x;
  const Vec3 share = mean_reflectance(make_tables(positive_material(5 / whole), {}, default_memory(), 32));
  CHECK(share.x == 1);
}

TEST_CASE("materials of other lights or other holes have other hashes") {
  const auto hashes = [](const Material& material) {
    const MaterialTables tables = make_tables(material, {}, default_memory(), 8);
    return std::pair(tables.light_hash, tables.votf_hash);
  };
  const Material first = test::sample_material(1);
  const auto known = hashes(first);
  CHECK(known == hashes(test::sample_material(1)));
  Material changed = first;
  changed.light_basis[3] += 0.5f;
  CHECK(hashes(changed).first != known.first);
  CHECK(hashes(changed).second == known.second);
  changed = first;
  changed.votf.cores[2] += 0.5f;
  CHECK(hashes(changed).first == known.first);
  CHECK(hashes(changed).second != known.second);
  test::SampleSize size;
  size.visibility = VisibilityForm::none;
  CHECK(hashes(test::sample_material(1, size)).second == 0);
}
