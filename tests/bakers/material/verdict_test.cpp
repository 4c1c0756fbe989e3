// Materials judge themselves: 12 good, 12 poor and 12 hopeless ones that this file makes, against the error
// in views and lights that no bake ever saw.
#include "bakers/material/verdict.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/material/btf_error.h"
#include "bakers/material/seen_views.h"
#include "tests/catch.h"
#include "tests/sanitized.h"

using namespace nook;
using namespace nook::bake::material;

namespace {

constexpr std::uint32_t side = 12;

// A tile of matt colours with a glossy lobe on bumps. width is the lobe's, in the tangent of the half
// vector's tilt; strength is its share.
struct Look {
  float width, strength, bump;
  std::uint32_t seed;
};

Vec3 radiance_of(const Look& look, std::uint32_t x, std::uint32_t y, Vec3 light, Vec3 view) {
  const float u = 2 * std::numbers::pi_v<float> * (float(x) + 0.5f) / side,
              v = 2 * std::numbers::pi_v<float> * (float(y) + 0.5f) / side, phase = 0.7f * float(look.seed);
  const Vec3 albedo{0.5f + 0.3f * std::sin(u + phase), 0.4f + 0.2f * std::cos(v - phase), 0.3f};
  const Vec3 normal =
      normalised(Vec3{look.bump * std::cos(u + 2 * phase), look.bump * std::sin(2 * v + phase), 1});
  const Vec3 half = normalised(light + view);
  const float cosine = std::max(dot(half, normal), 1e-3f), tangent2 = 1 / (cosine * cosine) - 1;
  const float a2 = look.width * look.width;
  const float lobe = std::exp(-tangent2 / a2) / (4 * a2 * std::numbers::pi_v<float>);
  const Vec3 matt = albedo * (1 / std::numbers::pi_v<float>);
  return (matt * (1 - look.strength) + Vec3{lobe, lobe, lobe} * look.strength) * std::max(light.z, 0.0f);
}

RawMaterial made(const Look& look, const std::vector<Vec3>& lights, const std::vector<Vec3>& views) {
  RawMaterial raw;
  raw.name = "made";
  raw.lights = lights;
  raw.views = views;
  raw.width = raw.height = side;
  raw.btf.resize(raw.light_rows() * views.size() * raw.texels());
  for (std::size_t l = 0; l < lights.size(); ++l)
    for (std::size_t v = 0; v < views.size(); ++v)
      for (std::uint32_t x = 0; x < side; ++x)
        for (std::uint32_t y = 0; y < side; ++y) {
          const Vec3 rgb = radiance_of(look, x, y, lights[l], views[v]);
          const float channels[3] = {rgb.x, rgb.y, rgb.z};
          for (std::size_t c = 0; c < 3; ++c)
            raw.btf[((3 * l + c) * views.size() + v) * raw.texels() + x * side + y] = channels[c];
        }
  return raw;
}

CompressionSettings settings() {
  CompressionSettings s;
  s.rank_light = 12;
  s.cluster_rank_view = 4;
  s.clusters = 4;
  s.rank_view = 16;
  s.mixture = 2;
  s.rank_x = s.rank_y = 10;
  s.map_side = 16;
  s.visibility = nook::material::VisibilityForm::none;
  return s;
}

// The error of the whole bake between the directions of its fit, for another spiral that is turned.
double unseen_db(const Look& look, const RawMaterial& raw) {
  std::vector<Vec3> between = spiral_directions(31, 65);
  for (Vec3& d : between) d = {0.8f * d.x - 0.6f * d.y, 0.6f * d.x + 0.8f * d.y, d.z};
  const RawMaterial unseen = made(look, between, between);
  nook::material::Material seen = as_seen_from(compress(raw, settings()), unseen.views);
  light_from(seen, unseen.lights);
  return measure_btf(unseen, seen).se_db();
}

}  // namespace

TEST_CASE("every hopeless material is called bad, and no good one") {
  const std::vector<Vec3> directions = spiral_directions(36);
  int good = 0, poor = 0, hopeless = 0;
  constexpr int part = test::sanitized ? 4 : 1;
  for (std::uint32_t i = 0; i < 36; i += part) {
    // A third each: matt, of a wide gloss, and of a highlight between the directions of the fit.
    const float step = float(i % 12) / 11;
    const Look look = i < 12   ? Look{0.8f + 0.4f * step, 0.25f * step, 0.15f, i}
                      : i < 24 ? Look{0.25f + 0.09f * step, 0.3f, 0.1f, i}
                               : Look{0.03f + 0.07f * step, 0.9f, 0.05f + 0.1f * step, i};
    const RawMaterial raw = made(look, directions, directions);
    const double truth = unseen_db(look, raw);
    const Verdict verdict = judge(raw, settings());
    INFO("material " << i << ": " << truth << " dB unseen; " << verdict.words);
    REQUIRE(verdict.judged());
    if (truth >= 22) {
      ++good;
      CHECK(verdict.grade != Grade::bad);
    }
    if (truth >= 12 && truth < 22) ++poor;
    if (truth < 12) {
      ++hopeless;
      CHECK(verdict.grade == Grade::bad);
      CHECK(verdict.words.find("about 100 view and light directions") != std::string::npos);
    }
  }
  // The script makes what it promises.
  CHECK(good >= 12 / part);
  CHECK(poor >= 12 / part);
  CHECK(hopeless >= 12 / part);
}

TEST_CASE("a verdict has the same bits again, and says why a material is not judged") {
  const std::vector<Vec3> directions = spiral_directions(20);
  const RawMaterial raw = made({0.9f, 0.2f, 0.1f, 3}, directions, directions);
  CompressionSettings s = settings();
  const Verdict first = judge(raw, s), second = judge(raw, s);
  CHECK(first.held_out_db == second.held_out_db);
  CHECK(first.largest_step == second.largest_step);
  CHECK(describe(first).dump() == describe(second).dump());
  s.clusters = 1;
  s.rank_view = 4;
  s.mixture = 1;
  CHECK(judge(raw, s).one_cluster);
  s.rank_x = side;
  CHECK(judge(raw, s).ranks_at_cap);
  // A trial of 16 views has no room for 20 modes.
  s = settings();
  s.clusters = 5;
  s.rank_view = 20;
  CHECK(judge(raw, s).judged());
  s.method = Method::neural;
  CHECK_FALSE(judge(raw, s).judged());
  const std::vector<Vec3> few = spiral_directions(9);
  const Verdict none = judge(made({0.9f, 0.2f, 0.1f, 3}, few, few), settings());
  CHECK(none.grade == Grade::not_judged);
  CHECK(none.words.find("fewer than ten") != std::string::npos);
  CHECK(describe(none).at("verdict") == "not judged");
}
