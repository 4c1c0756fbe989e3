#include "bakers/measure/character/bent_study.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>

#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/character_error.h"
#include "bakers/nnao/specular_fit.h"
#include "bakers/raytrace/environment.h"
#include "bakers/raytrace/random.h"
#include "bakers/raytrace/ray_scene.h"
#include "bakers/raytrace/specular_visibility.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/lighting.h"
#include "shaders/character/specular_numbers.h"

namespace nook::measure {
namespace {

using Json = nlohmann::ordered_json;

Vec3 skinned(const bake::SkinWeights& weights, const bake::Pose& pose, Vec3 v) {
  Vec3 sum;
  for (int b = 0; b < bake::SkinWeights::max_bones; ++b)
    if (weights.weight[b] > 0) sum += weights.weight[b] * transform_vector(pose[weights.bone[b]], v);
  return sum;
}

constexpr std::size_t units = nook::nnao::SpecularNumbers::units,
                      inputs = nook::nnao::SpecularNumbers::inputs;

// Writes a row as two lines of four numbers.
void append_row(std::string& text, int& line, std::span<const float, units> row) {
  char part[160];
  for (std::size_t first = 0; first < units; first += 4) {
    std::snprintf(part, sizeof part, "#define NOOK_SCENE_SPECULAR_%d %.5f, %.5f, %.5f, %.5f\n", line++,
                  double(row[first]), double(row[first + 1]), double(row[first + 2]), double(row[first + 3]));
    text += part;
  }
}

constexpr std::array<float, 5> roughness{0.1f, 0.3f, 0.5f, 0.7f, 0.9f};
// Angles are only measured where the reference AO is below this value. Elsewhere, the plain normal is good
// enough.
constexpr float dark_below = 0.7f;

enum Method { plain_normal, nook_bent, reference, method_count };
constexpr const char* method_names[] = {"normal", "nook", "reference"};

// A vertex in a pose, and the result of each method for it.
struct Point {
  std::size_t vertex = 0;
  Vec3 to_viewer;
  float traced_ao = 1;
  Vec3 traced_bent;  // unit length, or zero if no direction is open
  struct {
    float ao = 1;
    Vec3 bent;
  } said[method_count];
  // For each roughness, two independently traced references.
  std::array<bake::GlossyLight, 2> light[roughness.size()];
};

// Returns a random direction from which the vertex is visible, uniform over the hemisphere. Returns zero if
// no attempt finds one.
Vec3 find_viewer(const bake::RayScene& scene, Vec3 origin, Vec3 normal, bake::Random& random) {
  constexpr int tries = 16;
  constexpr float lowest = 0.05f;  // smallest cosine; faces seen at a more oblique angle hardly cover a pixel
  const bake::Frame frame = bake::turned_frame(normal, 1, 0);
  for (int t = 0; t < tries; ++t) {
    const float up = random.between(lowest, 1), angle = random.between(0, 6.2831853f),
                aside = std::sqrt(1 - up * up);
    const Vec3 direction = bake::to_world(frame, Vec3{aside * std::cos(angle), aside * std::sin(angle), up});
    if (!std::isfinite(scene.nearest(origin, direction).distance)) return direction;
  }
  return {};
}

std::vector<Point> measure_pose(const bake::SkinnedMesh& mesh, const BentBody& body,
                                std::span<const bake::Environment> maps, const BentStudy& study,
                                std::uint64_t seed) {
  const bake::RayScene scene(bake::TriangleSoup{body.position, mesh.triangle});
  const float offset = bake::ray_origin_offset(mesh.position);
  std::vector<Point> points(study.points);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 16), [&](const auto& range) {
    const bake::FlushDenormals flush;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      bake::Random random(bake::mix_bits(seed ^ bake::mix_bits(i)));
      Point& point = points[i];
      point.vertex = random.below(std::uint32_t(mesh.vertex_count()));
      const Vec3 n = body.normal[point.vertex];
      const Vec3 origin = body.position[point.vertex] + offset * n;
      point.to_viewer = find_viewer(scene, origin, n, random);
      if (point.to_viewer == Vec3{}) continue;
      const bake::GlossyPoint glossy{body.position[point.vertex], n, point.to_viewer,
                                     std::numeric_limits<float>::infinity(), offset};
      for (std::size_t r = 0; r < roughness.size(); ++r)
        for (bake::GlossyLight& light : point.light[r])
          light = bake::trace_glossy_light(scene, glossy, roughness[r], std::max(study.rays / 8, 1u),
                                           random.bits(), maps);
    }
  });
  std::erase_if(points, [](const Point& p) { return p.to_viewer == Vec3{}; });

  std::vector<Vec3> position, normal;
  for (const Point& point : points) {
    position.push_back(body.position[point.vertex]);
    normal.push_back(body.normal[point.vertex]);
  }
  bake::AoSettings settings;
  settings.rays = study.rays;
  settings.seed = seed;
  settings.origin_offset = offset;
  const bake::Openness open = bake::trace_openness(scene, {position, normal}, settings);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Point& point = points[i];
    const std::size_t v = point.vertex;
    point.traced_ao = open.ao[i];
    point.traced_bent = length(open.direction[i]) > 0 ? normalised(open.direction[i]) : Vec3{};
    point.said[plain_normal] = {body.ao[v], normal[i]};
    point.said[nook_bent] = {body.ao[v], body.bent[v]};
    point.said[reference] = {point.traced_ao, point.traced_bent == Vec3{} ? normal[i] : point.traced_bent};
  }
  return points;
}

// The sums of one method over all points, for uniform light and for each map.
struct Sums {
  std::vector<double> degrees;
  std::vector<std::array<double, roughness.size()>> bent, lagarde;
};

double product(Vec3 a, Vec3 b) {
  return (double(a.x) * double(b.x) + double(a.y) * double(b.y) + double(a.z) * double(b.z)) / 3;
}

void add_point(Sums& sums, const Point& point, Vec3 normal, Method method, std::size_t maps,
               const nook::nnao::SpecularNumbers& numbers) {
  const auto& said = point.said[method];
  if (point.traced_ao < dark_below && !(point.traced_bent == Vec3{}))
    sums.degrees.push_back(std::acos(std::clamp(double(dot(said.bent, point.traced_bent)), -1.0, 1.0)) * 180 /
                           std::numbers::pi);
  const nook::nnao::LitPixel lit{said.bent, normal, point.to_viewer, said.ao};
  for (std::size_t r = 0; r < roughness.size(); ++r) {
    const auto add = [&](float share, std::vector<std::array<double, roughness.size()>>& into) {
      const auto& [one, other] = point.light[r];
      into[0][r] += (double(share) - double(one.visible)) * (double(share) - double(other.visible));
      for (std::size_t m = 0; m < maps; ++m)
        into[1 + m][r] += product(share * one.open[m] - one.seen[m], share * other.open[m] - other.seen[m]);
    };
    add(nook::nnao::specular_occlusion(numbers, lit, roughness[r]), sums.bent);
    add(bake::nnao::lagarde_occlusion(said.ao, dot(normal, point.to_viewer), roughness[r]), sums.lagarde);
  }
}

// Calls visit(point, normal) for the points of all poses in order.
template <class Visit>
void for_each_point(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                    std::span<const bake::Pose> poses, std::span<const bake::Environment> maps,
                    const BentStudy& study, const bake::Progress& progress, Visit&& visit) {
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const BentBody body = bent_body(mesh, model, poses[p]);
    for (const Point& point : measure_pose(mesh, body, maps, study, bake::mix_bits(study.seed + p)))
      visit(point, body.normal[point.vertex]);
    if (progress && !progress(p + 1, poses.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing (%zu of %zu poses done)", p + 1,
                    poses.size());
  }
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Json row_of(Method method, const std::string& map, std::size_t poses, std::size_t points, Sums& sums,
            std::size_t light, double unit) {
  Json row{{"method", method_names[method]}, {"map", map}, {"poses", poses}, {"points", points}};
  double mean = 0;
  for (const double angle : sums.degrees) mean += angle / double(sums.degrees.size());
  row["angle_median"] = quantile(sums.degrees, 0.5);
  row["angle_mean"] = mean;
  row["angle_p90"] = quantile(sums.degrees, 0.9);
  const auto means = [&](std::array<double, roughness.size()> errors) {
    for (double& error : errors) error /= double(points) * unit * unit;
    return errors;
  };
  const auto bent = means(sums.bent[light]), lagarde = means(sums.lagarde[light]);
  double bent_mean = 0, lagarde_mean = 0;
  for (std::size_t r = 0; r < roughness.size(); ++r) {
    bent_mean += bent[r] / double(roughness.size());
    lagarde_mean += lagarde[r] / double(roughness.size());
  }
  row["specular_mse"] = bent_mean;
  row["lagarde_mse"] = lagarde_mean;
  row["specular_ratio"] = lagarde_mean > 0 ? bent_mean / lagarde_mean : 0;
  row["specular_mse_by_roughness"] = bent;
  row["lagarde_mse_by_roughness"] = lagarde;
  return row;
}

}  // namespace

BentBody bent_body(const bake::SkinnedMesh& mesh, const CharacterModel& model, const bake::Pose& pose) {
  if (model.occluded.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the model was baked without bent normals; add them with `nook bake bent`");
  BentBody body;
  bake::skin_positions(mesh, pose, body.position);
  bake::posed_normals(mesh, pose, body.position, body.normal);
  body.ao = predict_ao(model, pose);
  for (std::size_t v = 0; v < body.position.size(); ++v)
    body.bent.push_back(
        bent_normal(body.normal[v], skinned(mesh.weights[v], pose, model.occluded[v].at(body.ao[v]))));
  return body;
}

nook::nnao::SpecularNumbers character_specular_numbers() {
  constexpr float rows[7][8] = {
      {NOOK_SCENE_SPECULAR_0, NOOK_SCENE_SPECULAR_1},   {NOOK_SCENE_SPECULAR_2, NOOK_SCENE_SPECULAR_3},
      {NOOK_SCENE_SPECULAR_4, NOOK_SCENE_SPECULAR_5},   {NOOK_SCENE_SPECULAR_6, NOOK_SCENE_SPECULAR_7},
      {NOOK_SCENE_SPECULAR_8, NOOK_SCENE_SPECULAR_9},   {NOOK_SCENE_SPECULAR_10, NOOK_SCENE_SPECULAR_11},
      {NOOK_SCENE_SPECULAR_12, NOOK_SCENE_SPECULAR_13},
  };
  nook::nnao::SpecularNumbers numbers;
  for (std::size_t u = 0; u < units; ++u) {
    for (std::size_t i = 0; i < inputs; ++i) numbers.weights[i][u] = rows[i][u];
    numbers.bias[u] = rows[5][u];
    numbers.out[u] = rows[6][u];
  }
  numbers.out_bias = NOOK_SCENE_SPECULAR_BIAS;
  return numbers;
}

std::string character_specular_header(const nook::nnao::SpecularNumbers& numbers) {
  std::string text =
      "// The numbers of the specular occlusion of characters; sdk/src/nnao/lighting.h defines them. C++ "
      "and\n"
      "// GLSL both include this file, which `nook train bent` writes from the built-in character.\n"
      "#ifndef NOOK_CHARACTER_SPECULAR_NUMBERS_H\n#define NOOK_CHARACTER_SPECULAR_NUMBERS_H\n\n";
  int line = 0;
  for (const auto& row : numbers.weights) append_row(text, line, row);
  append_row(text, line, numbers.bias);
  append_row(text, line, numbers.out);
  char bias[80];
  std::snprintf(bias, sizeof bias, "#define NOOK_SCENE_SPECULAR_BIAS %.5f\n\n#endif\n",
                double(numbers.out_bias));
  return text + bias;
}

Json bent_rows(const bake::SkinnedMesh& mesh, const CharacterModel& model, std::span<const bake::Pose> poses,
               std::span<const GlossyMap> maps, const BentStudy& study, const bake::Progress& progress) {
  if (maps.size() > bake::max_glossy_maps)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "there are too many maps (got %zu, need at most %zu)",
                  maps.size(), bake::max_glossy_maps);
  std::vector<bake::Environment> lights;
  for (const GlossyMap& map : maps) lights.push_back(map.light);
  const nook::nnao::SpecularNumbers numbers = character_specular_numbers();
  std::array<Sums, method_count> sums;
  for (Sums& of_method : sums) {
    of_method.bent.resize(1 + maps.size());
    of_method.lagarde.resize(1 + maps.size());
  }
  std::size_t points = 0;
  for_each_point(mesh, model, poses, lights, study, progress, [&](const Point& point, Vec3 normal) {
    for (int m = 0; m < method_count; ++m) add_point(sums[m], point, normal, Method(m), maps.size(), numbers);
    ++points;
  });
  Json rows = Json::array();
  for (std::size_t light = 0; light <= maps.size(); ++light)
    for (int m = 0; m < method_count; ++m)
      rows.push_back(row_of(Method(m), light == 0 ? "visibility" : maps[light - 1].name, poses.size(), points,
                            sums[m], light, light == 0 ? 1 : mean_radiance(lights[light - 1])));
  return rows;
}

std::vector<bake::nnao::SpecularSample> bent_samples(const bake::SkinnedMesh& mesh,
                                                     const CharacterModel& model,
                                                     std::span<const bake::Pose> poses,
                                                     const BentStudy& study, const bake::Progress& progress) {
  std::vector<bake::nnao::SpecularSample> samples;
  for_each_point(mesh, model, poses, {}, study, progress, [&](const Point& point, Vec3 normal) {
    const auto pixel = [&](Method method) {
      return nook::nnao::LitPixel{point.said[method].bent, normal, point.to_viewer, point.said[method].ao};
    };
    bake::nnao::SpecularSample& sample = samples.emplace_back();
    sample.reference = pixel(reference);
    sample.network = pixel(nook_bent);
    for (std::size_t r = 0; r < roughness.size(); ++r) {
      sample.roughness[r] = roughness[r];
      sample.visible[r] = (point.light[r][0].visible + point.light[r][1].visible) / 2;
    }
  });
  return samples;
}

double mean_radiance(const bake::Environment& map) {
  double sum = 0;
  for (std::uint32_t row = 0; row < map.height(); ++row)
    for (std::uint32_t column = 0; column < map.width(); ++column) {
      const Vec3 texel = map.texel(std::size_t(row) * map.width() + column);
      sum += map.solid_angle(row) * (double(texel.x) + double(texel.y) + double(texel.z)) / 3;
    }
  return sum / (4 * std::numbers::pi);
}

bake::Environment coarse_map(const bake::Environment& with_suns, std::uint32_t width) {
  const bake::Environment map = bake::without_suns(with_suns);
  const std::uint32_t height = width / 2;
  std::vector<double> sum(std::size_t(width) * height * 3, 0.0), weight(std::size_t(width) * height, 0.0);
  for (std::uint32_t y = 0; y < map.height(); ++y)
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      const std::size_t at = std::size_t(y * height / map.height()) * width + x * width / map.width();
      const Vec3 texel = map.texel(std::size_t(y) * map.width() + x);
      const double angle = map.solid_angle(y);
      weight[at] += angle;
      sum[3 * at] += angle * double(texel.x);
      sum[3 * at + 1] += angle * double(texel.y);
      sum[3 * at + 2] += angle * double(texel.z);
    }
  std::vector<float> rgb;
  for (std::size_t i = 0; i < sum.size(); ++i)
    rgb.push_back(weight[i / 3] > 0 ? float(sum[i] / weight[i / 3]) : 0);
  return {width, height, std::move(rgb)};
}

}  // namespace nook::measure
