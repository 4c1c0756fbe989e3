#include "bakers/lab/nnao/mover_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/import/skinned_mesh.h"
#include "bakers/nnao/solids.h"
#include "sdk/src/core/failure.h"

namespace nook::lab {

using namespace bake::nnao;

namespace {

bool is_walk(std::string name) {
  std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return name.find("walk") != std::string::npos;
}

}  // namespace

MovingBody walking_body(const bake::ImportedCharacter& character, std::size_t clip,
                        const WalkSettings& settings) {
  MovingBody body{character.mesh.triangle, {}};
  const float whole_s = float(settings.frames - 1) * settings.frame_s;
  const float start_s = settings.phase * std::max(character.clips[clip].duration_s - whole_s, 0.0f);
  for (std::size_t f = 0; f < settings.frames; ++f) {
    const float time_s = float(f) * settings.frame_s;
    const Mat3x4 world = bake::nnao::moved(bake::nnao::standing_frame({}, settings.heading),
                                           {0, 0, settings.speed_mps * (time_s - whole_s)});
    std::vector<Vec3>& position = body.position.emplace_back();
    bake::skin_positions(character.mesh, bake::sample_clip(character, clip, start_s + time_s), position);
    for (Vec3& p : position) p = transform_point(world, p);
  }
  return body;
}

std::size_t walking_clip(const bake::ImportedCharacter& character, const std::string& name) {
  if (character.clips.empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "the file has no clip; give a file with a walking clip");
  if (!name.empty()) return bake::find_clip(character, name);
  const auto found =
      std::ranges::find_if(character.clips, [](const bake::Clip& clip) { return is_walk(clip.name); });
  return found == character.clips.end() ? 0 : std::size_t(found - character.clips.begin());
}

namespace {

// A traced frame. For each pixel, it stores the point of the body that the pixel shows.
struct MoverFrame {
  static constexpr std::uint32_t none = ~0u;

  TracedView view;
  std::vector<std::uint32_t> triangle;  // triangle of the body, or `none` for another surface or the sky
  std::vector<float> u, v;              // barycentric weights of the triangle's second and third vertex
};

bake::TriangleSoup with_body(bake::TriangleSoup soup, const MovingBody& body, std::size_t frame) {
  const auto first = std::uint32_t(soup.position.size());
  soup.position.insert(soup.position.end(), body.position[frame].begin(), body.position[frame].end());
  for (const auto& [a, b, c] : body.triangle) soup.triangle.push_back({first + a, first + b, first + c});
  return soup;
}

// `still` is the number of triangles of the static scene, which come before the body's triangles.
MoverFrame trace_frame(const bake::RayScene& rays, const Camera& camera, std::size_t still) {
  MoverFrame frame{{camera, {}, {}}, {}, {}, {}};
  const bake::FlushDenormals flush;
  for (std::uint32_t y = 0; y < camera.height; ++y)
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const PixelRay ray = pixel_ray(camera, float(x) + 0.5f, float(y) + 0.5f);
      const bake::RayHit hit = rays.nearest(ray.origin_ws, ray.direction_ws);
      frame.view.depth.push_back(hit.distance);
      frame.view.normal.push_back(view_direction(camera, hit.normal));
      const bool on_body = std::isfinite(hit.distance) && hit.triangle >= still;
      frame.triangle.push_back(on_body ? hit.triangle - std::uint32_t(still) : MoverFrame::none);
      frame.u.push_back(hit.u);
      frame.v.push_back(hit.v);
    }
  return frame;
}

Vec3 position_vs(const TracedView& view, std::size_t pixel) {
  const std::uint32_t width = view.camera.width;
  return nook::nnao::view_position(view.camera.rays, float(pixel % width) + 0.5f, float(pixel / width) + 0.5f,
                                   view.depth[pixel]);
}

// Returns the position of a pixel's surface in the previous frame, in the view space of that frame.
Vec3 earlier_position(const MoverFrame& now, const Camera& before, const std::vector<Vec3>& body,
                      const MovingBody& mover, std::size_t pixel) {
  if (now.triangle[pixel] == MoverFrame::none)
    return transform_point(earlier_from_view(now.view.camera, before), position_vs(now.view, pixel));
  const auto& [a, b, c] = mover.triangle[now.triangle[pixel]];
  const float u = now.u[pixel], v = now.v[pixel];
  const Vec3 position = (1 - u - v) * body[a] + u * body[b] + v * body[c];
  return transform_point(to_float(inverse(to_double(before.world_from_view))), position);
}

std::vector<float> motion_of(const MoverFrame& now, const Camera& before, const std::vector<Vec3>& body,
                             const MovingBody& mover) {
  std::vector<float> motion(2 * now.triangle.size());
  const std::uint32_t width = now.view.camera.width;
  for (std::size_t i = 0; i < now.triangle.size(); ++i) {
    if (!std::isfinite(now.view.depth[i])) continue;
    const ScreenPlace place = screen_place(before, earlier_position(now, before, body, mover, i));
    motion[2 * i] = float(i % width) - place.x;
    motion[2 * i + 1] = float(i / width) - place.y;
  }
  return motion;
}

// Returns for each pixel whether its surface is static and the body hides that surface in the frame `other`.
std::vector<bool> hidden_in(const MoverFrame& now, const MoverFrame& other) {
  const std::vector<EarlierPixels> earlier = earlier_pixels(now.view, other.view);
  const Camera& camera = other.view.camera;
  std::vector<bool> hidden(earlier.size());
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    if (earlier[i].seen() || now.triangle[i] != MoverFrame::none || !std::isfinite(now.view.depth[i]))
      continue;
    const auto [x, y, in_image] = screen_place(
        camera, transform_point(earlier_from_view(now.view.camera, camera), position_vs(now.view, i)));
    if (!in_image) continue;
    const auto column = std::uint32_t(std::clamp(std::round(x), 0.0f, float(camera.width - 1))),
               row = std::uint32_t(std::clamp(std::round(y), 0.0f, float(camera.height - 1)));
    hidden[i] = other.triangle[std::size_t(row) * camera.width + column] != MoverFrame::none;
  }
  return hidden;
}

bool is_beside(Vec3 point, const std::vector<Vec3>& vertices, float radius) {
  return std::ranges::any_of(vertices, [&](Vec3 vertex) {
    const Vec3 way = vertex - point;
    return dot(way, way) < radius * radius;
  });
}

std::vector<MoverPart> parts_of(const std::vector<MoverFrame>& frames, const MovingBody& body, float radius) {
  const MoverFrame& now = frames.back();
  const std::size_t recent = std::min(recent_frames, frames.size() - 1);
  std::vector<MoverPart> parts(now.triangle.size(), MoverPart::sky);
  std::vector<Vec3> vertices;
  for (std::size_t f = frames.size() - 1 - recent; f < frames.size(); ++f)
    vertices.insert(vertices.end(), body.position[f].begin(), body.position[f].end());
  std::vector<std::vector<bool>> hidden;
  for (std::size_t f = frames.size() - 1 - recent; f + 1 < frames.size(); ++f)
    hidden.push_back(hidden_in(now, frames[f]));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!std::isfinite(now.view.depth[i])) continue;
    const Vec3 point = transform_point(now.view.camera.world_from_view, position_vs(now.view, i));
    if (now.triangle[i] != MoverFrame::none)
      parts[i] = MoverPart::mover;
    else if (std::ranges::any_of(hidden, [&](const std::vector<bool>& frame) { return frame[i]; }))
      parts[i] = MoverPart::uncovered;
    else
      parts[i] = is_beside(point, vertices, radius) ? MoverPart::beside : MoverPart::elsewhere;
  }
  return parts;
}

}  // namespace

MoverView trace_mover(const bake::TriangleSoup& still, const MovingBody& body, const Camera& camera,
                      const TruthSettings& settings) {
  const std::size_t count = body.position.size();
  if (count < 2 || settings.path.frames != count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "movers: the body has %zu frames and the path %zu (need the same number, 2 or more)", count,
                  settings.path.frames);
  const bake::RayScene last(with_body(still, body, count - 1));
  std::vector<MoverFrame> frames(count);
  frames.back() = trace_frame(last, camera, still.triangle.size());
  const std::vector<Camera> cameras = path_cameras(bake::RayScene(still), frames.back().view, settings.path);
  for (std::size_t f = 0; f + 1 < count; ++f)
    frames[f] = trace_frame(bake::RayScene(with_body(still, body, f)), cameras[f], still.triangle.size());

  MoverView traced;
  traced.motion.emplace_back(2 * frames[0].triangle.size());
  for (std::size_t f = 1; f < count; ++f)
    traced.motion.push_back(motion_of(frames[f], frames[f - 1].view.camera, body.position[f - 1], body));
  traced.part = parts_of(frames, body, settings.radius);
  traced.measured.radius = settings.radius;
  traced.measured.truth =
      trace_truth(last, frames.back().view, settings.radius, settings.rays, settings.seed);
  for (std::size_t f = 0; f + 1 < count; ++f) traced.measured.path.push_back(std::move(frames[f].view));
  traced.measured.view = std::move(frames.back().view);
  return traced;
}

}  // namespace nook::lab
