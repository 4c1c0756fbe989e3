// Directional occlusion: its means against quadrature, its ratio against ray tracing of one sphere over a
// surface, and every instruction set against the formulas in double precision.
#include "sdk/src/character/directional_occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sdk/src/character/kernel.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "tests/catch.h"
#include "tests/character/kernel_reference.h"

using namespace nook;
using namespace nook::test;

namespace {

bool within(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::abs(b);
}

// Twelve lobes on a Vogel spiral, each channel of its own brightness, as a probe has them.
std::vector<LightLobe> uneven_light(std::mt19937& random, float sharpness = 6, int count = 12) {
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<LightLobe> lobes;
  for (int i = 0; i < count; ++i) {
    const float y = 1 - (2 * float(i) + 1) / float(count), r = std::sqrt(1 - y * y),
                a = 2.3999632f * float(i);
    const auto bright = [&] { return std::pow(unit(random), 4.0f); };
    const Vec3 amplitude{bright(), bright(), bright()};
    lobes.push_back({Vec3{r * std::cos(a), y, r * std::sin(a)} * sharpness, sharpness, amplitude, 1});
  }
  return lobes;
}

LightView view_of(const std::vector<LightLobe>& lobes) {
  return {lobes.data(), std::uint32_t(lobes.size()), {1e-3f, 1e-3f, 1e-3f}};
}

// Directions of equal solid angle over the sphere.
const std::vector<Vec3>& even_directions() {
  static const std::vector<Vec3> directions = [] {
    std::vector<Vec3> d;
    constexpr int count = 60'000;
    for (int i = 0; i < count; ++i) {
      const double y = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - y * y), a = 2.399963229728653 * i;
      d.push_back({float(r * std::cos(a)), float(y), float(r * std::sin(a))});
    }
    return d;
  }();
  return directions;
}

double value_at(const LightLobe& lobe, Vec3 s) {
  return std::exp(double(dot(lobe.vector, s)) - double(lobe.sharpness));
}

struct Pose {
  Vec3 offset;  // of the sphere's centre from the point, in its radii
  Vec3 normal;
};

// Share of a channel's irradiance that arrives from behind the sphere, and its share of the hemisphere.
struct Blocked {
  double light, share;
};
Blocked traced(const std::vector<double>& radiance, const Pose& pose) {
  double light = 0, light_behind = 0, all = 0, behind = 0;
  const std::vector<Vec3>& directions = even_directions();
  const double gap = dot(pose.offset, pose.offset) - 1;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double cosine = dot(directions[i], pose.normal);
    if (cosine <= 0) continue;
    const double along = dot(directions[i], pose.offset);
    const bool hit = along > 0 && along * along > gap;
    all += cosine;
    light += cosine * radiance[i];
    if (!hit) continue;
    behind += cosine;
    light_behind += cosine * radiance[i];
  }
  return {light_behind / light, behind / all};
}

Colour<double> ratio_of(const LightView& light, const Pose& pose) {
  const Direction<double> n{pose.normal.x, pose.normal.y, pose.normal.z};
  const Direction<double> o{pose.offset.x, pose.offset.y, pose.offset.z};
  const double xi = dot(pose.offset, pose.normal), delta2 = dot(pose.offset, pose.offset);
  const double share = form_factor_exact(xi, delta2);
  return light_ratio(light, inverse_hemisphere(light, n), n, sight_of(n, o, xi, delta2), share,
                     double(no_sharpest));
}

LightBands bands_of(const std::vector<LightLobe>& lobes) {
  LightBands bands;
  bands.darkest = {1e-3f, 1e-3f, 1e-3f};
  for (const LightLobe& lobe : lobes) {
    const std::array<float, 5> own = gaussian_bands(lobe.sharpness);
    const Vec3 mean = lobe.amplitude * (gaussian_integral(lobe.sharpness) / gaussian_integral(0.0f));
    const Vec3 axis = normalised(lobe.vector);
    const float a[3] = {axis.x, axis.y, axis.z};
    bands.scalar += mean;
    for (int i = 0; i < 3; ++i) {
      bands.vector[i] += mean * (3 * own[1] * a[i]);
      bands.tensor[i] += mean * (7.5f * own[2] * (a[i] * a[i] - 1.0f / 3));
      bands.tensor[3 + i] += mean * (15 * own[2] * a[i] * a[(i + 1) % 3]);
    }
  }
  return bands;
}

// A colour at each key point.
struct Lanes {
  Lanes(std::uint32_t count, float value) {
    for (int c = 0; c < 3; ++c) {
      values[c].assign(count, value);
      rgb[c] = values[c].data();
    }
  }
  std::vector<float> values[3];
  float* rgb[3];
};

}  // namespace

TEST_CASE("the mean of lobes under a density has the closed form") {
  std::mt19937 random(3);
  for (const float sharpness : {0.0f, 0.5f, 6.0f, 60.0f})
    for (const float concentration : {0.0f, 0.3f, 2.133f, 12.0f, 90.0f}) {
      const std::vector<LightLobe> lobes = uneven_light(random, sharpness);
      const Vec3 b = random_direction(random) * concentration;
      double mean = 0, mass = 0;
      for (const Vec3 s : even_directions()) {
        const double weight = std::exp(double(dot(b, s)) - double(concentration));
        mass += weight;
        for (const LightLobe& lobe : lobes) mean += weight * value_at(lobe, s) * double(lobe.amplitude.y);
      }
      const Colour<double> closed = mean_radiance(view_of(lobes), Direction<double>{b.x, b.y, b.z});
      INFO("sharpness " << sharpness << " concentration " << concentration);
      // Twice the error of lobe_norm; quadrature is far below it.
      CHECK(within(closed.g, mean / mass, 0.012));
    }
}

TEST_CASE("lobe_norm keeps its bound over its range") {
  for (double v = 1e-6; v < 1e6; v *= 1.1) CHECK(within(lobe_norm(v), -std::expm1(-2 * v) / v, 0.006));
  CHECK(lobe_norm(0.0) == 2);
  CHECK(std::isfinite(lobe_norm(1e6f)));
}

TEST_CASE("under constant light every sphere takes its share") {
  const std::vector<LightLobe> lobes = {{{}, 0, {0.2f, 1, 3}, 1}};
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    const Pose pose{random_direction(random) * std::exp(float(i % 20) * 0.4f - 2), random_direction(random)};
    const Colour<double> ratio = ratio_of(view_of(lobes), pose);
    CHECK(within(ratio.r, 1, 1e-6));
    CHECK(within(ratio.g, 1, 1e-6));
    CHECK(within(ratio.b, 1, 1e-6));
    const Direction<double> n{pose.normal.x, pose.normal.y, pose.normal.z};
    GatheredBands<double> gathered = GatheredBands<double>::none();
    gathered.add(Direction<double>{pose.offset.x + 3 * n.x, pose.offset.y + 3 * n.y, pose.offset.z + 3 * n.z},
                 0.4);
    CHECK(within(coloured_sum(gathered, bands_of(lobes), n).b, 0.4, 1e-6));
    const Colour<double> ground = ground_ratio(view_of(lobes), n, {0, 1, 0});
    CHECK(within(ground.g, 1, 1e-6));
  }
}

TEST_CASE("bands 0 to 2 hold the mean of broad light under a density") {
  std::mt19937 random(8);
  for (const float sharpness : {0.5f, 2.0f, 6.0f})
    for (const float concentration : {2.133f, 4.0f, 12.0f}) {
      const std::vector<LightLobe> lobes = uneven_light(random, sharpness);
      const Vec3 b = random_direction(random) * concentration;
      double mean = 0, mass = 0, brightest = 0;
      for (const Vec3 s : even_directions()) {
        const double weight = std::exp(double(dot(b, s)) - double(concentration));
        double radiance = 0;
        for (const LightLobe& lobe : lobes) radiance += value_at(lobe, s) * double(lobe.amplitude.y);
        mean += weight * radiance;
        mass += weight;
        brightest = std::max(brightest, radiance);
      }
      GatheredBands<double> gathered = GatheredBands<double>::none();
      gathered.add(Direction<double>{b.x, b.y, b.z}, 1.0);
      INFO("sharpness " << sharpness << " concentration " << concentration);
      // Band 3 and above, and e^(-2 |b|): 0.1 of the brightest where both are narrow.
      const double allowed = sharpness * concentration > 24 ? 0.1 : 0.04;
      CHECK(std::abs(gathered.light(bands_of(lobes), &Vec3::y) - mean / mass) < allowed * brightest);
    }
}

TEST_CASE("the share of a lobe below the horizon keeps its bound") {
  for (const float sharpness : {0.01f, 0.5f, 2.0f, 4.0f, 8.0f, 30.0f, 100.0f})
    for (float height = -1; height <= 1; height += 0.125f) {
      const LightLobe lobe{Vec3{std::sqrt(1 - height * height), height, 0} * sharpness, sharpness, {}, 1};
      double below = 0, all = 0;
      for (const Vec3 s : even_directions()) {
        const double v = value_at(lobe, s);
        all += v;
        if (s.y < 0) below += v;
      }
      INFO("sharpness " << sharpness << " height " << height);
      CHECK(std::abs(share_below(double(height * sharpness), double(sharpness)) - below / all) < 0.017);
    }
  for (const float huge : {1e4f, 2e4f}) {
    CHECK(share_below(huge, huge) < 1e-15f);
    CHECK(share_below(-huge, huge) == 1);
  }
}

TEST_CASE("the light that a sphere over a surface takes agrees with ray tracing") {
  std::mt19937 random(5);
  double squares = 0, squares_without = 0;
  int count = 0;
  for (int light_number = 0; light_number < 4; ++light_number) {
    const std::vector<LightLobe> lobes = uneven_light(random);
    std::vector<double> radiance;
    for (const Vec3 s : even_directions()) {
      double sum = 0;
      for (const LightLobe& lobe : lobes) sum += value_at(lobe, s) * double(lobe.amplitude.x);
      radiance.push_back(sum);
    }
    for (const float distance : {1.05f, 1.3f, 1.7f, 2.5f, 4.0f})
      for (const float height : {-0.2f, 0.1f, 0.4f, 0.8f, 1.0f}) {
        const Vec3 n = random_direction(random);
        const Vec3 across = normalised(cross(n, random_direction(random)));
        const Pose pose{(n * height + across * std::sqrt(1 - height * height)) * distance, n};
        const Blocked truth = traced(radiance, pose);
        if (truth.share < 0.005) continue;
        const double error = ratio_of(view_of(lobes), pose).r * truth.share - truth.light;
        squares += error * error;
        squares_without += (truth.share - truth.light) * (truth.share - truth.light);
        ++count;
      }
  }
  REQUIRE(count > 60);
  INFO("rms " << std::sqrt(squares / count) << ", of the share alone " << std::sqrt(squares_without / count));
  // A sphere is a round lobe here whatever the horizon leaves of it: a third of the error remains, in rms.
  CHECK(squares < 0.12 * squares_without);
}

TEST_CASE("the ground takes the light from below, as rays say") {
  // The plane y = 0 under surfaces of every slope, near enough to a sphere of a huge radius.
  std::mt19937 random(7);
  double squares = 0, squares_without = 0;
  for (int light_number = 0; light_number < 6; ++light_number) {
    const std::vector<LightLobe> lobes = uneven_light(random);
    for (float slope = -1; slope <= 1; slope += 0.25f) {
      const Vec3 across = normalised(cross(Vec3{0, 1, 0}, random_direction(random)));
      const Vec3 n = Vec3{0, slope, 0} + across * std::sqrt(1 - slope * slope);
      double light = 0, taken = 0;
      for (const Vec3 s : even_directions()) {
        double radiance = 0;
        for (const LightLobe& lobe : lobes) radiance += value_at(lobe, s) * double(lobe.amplitude.x);
        const double cosine = std::max(double(dot(s, n)), 0.0);
        light += cosine * radiance;
        if (s.y < 0) taken += cosine * radiance;
      }
      const double share = 0.5 * (1 - double(slope));
      const Colour<double> ratio =
          ground_ratio(view_of(lobes), Direction<double>{n.x, n.y, n.z}, Direction<double>{0, 1, 0});
      const double error = std::min(ratio.r * share, 1.0) - taken / light;
      squares += error * error;
      squares_without += (share - taken / light) * (share - taken / light);
    }
  }
  INFO("rms " << std::sqrt(squares / 54) << ", of the share alone " << std::sqrt(squares_without / 54));
  // The lobe that stands for the clamped cosine reaches below the surface's own horizon.
  CHECK(squares < 0.06 * squares_without);
}

TEST_CASE("directional sums follow the formulas on every instruction set") {
  std::mt19937 random(6);
  const std::vector<LightLobe> lobes = uneven_light(random);
  const LightView light = view_of(lobes);
  const LightBands bands = bands_of(lobes);
  const Spheres spheres = random_spheres(random, 37);
  const Points points = random_points(random, 40);
  const SphereSoa s = spheres.view();
  const KeyPointSoa p = points.view();
  const Vec3 up = random_direction(random);
  const Direction<double> above{up.x, up.y, up.z};
  for (const ShadowKernels* kernels : available_kernels())
    for (const float gamma : {1.0f, 1.5f, 2.0f, 1.3f})
      for (const KernelForm form : {KernelForm::nook, KernelForm::paper, KernelForm::rational}) {
        INFO(kernels->name << " gamma " << gamma << " form " << int(form));
        Lanes norm(p.padded_count, 0), depth(p.padded_count, 0), open(p.padded_count, 1),
            ground(p.padded_count, 1), inverse(p.padded_count, 0);
        kernels->directional_norm_sum(s, p, {form, gamma}, bands, norm.rgb);
        kernels->directional_hemisphere(p, light, inverse.rgb);
        kernels->directional_depth(s, p, light, inverse.rgb, depth.rgb);
        kernels->directional_open(s, p, light, inverse.rgb, open.rgb);
        kernels->directional_ground(s, p, light, up, ground.rgb);
        double worst = 0;
        const auto compare = [&](float found, double want) {
          worst = std::max(worst, std::abs(double(found) - want) / std::max(1.0, want));
        };
        for (std::uint32_t k = 0; k < points.count; ++k) {
          double open_k = 1;
          JointSight<double> joint;
          const Direction<double> n{p.nx[k], p.ny[k], p.nz[k]};
          GatheredBands<double> gathered = GatheredBands<double>::none();
          const Colour<double> dark = inverse_hemisphere(light, n);
          for (std::uint32_t i = 0; i < s.count; ++i) {
            const double scale = s.inverse_radius[i];
            const Direction<double> o{(double(s.x[i]) - p.x[k]) * scale, (double(s.y[i]) - p.y[k]) * scale,
                                      (double(s.z[i]) - p.z[k]) * scale};
            const View v = view_of(s, i, p, k);
            const Sight<double> sight = sight_of(n, o, v.xi, v.delta2);
            const double y = std::max(shadow_term(form, v.xi, v.delta2), 0.0);
            gather(gathered, n, sight, y, std::pow(y, double(gamma)));
            joint.add(sight, form_factor_fast(v.xi, v.delta2) * double(s.caster_weight[i]));
            const double share = std::min(form_factor_exact(v.xi, v.delta2), 1.0);
            open_k *=
                1 - std::min(share * light_ratio(light, dark, n, sight, share, double(no_sharpest)).g, 1.0);
            if (i == 0) compare(ground.rgb[1][k], 1 - std::min(share * ground_ratio(light, n, above).g, 1.0));
          }
          compare(norm.rgb[1][k], coloured_sum(gathered, bands, n).g);
          compare(
              depth.rgb[1][k],
              solid_depth(joint.taken) *
                  light_ratio(light, dark, n, joint.mean(n), std::min(joint.taken, 1.0), joint.sharpest()).g);
          compare(open.rgb[1][k], open_k);
        }
        // Sums of 37 terms with the estimates of roots that the plain kernels have, twice: in the term and in
        // the ratio.
        CHECK(worst < 1e-3);
      }
}
