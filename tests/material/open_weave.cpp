#include "tests/material/open_weave.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/material/material_sample.h"

namespace nook::material::test {
namespace {

constexpr float pi = 3.14159265f;
constexpr int threads = 4;  // a side
// In tiles: how far threads go up and down.
constexpr float wave = 0.06f;

struct Hit {
  bool found = false;
  Vec3 at, normal;
  bool warp = false;
};

// Distance to the nearest thread; warp runs along v, weft along u, each over and under in turn.
struct Distance {
  float value = 1;
  bool warp = false;
};
Distance distance_at(Vec3 p, float radius) {
  Distance nearest;
  for (const bool warp : {true, false}) {
    const float across = (warp ? p.x : p.y) * threads, along = (warp ? p.y : p.x) * threads;
    const float thread = std::floor(across);
    const float sign = std::fmod(std::abs(thread), 2.0f) < 0.5f ? 1.0f : -1.0f;
    const float height = (warp ? wave : -wave) * sign * std::sin(pi * along);
    const float d = std::hypot((across - thread - 0.5f) / threads, p.z - height) - radius;
    if (d < nearest.value) nearest = {d, warp};
  }
  return nearest;
}

Vec3 normal_at(Vec3 p) {
  constexpr float h = 1e-3f;
  const auto at = [&](Vec3 offset) { return distance_at(p + offset, 0).value; };
  return normalised(
      {at({h, 0, 0}) - at({-h, 0, 0}), at({0, h, 0}) - at({0, -h, 0}), at({0, 0, h}) - at({0, 0, -h})});
}

// Until the ray leaves the cloth's height. Steps are shortened, for a thread's slope makes the distance an
// overestimate.
Hit trace(Vec3 from, Vec3 direction, float radius) {
  for (int step = 0; step < 200; ++step) {
    if (std::abs(from.z) > radius + wave + 1e-3f) return {};
    const Distance d = distance_at(from, radius);
    if (d.value < 1e-3f) return {true, from, normal_at(from), d.warp};
    from += direction * std::max(0.6f * d.value, 5e-4f);
  }
  return {};
}

std::array<float, 3> reflected(const Hit& hit, Vec3 view, Vec3 light, float radius) {
  const float cosine = dot(hit.normal, light);
  if (cosine <= 0 || trace(hit.at + hit.normal * 0.01f, light, radius).found) return {};
  const std::array<float, 3> albedo =
      hit.warp ? std::array{0.55f, 0.12f, 0.08f} : std::array{0.75f, 0.62f, 0.36f};
  const float shine = 0.12f * std::pow(std::max(dot(hit.normal, normalised(view + light)), 0.0f), 20.0f);
  return {cosine * (albedo[0] / pi + shine), cosine * (albedo[1] / pi + shine),
          cosine * (albedo[2] / pi + shine)};
}

// Distances to the other value of the mask, in half tiles, positive inside.
std::vector<float> signed_distance(const std::vector<float>& mask, int size) {
  std::vector<float> out(mask.size());
  const auto around = [&](int a, int b) {
    const int d = std::abs(a - b);
    return float(std::min(d, size - d));
  };
  for (int i = 0; i < int(mask.size()); ++i) {
    float least = float(size);
    for (int j = 0; j < int(mask.size()); ++j)
      if (mask[j] != mask[i])
        least = std::min(least, std::hypot(around(i % size, j % size), around(i / size, j / size)) - 0.5f);
    out[i] = std::clamp((mask[i] > 0.5f ? least : -least) * 2 / float(size), -1.0f, 1.0f);
  }
  return out;
}

// Texels of one view: radiance for each light and channel, and the mask.
struct ViewImage {
  std::vector<float> radiance, mask;
};
ViewImage look(Vec3 view, const Vector<Vec3>& lights, std::uint32_t size, float radius) {
  const std::size_t texels = std::size_t(size) * size;
  ViewImage image{std::vector<float>(3 * lights.size() * texels), std::vector<float>(texels)};
  for (std::size_t t = 0; t < texels; ++t) {
    const float u = (float(t % size) + 0.5f) / float(size), v = (float(t / size) + 0.5f) / float(size);
    // The texel lies on the plane in the middle; the ray begins above it.
    const Hit hit = trace(Vec3{u, v, 0} + view * ((radius + wave) / view.z), -view, radius);
    image.mask[t] = hit.found;
    for (std::size_t l = 0; hit.found && l < lights.size(); ++l) {
      const std::array<float, 3> colour = reflected(hit, view, lights[l], radius);
      for (std::size_t c = 0; c < 3; ++c) image.radiance[(3 * l + c) * texels + t] = colour[c];
    }
  }
  // Holes take the mean of what is seen, so that filters do not darken their rims.
  const double seen = std::max(1.0, double(std::count(image.mask.begin(), image.mask.end(), 1.0f)));
  for (std::size_t row = 0; row < 3 * lights.size(); ++row) {
    float* const first = &image.radiance[row * texels];
    double sum = 0;
    for (std::size_t t = 0; t < texels; ++t) sum += first[t];
    for (std::size_t t = 0; t < texels; ++t)
      if (image.mask[t] == 0) first[t] = float(sum / seen);
  }
  return image;
}

// Four views to a cluster, each of them one of its R_v = 4 view modes.
void set_rows(ClusteredTensor& tensor) {
  const std::uint32_t views = tensor.shape.views;
  tensor.rows.membership.resize(views);
  tensor.rows.coefficients.assign(std::size_t(4) * views, 0.0f);
  for (std::uint32_t v = 0; v < views; ++v) {
    tensor.rows.membership[v] = std::uint16_t(v / 4);
    tensor.rows.coefficients[4 * v + v % 4] = 1;
  }
}

}  // namespace

Material open_weave(const WeaveSize& size) {
  Material material;
  for (Vec3 d : hemisphere(size.lights)) material.lights.push_back(normalised({d.x, d.y, d.z + 0.05f}));
  // Not at the horizon itself, where a texel's ray meets the cloth far away.
  for (Vec3 d : hemisphere(size.views)) material.views.push_back(normalised({d.x, d.y, d.z + 0.2f}));
  const std::uint32_t rank = 3 * size.lights, texels = size.texels * size.texels;
  material.btf.shape = {size.views,  size.texels, size.texels,    rank, 4,
                        size.texels, size.texels, size.views / 4, 1};
  material.light_basis.assign(std::size_t(rank) * rank, 0.0f);
  for (std::uint32_t a = 0; a < rank; ++a) material.light_basis[std::size_t(a) * rank + a] = 1;
  material.btf.cores.resize(std::size_t(size.views) * rank * texels);
  material.visibility = size.visibility;
  material.mapping = paper_mapping(size.visibility);
  material.votf.shape = material.btf.shape;
  material.votf.shape.rank_light = 1;
  material.votf.cores.resize(std::size_t(size.views) * texels);
  for (std::uint32_t v = 0; v < size.views; ++v) {
    const ViewImage image = look(material.views[v], material.lights, size.texels, size.radius);
    const std::vector<float> value = size.visibility == VisibilityForm::distance
                                         ? signed_distance(image.mask, int(size.texels))
                                         : image.mask;
    for (std::uint32_t t = 0; t < texels; ++t) {
      // Cores are indexed by x before y.
      const std::size_t place = std::size_t(t % size.texels) * size.texels + t / size.texels;
      for (std::uint32_t a = 0; a < rank; ++a)
        material.btf.cores[((std::size_t(v / 4) * rank + a) * 4 + v % 4) * texels + place] =
            image.radiance[std::size_t(a) * texels + t];
      material.votf.cores[std::size_t(v) * texels + place] = value[t];
    }
  }
  set_rows(material.btf);
  set_rows(material.votf);
  if (size.visibility == VisibilityForm::none) {
    material.votf = ClusteredTensor();
    material.mapping = {};
  }
  return material;
}

}  // namespace nook::material::test
