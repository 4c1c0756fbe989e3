#include "bakers/measure/report/pages.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bakers/measure/report/advice.h"
#include "bakers/measure/transfer/vector_error.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/transfer/distant_light.h"

namespace nook::report {
namespace {

using namespace bake;
using nook::transfer::Transfer;

constexpr int width_px = 360, height_px = 360, sides = 4;
constexpr std::uint32_t truth_rays = 128;

// Returns the cosine-weighted mean of each vertex's shares. This mean is the vertex's AO in the file.
std::vector<float> mean_shares(const Transfer& baked, const SurfaceMesh& mesh) {
  std::vector<Vec3> axes(baked.lobes);
  nook::transfer::lobe_axes(axes);
  std::vector<float> mean(baked.vertex_count());
  tbb::parallel_for(std::size_t(0), mean.size(), [&](std::size_t i) {
    float sum = 0, weight = 0;
    for (std::size_t j = 0; j < axes.size(); ++j) {
      const float cosine = dot(axes[j], mesh.normal[i]);
      if (cosine <= 0) continue;
      sum += cosine * float(baked.shares_of(i)[j]) / 255;
      weight += cosine;
    }
    mean[i] = weight > 0 ? sum / weight : 1;
  });
  return mean;
}

std::vector<float> traced_openness(const SurfaceMesh& mesh) {
  AoSettings settings;
  settings.rays = truth_rays;
  settings.origin_offset = ray_origin_offset(mesh.position);
  return trace_ao(TriangleSoup{mesh.position, mesh.triangle}, {mesh.position, mesh.normal}, settings);
}

float radius_of(const SurfaceMesh& mesh, Vec3& centre) {
  Vec3 low = mesh.position.front(), high = low;
  for (const Vec3 p : mesh.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  centre = 0.5f * (low + high);
  return 0.5f * length(high - low);
}

Html pictures(const SurfaceMesh& mesh, const std::vector<float>& baked, const std::vector<float>& traced) {
  Vec3 centre;
  const float radius = radius_of(mesh, centre);
  constexpr std::array<const char*, sides> names{"the front", "the left", "the back", "the right"};
  Html html;
  for (int side = 0; side < sides; ++side) {
    const float turn = float(side) * std::numbers::pi_v<float> / 2;
    const BodyCamera camera{centre, normalised({std::sin(turn), 0.4f, std::cos(turn)}),
                            2.1f * radius / width_px};
    const BodyView view(mesh.triangle, mesh.position, camera, width_px, height_px);
    const std::array<Picture, 2> panels{view.draw(traced, grey), view.draw(baked, grey)};
    std::string alternative = "The shape from ";
    alternative.append(names[std::size_t(side)]).append(": its openness, ray traced and from the file");
    html += figure(side_by_side(panels), alternative,
                   Html("from ") + text(names[std::size_t(side)]) + Html(", ray traced and from the file"));
  }
  return html;
}

}  // namespace

PageParts transfer_parts(std::size_t bytes, const Transfer& baked, const SurfaceMesh& mesh) {
  if (!measure::is_baked_mesh(mesh, baked))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "was baked from another mesh than this source; bake the transfer again");
  Measures measures;
  measures.value["bytes_per_vertex"] = double(bytes) / double(baked.vertex_count());
  measures.value["bounces"] = double(baked.bounces);
  PageParts parts;
  parts.lead = text(std::to_string(baked.vertex_count())) + Html(" vertices in ") +
               byte_count(double(bytes)) + Html(", with the light of ") + text(std::to_string(baked.lobes)) +
               Html(" lobes at each.");
  if (baked.paper.is_used()) {
    parts.sections = Html(
        "<section id=\"shape\"><h2>The shape</h2>\n<p>The file has the paper's form, which works only with "
        "the material that it was baked for; <code>nook evaluate transfer --images</code> draws it under a "
        "map.</p>\n</section>\n");
  } else {
    const std::vector<float> open = mean_shares(baked, mesh), traced = traced_openness(mesh);
    double sum = 0, square = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      sum += double(open[i]);
      square += double(open[i] - traced[i]) * double(open[i] - traced[i]);
    }
    measures.value["open_share"] = sum / double(open.size());
    parts.lead += Html(" Its openness, the mean over the lobes, differs from ray tracing by <strong>") +
                  number(std::sqrt(square / double(open.size()))) +
                  Html("</strong> of the way from dark (0) to open (1).");
    parts.sections = Html(
                         "<section id=\"shape\"><h2>The shape</h2>\n<p>The share of a uniform sky's light "
                         "that reaches each vertex: black is none, white is all. The file stores such a "
                         "share for each lobe separately.</p>\n<div class=\"row\">") +
                     pictures(mesh, open, traced) + Html("</div></section>\n");
  }
  parts.advice = advice_list(Subject::transfer, measures);
  return parts;
}

}  // namespace nook::report
