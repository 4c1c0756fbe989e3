#include "bakers/lab/nnao/bent_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <numbers>

#include "bakers/lab/nnao/row_statistics.h"
#include "bakers/measure/nnao/network_pass.h"
#include "bakers/nnao/specular_fit.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/lighting.h"

namespace nook::lab {

using namespace measure;
using Json = nlohmann::ordered_json;

namespace {

// The edges to the left, right, lower and upper neighbour.
using Edges = std::array<float, 4>;

Edges unpacked(float packed) {
  const auto bits = std::uint32_t(packed * 255 + 0.5f);
  return {float(bits >> 6 & 3) / 3, float(bits >> 4 & 3) / 3, float(bits >> 2 & 3) / 3, float(bits & 3) / 3};
}

// An image that can be read at any coordinates. Outside the image, it returns the nearest pixel.
struct Clamped {
  std::span<const Vec3> vectors;
  std::span<const float> edges;
  int width, height;

  std::size_t at(int x, int y) const {
    return std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) +
           std::size_t(std::clamp(x, 0, width - 1));
  }
  Vec3 vector(int x, int y) const { return vectors[at(x, y)]; }
  Edges edges_at(int x, int y) const { return unpacked(edges[at(x, y)]); }
};

Vec3 averaged(const Clamped& image, int x, int y, float own_weight) {
  const Edges centre = image.edges_at(x, y), left = image.edges_at(x - 1, y),
              right = image.edges_at(x + 1, y), below = image.edges_at(x, y - 1),
              above = image.edges_at(x, y + 1);
  std::array<float, 4> near{centre[0] * left[1], centre[1] * right[0], centre[2] * below[3],
                            centre[3] * above[2]};
  const float connected = near[0] + near[1] + near[2] + near[3];
  const float leak = 0.5f * std::clamp((1.5f - connected) / 1.5f, 0.0f, 1.0f);
  for (float& weight : near) weight = std::min(weight + leak, 1.0f);
  const std::array<float, 4> diagonal{
      0.425f * (near[0] * left[2] + near[2] * below[0]), 0.425f * (near[1] * right[2] + near[2] * below[1]),
      0.425f * (near[0] * left[3] + near[3] * above[0]), 0.425f * (near[1] * right[3] + near[3] * above[1])};
  return own_weight * image.vector(x, y) + near[0] * image.vector(x - 1, y) +
         near[1] * image.vector(x + 1, y) + near[2] * image.vector(x, y - 1) +
         near[3] * image.vector(x, y + 1) + diagonal[0] * image.vector(x - 1, y - 1) +
         diagonal[1] * image.vector(x + 1, y - 1) + diagonal[2] * image.vector(x - 1, y + 1) +
         diagonal[3] * image.vector(x + 1, y + 1);
}

}  // namespace

std::vector<Vec3> edge_average(std::span<const Vec3> vectors, std::span<const float> packed_edges,
                               std::uint32_t width, bool last) {
  const Clamped image{vectors, packed_edges, int(width), int(vectors.size() / width)};
  const float own_weight = last ? 1.2f : 1.2f / 5;
  std::vector<Vec3> result(vectors.size());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      result[image.at(x, y)] = normalised(averaged(image, x, y, own_weight));
  return result;
}

namespace {

// The result of a method for a view. It has a bent normal for each pixel. It also has AO if the method
// computes AO that lighting can use.
struct BentView {
  std::vector<Vec3> bent_normal;
  std::vector<float> ao;
};

struct BentMethod {
  std::string name;
  int taps = 0;
  std::string denoiser;
  std::function<BentView(std::size_t view)> draw;
};

// Sums over the pixels of the views of one source.
struct BentSums {
  std::vector<double> degrees;
  std::array<double, measured_roughness.size()> fitted{}, lagarde{};
  double pixels = 0;  // number of pixels with AO
};

double degrees_between(Vec3 a, Vec3 b) {
  return std::acos(std::clamp(double(dot(a, b)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

double squared(float x) {
  return double(x) * double(x);
}

void add_pixel(BentSums& sums, const MeasuredView& view, const BentTruth& truth, const BentView& found,
               const nook::nnao::SpecularNumbers& numbers) {
  const Vec3 bent = found.bent_normal[truth.pixel];
  if (truth.ao < bent_below && length(truth.bent_normal) > 0)
    sums.degrees.push_back(degrees_between(bent, truth.bent_normal));
  if (found.ao.empty()) return;
  const std::uint32_t width = view.view.camera.width;
  const float ao = found.ao[truth.pixel], x = float(truth.pixel % width) + 0.5f,
              y = float(truth.pixel / width) + 0.5f;
  const Vec3 viewer = nook::nnao::to_viewer(
      view.view.camera.rays,
      nook::nnao::view_position(view.view.camera.rays, x, y, view.view.depth[truth.pixel]));
  const nook::nnao::LitPixel pixel{bent, view.view.normal[truth.pixel], viewer, ao};
  const float facing = dot(pixel.normal, viewer);
  for (std::size_t r = 0; r < measured_roughness.size(); ++r) {
    const float roughness = measured_roughness[r];
    sums.fitted[r] += squared(nook::nnao::specular_occlusion(numbers, pixel, roughness) - truth.specular[r]);
    sums.lagarde[r] += squared(bake::nnao::lagarde_occlusion(ao, facing, roughness) - truth.specular[r]);
  }
  sums.pixels += 1;
}

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / double(values.size());
}

Json row_of(const BentMethod& method, const std::string& scene, BentSums sums) {
  Json row{{"method", method.name}, {"taps", method.taps}, {"denoiser", method.denoiser}, {"scene", scene}};
  const std::size_t middle = sums.degrees.size() / 2;
  row["angle_mean"] = mean(sums.degrees);
  if (!sums.degrees.empty())
    std::nth_element(sums.degrees.begin(), sums.degrees.begin() + std::ptrdiff_t(middle), sums.degrees.end());
  row["angle"] = sums.degrees.empty() ? 0 : sums.degrees[middle];
  row["angles"] = sums.degrees.size();
  if (sums.pixels == 0) return row;
  for (auto* errors : {&sums.fitted, &sums.lagarde})
    for (double& error : *errors) error /= sums.pixels;
  row["specular_mse"] = mean(sums.fitted);
  row["lagarde_mse"] = mean(sums.lagarde);
  row["specular_ratio"] = mean(sums.fitted) / mean(sums.lagarde);
  row["specular_mse_by_roughness"] = sums.fitted;
  row["lagarde_mse_by_roughness"] = sums.lagarde;
  return row;
}

BentView reference_view(const MeasuredView& view) {
  BentView found{view.view.normal, std::vector<float>(view.view.depth.size(), 1.0f)};
  for (const BentTruth& truth : view.bent) {
    found.ao[truth.pixel] = truth.ao;
    if (length(truth.bent_normal) > 0) found.bent_normal[truth.pixel] = truth.bent_normal;
  }
  return found;
}

BentView network_view(const GladGLContext& gl, GLuint texture, int width, int height) {
  BentView found;
  const std::vector<float> rgba = read_rgba(gl, texture, width, height);
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    found.bent_normal.push_back(normalised({2 * rgba[i] - 1, 2 * rgba[i + 1] - 1, 2 * rgba[i + 2] - 1}));
    found.ao.push_back(rgba[i + 3]);
  }
  return found;
}

// Returns the mean of each numeric field over the sources. For ratios, this is the geometric mean.
Json mean_row(const std::vector<Json>& sources) {
  Json row = sources.front();
  row["scene"] = "mean";
  for (const char* key : {"angle", "angle_mean", "specular_mse", "lagarde_mse"}) {
    if (!row.contains(key)) continue;
    double sum = 0;
    for (const Json& source : sources) sum += source[key].get<double>() / double(sources.size());
    row[key] = sum;
  }
  if (!row.contains("specular_ratio")) return row;
  double logarithms = 0;
  for (const Json& source : sources)
    logarithms += std::log(source["specular_ratio"].get<double>()) / double(sources.size());
  row["specular_ratio"] = std::exp(logarithms);
  for (const char* key : {"specular_mse_by_roughness", "lagarde_mse_by_roughness"})
    for (std::size_t r = 0; r < measured_roughness.size(); ++r) {
      double sum = 0;
      for (const Json& source : sources) sum += source[key][r].get<double>() / double(sources.size());
      row[key][r] = sum;
    }
  return row;
}

}  // namespace

Json bent_rows(platform::Context& context, std::span<const MeasuredView> views, AoRequest request,
               const std::function<bool(std::size_t, std::size_t)>& progress) {
  const GladGLContext& gl = context.gl();
  const int width = int(views.front().view.camera.width), height = int(views.front().view.camera.height);
  const NookGl nook_gl(context);
  std::deque<GpuView> images;
  for (const MeasuredView& view : views) images.emplace_back(gl, view.view);
  const auto request_of = [&](std::size_t view) {
    AoRequest asked = request;
    asked.radius = views[view].radius;
    return asked;
  };

  std::vector<BentMethod> methods;
  methods.push_back({"normal", 0, "none", [&](std::size_t v) { return BentView{views[v].view.normal, {}}; }});
  methods.push_back({"reference", 0, "none", [&](std::size_t v) { return reference_view(views[v]); }});
  std::vector<std::unique_ptr<NetworkPass>> passes;
  for (const NetworkForm& form :
       {NetworkForm{9, true, 1, true}, NetworkForm{9, false, 1, true}, NetworkForm{16, false, 1, true},
        NetworkForm{32, false, 1, true}, NetworkForm{64, false, 1, true}}) {
    passes.push_back(std::make_unique<NetworkPass>(nook_gl, width, height, form, std::span<const std::byte>{},
                                                   request.blur_sharpness));
    NetworkPass* const pass = passes.back().get();
    methods.push_back(
        {form.half_resolution ? "nnao_half" : "nnao", form.taps, "library", [&, pass](std::size_t v) {
           return network_view(gl, pass->draw(images[v], request_of(v), true), width, height);
         }});
  }
  BaselinePass baselines(gl, width, height);
  for (const BaselineMethod& baseline : baseline_methods()) {
    if (baseline.baseline != Baseline::xegtao) continue;
    for (const int denoised : {1, 3})
      methods.push_back({baseline_name(baseline.baseline), baseline.taps, "edges_" + std::to_string(denoised),
                         [&, denoised](std::size_t v) {
                           BaselinePass::BentImage image =
                               baselines.draw_bent(baseline, images[v], request_of(v));
                           for (int pass = 0; pass < denoised; ++pass)
                             image.bent_normal = edge_average(image.bent_normal, image.edges,
                                                              std::uint32_t(width), pass + 1 == denoised);
                           return BentView{std::move(image.bent_normal), {}};
                         }});
  }

  Json rows = Json::array();
  const nook::nnao::SpecularNumbers numbers = nook::nnao::specular_numbers();
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::map<std::string, BentSums> sources;
    for (std::size_t v = 0; v < views.size(); ++v) {
      const BentView found = methods[m].draw(v);
      for (const BentTruth& truth : views[v].bent)
        add_pixel(sources[views[v].source], views[v], truth, found, numbers);
    }
    std::vector<Json> of_sources;
    for (auto& [source, sums] : sources) of_sources.push_back(row_of(methods[m], source, std::move(sums)));
    for (const Json& row : of_sources) rows.push_back(row);
    rows.push_back(mean_row(of_sources));
    if (!progress(m + 1, methods.size())) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring");
  }
  return rows;
}

std::string bent_markdown(const Json& rows) {
  std::string text =
      "| method | taps | denoiser | angle, median | angle, mean | specular mse | Lagarde's form of the same "
      "AO | ratio |\n|---|---|---|---|---|---|---|---|\n";
  for (const Json& row : rows) {
    if (row["scene"] != "mean") continue;
    text.append("| ").append(row["method"].get<std::string>()).append(" | ").append(row["taps"].dump());
    text.append(" | ").append(row["denoiser"].get<std::string>()).append(" | ");
    text.append(table_number(row, "angle", "%.1f"))
        .append(" | ")
        .append(table_number(row, "angle_mean", "%.1f"));
    text.append(" | ").append(table_number(row, "specular_mse", "%.4f")).append(" | ");
    text.append(table_number(row, "lagarde_mse", "%.4f"))
        .append(" | ")
        .append(table_number(row, "specular_ratio", "%.2f"));
    text += " |\n";
  }
  return text;
}

}  // namespace nook::lab
