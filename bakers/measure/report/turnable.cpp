#include "bakers/measure/report/turnable.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/report/body_pictures.h"
#include "bakers/measure/report/template.h"

namespace nook::report {
namespace {

using namespace bake;
using Json = nlohmann::ordered_json;

// WebGL reads the page's arrays in the order of the machine, which is this one everywhere.
static_assert(std::endian::native == std::endian::little);

template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64(numbers.data(), numbers.size() * sizeof(Number));
}

std::uint8_t byte_of(float ao) {
  return std::uint8_t(std::lround(255 * std::clamp(ao, 0.0f, 1.0f)));
}

Json pose_data(const SkinnedMesh& mesh, const MeasuredBody& body, const NamedPose& named) {
  std::vector<Vec3> posed;
  skin_positions(mesh, body.poses[named.pose], posed);
  std::array<float, 3> low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f}, size{};
  for (const Vec3 p : posed) {
    const std::array<float, 3> at{p.x, p.y, p.z};
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], at[c]);
      high[c] = std::max(high[c], at[c]);
    }
  }
  // A flat body also has a size.
  for (std::size_t c = 0; c < 3; ++c) size[c] = std::max(high[c] - low[c], 1e-6f);
  std::vector<std::uint16_t> positions;
  std::vector<std::uint8_t> traced, model;
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const std::array<float, 3> at{posed[i].x, posed[i].y, posed[i].z};
    for (std::size_t c = 0; c < 3; ++c)
      positions.push_back(
          std::uint16_t(std::lround(65535 * std::clamp((at[c] - low[c]) / size[c], 0.0f, 1.0f))));
    traced.push_back(byte_of(body.traced(named.pose, i)));
    model.push_back(byte_of(body.model[named.pose][i]));
  }
  return {{"name", named.name},
          {"low", low},
          {"size", size},
          {"positions", base64_of(positions)},
          {"traced", base64_of(traced)},
          {"model", base64_of(model)}};
}

}  // namespace

Turnable turnable_body(const SkinnedMesh& mesh, const MeasuredBody& body, std::span<const NamedPose> poses,
                       std::size_t max_bytes) {
  // Base64 takes four letters for three bytes.
  const std::size_t triangle_bytes = 4 * (mesh.triangle.size() * 12) / 3,
                    pose_bytes = 4 * (mesh.vertex_count() * 8) / 3;
  if (triangle_bytes + pose_bytes > max_bytes || poses.empty())
    return {Html("<p>The body has too many triangles for a view within this page; <code>nook evaluate "
                 "character --images</code> draws it at any size.</p>\n"),
            {}};
  const std::size_t count = std::min(poses.size(), (max_bytes - triangle_bytes) / pose_bytes);
  Json data;
  data["errorEnd"] = error_end;
  constexpr int stops = 16;
  for (int i = 0; i <= stops; ++i) data["ramp"].push_back(viridis(float(i) / stops));
  data["triangles"] = base64(mesh.triangle.data(), mesh.triangle.size() * sizeof mesh.triangle[0]);
  for (const NamedPose& pose : poses.first(count)) data["poses"].push_back(pose_data(mesh, body, pose));
  return {fill("turn.html", {}), Html("<script type=\"application/json\" id=\"turn-data\">") +
                                     script_data(data) + Html("</script>\n<script>\n") + fill("turn.js", {}) +
                                     Html("</script>\n")};
}

}  // namespace nook::report
