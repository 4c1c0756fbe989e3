#include "bakers/measure/report/report_pictures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/report/html.h"
#include "bakers/raytrace/ray_scene.h"

namespace nook::report {
namespace {

using namespace bake;

float encoded(float linear) {
  const float value = std::clamp(linear, 0.0f, 1.0f);
  return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

constexpr float relief = 0.3f, margin = 1.06f, pi = std::numbers::pi_v<float>;
// Number of vertices whose visibility is tested to choose a view.
constexpr std::size_t tested_vertices = 3000;

Vec3 direction(float turn, float tilt) {
  return {std::cos(tilt) * std::sin(turn), std::sin(tilt), std::cos(tilt) * std::cos(turn)};
}

struct Box {
  Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Vec3 centre() const { return 0.5f * (low + high); }
};

// Returns the camera whose picture of this size contains all points.
BodyCamera camera_at(Vec3 towards, std::span<const Vec3> points, int width, int height) {
  Box box;
  for (const Vec3 p : points) box.add(p);
  const Vec3 right = normalised(cross(Vec3{0, 1, 0}, towards)), up = cross(towards, right);
  float wide = 0, high = 0;
  for (const Vec3 p : points) {
    wide = std::max(wide, std::fabs(dot(p - box.centre(), right)));
    high = std::max(high, std::fabs(dot(p - box.centre(), up)));
  }
  return {box.centre(), towards,
          // The lower bound gives a single point a scale.
          margin * std::max({2 * wide / float(width), 2 * high / float(height), 1e-6f})};
}

std::vector<Vec3> points_of(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices) {
  std::vector<Vec3> points;
  for (const std::uint32_t i : vertices) points.push_back(positions[i]);
  return points;
}

std::vector<std::uint32_t> all_vertices(std::size_t count) {
  std::vector<std::uint32_t> vertices(count);
  for (std::size_t i = 0; i < count; ++i) vertices[i] = std::uint32_t(i);
  return vertices;
}

using Json = nlohmann::ordered_json;

// WebGL reads the page's arrays in the byte order of the reader's machine. All relevant machines are
// little-endian.
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
  // The lower bound gives a flat body a size.
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

bake::Colour display(Vec3 linear) {
  return {encoded(linear.x), encoded(linear.y), encoded(linear.z)};
}

void set_pixel(bake::Picture& picture, int x, int y, bake::Colour colour) {
  std::uint8_t* pixel = &picture.rgb[3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))];
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] = std::uint8_t(std::lround(255 * std::clamp(colour[c], 0.0f, 1.0f)));
}

bake::Picture plain_picture(int width, int height, bake::Colour colour) {
  bake::Picture picture{width, height,
                        std::vector<std::uint8_t>(3 * std::size_t(width) * std::size_t(height))};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) set_pixel(picture, x, y, colour);
  return picture;
}

Vec3 view_of_error(const SkinnedMesh& mesh, const Pose& pose, std::span<const std::uint32_t> vertices,
                   std::span<const float> error) {
  std::vector<Vec3> posed, normals;
  skin_positions(mesh, pose, posed);
  posed_normals(mesh, pose, posed, normals);
  const RayScene scene({posed, mesh.triangle});
  Box box;
  for (const Vec3 p : posed) box.add(p);
  const float offset = 1e-4f * length(box.high - box.low);
  const std::size_t step = std::max<std::size_t>(1, vertices.size() / tested_vertices);
  std::vector<Vec3> views;
  for (const float tilt : {0.0f, 0.5f, -0.5f})
    for (int turn = 0; turn < 8; ++turn) views.push_back(direction(float(turn) * pi / 4, tilt));
  std::vector<double> seen(views.size(), 0.0);
  tbb::parallel_for(std::size_t(0), views.size(), [&](std::size_t v) {
    const FlushDenormals flush;
    for (std::size_t k = 0; k < vertices.size(); k += step) {
      const std::uint32_t i = vertices[k];
      const float cosine = dot(normals[i], views[v]);
      if (cosine <= 0 || scene.occluded(posed[i] + offset * normals[i], views[v])) continue;
      seen[v] += double(cosine) * double(error[i]) * double(error[i]);
    }
  });
  return views[std::size_t(std::ranges::max_element(seen) - seen.begin())];
}

std::vector<Picture> eight_sides(const SkinnedMesh& mesh, std::span<const float> vertex_rms) {
  constexpr int width = 300, sides = 8;
  std::vector<float> scaled(vertex_rms.begin(), vertex_rms.end());
  for (float& value : scaled) value /= error_end;
  // All eight pictures have the same scale. The widest view determines it. The height of the pictures fits
  // the body.
  float metres_per_pixel = 0;
  std::vector<BodyCamera> cameras;
  for (int side = 0; side < sides; ++side) {
    cameras.push_back(camera_at(direction(float(side) * pi / 4, 0), mesh.position, width, 2 * width));
    metres_per_pixel = std::max(metres_per_pixel, cameras.back().metres_per_pixel);
  }
  Box box;
  for (const Vec3 p : mesh.position) box.add(p);
  const int height =
      std::clamp(int(margin * (box.high.y - box.low.y) / metres_per_pixel), width / 3, 2 * width);
  std::vector<Picture> pictures;
  for (BodyCamera& camera : cameras) {
    camera.metres_per_pixel = metres_per_pixel;
    pictures.push_back(
        BodyView(mesh.triangle, mesh.position, camera, width, height).draw(scaled, viridis, relief));
  }
  return pictures;
}

Picture compare_pose(const SkinnedMesh& mesh, const MeasuredBody& body, std::size_t pose,
                     std::span<const std::uint32_t> vertices) {
  const bool is_whole = vertices.empty();
  const int width = 320, height = is_whole ? 440 : 320;
  std::vector<Vec3> posed;
  skin_positions(mesh, body.poses[pose], posed);
  std::vector<float> traced(posed.size()), error(posed.size()), shown(posed.size());
  for (std::size_t i = 0; i < posed.size(); ++i) {
    traced[i] = body.traced(pose, i);
    error[i] = std::fabs(traced[i] - body.model[pose][i]);
    shown[i] = error[i] / error_end;
  }
  const std::vector<std::uint32_t> whole =
      is_whole ? all_vertices(posed.size()) : std::vector<std::uint32_t>();
  const std::span<const std::uint32_t> looked_at =
      is_whole ? std::span<const std::uint32_t>(whole) : vertices;
  const Vec3 towards = view_of_error(mesh, body.poses[pose], looked_at, error);
  BodyCamera camera = camera_at(towards, points_of(posed, looked_at), width, height);
  if (!is_whole) {
    // The picture also shows the surroundings of the place, so that the reader can recognise it. Without
    // them, a place with a single vertex would have no size.
    Box body_box;
    for (const Vec3 p : posed) body_box.add(p);
    camera.metres_per_pixel =
        std::max(2.2f * camera.metres_per_pixel, 0.15f * length(body_box.high - body_box.low) / float(width));
  }
  const BodyView view(mesh.triangle, posed, camera, width, height);
  const std::vector<Picture> panels{view.draw(traced, grey), view.draw(body.model[pose], grey),
                                    view.draw(shown, viridis, relief)};
  return side_by_side(panels);
}

Turnable turnable_body(const SkinnedMesh& mesh, const MeasuredBody& body, std::span<const NamedPose> poses,
                       std::size_t max_bytes) {
  // Base64 takes four characters for three bytes.
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
