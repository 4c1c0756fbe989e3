#include "sdk/src/gl/world/body_watch.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sdk/src/gl/world/caster_texels.h"
#include "sdk/src/nnao/host_depth.h"
#include "sdk/src/world/tile_lists.h"

namespace nook::gl {
namespace {

using View = std::array<float, 16>;

Vec3 translation_of(const View& m) {
  return {m[12], m[13], m[14]};
}

View moved(View m, float factor) {
  for (std::size_t i = 12; i < 15; ++i) m[i] *= factor;
  return m;
}

Vec3 eye_of(const View& m) {
  const Vec3 t = translation_of(m);
  return {-dot({m[0], m[1], m[2]}, t), -dot({m[4], m[5], m[6]}, t), -dot({m[8], m[9], m[10]}, t)};
}

// The inverse of a rotation with a translation.
View inverse_of(const View& m) {
  const Vec3 eye = eye_of(m);
  return {m[0], m[4], m[8], 0, m[1], m[5], m[9], 0, m[2], m[6], m[10], 0, eye.x, eye.y, eye.z, 1};
}

View given_view(const View& m) {
  return m;
}
View centimetre_view(const View& m) {
  return moved(m, 0.01f);
}
View metre_view(const View& m) {
  return moved(m, 100);
}

// What the host may have confused. With `view` and the factors, bodies are where they would be without the
// mistake.
struct Mistake {
  View (*view)(const View& given);
  float world_factor, view_factor;  // of lengths in world space, and then in view space
  const char* what;
  const char* advice;
};
constexpr const char* bodies_advice =
    "give poses, capsules and occluders in the unit of frame.view and frame.projection";
constexpr const char* view_advice = "give frame.view in the unit of poses, capsules and frame.projection";
constexpr const char* depth_advice =
    "give frame.projection and linear depth in the unit of poses and frame.view";
constexpr Mistake mistakes[] = {
    {inverse_of, 1, 1, "the mask would show the bodies if frame.view were inverted",
     "frame.view is the matrix from view space to world space: set it to the inverse"},
    {given_view, 0.01f, 1, "the mask would show the bodies if they were in a world 100 times smaller",
     bodies_advice},
    {given_view, 100, 1, "the mask would show the bodies if they were in a world 100 times larger",
     bodies_advice},
    {centimetre_view, 1, 1,
     "the mask would show the bodies if the translation of frame.view were 100 times smaller", view_advice},
    {metre_view, 1, 1,
     "the mask would show the bodies if the translation of frame.view were 100 times larger", view_advice},
    {given_view, 1, 0.01f, "the mask would show the bodies if depth were 100 times larger", depth_advice},
    {given_view, 1, 100, "the mask would show the bodies if depth were 100 times smaller", depth_advice},
};

world::TileGrid one_tile(const NnaoFrame& screen) {
  const Viewport viewport = viewport_of(screen);
  world::TileGrid grid;
  grid.width_px = std::uint32_t(viewport.width);
  grid.height_px = std::uint32_t(viewport.height);
  const nnao::ScreenRays rays = nnao::projection_rays(screen.projection, grid.width_px, grid.height_px);
  grid.x_scale = rays.x_scale;
  grid.x_offset = rays.x_offset;
  grid.y_scale = rays.y_scale;
  grid.y_offset = rays.y_offset;
  grid.orthographic = rays.orthographic;
  grid.tile_px = std::max(grid.width_px, grid.height_px);
  return grid;
}

struct Ball {
  Vec3 centre;
  float radius = 0;
};

// A ball inside the thickest capsule. Its radius is half of the capsule's, because capsules may be a little
// thicker than the body.
Ball middle_of(const ReachingGroup& group) {
  const auto radius = [](const PosedCaster& c) { return c.capsule.radius_a + c.capsule.radius_b; };
  const PosedCaster& thickest =
      *std::max_element(group.casters.begin(), group.casters.end(),
                        [&](const PosedCaster& a, const PosedCaster& b) { return radius(a) < radius(b); });
  return {0.5f * (thickest.capsule.a + thickest.capsule.b), 0.25f * radius(thickest)};
}

// The bodies in view that are nearest to the camera.
class NearestBodies {
 public:
  void add(const Ball& around, const Ball& middle) {
    const float distance = length(around.centre);
    std::size_t place = count_;
    if (count_ < NOOK_WATCHED_BODIES) {
      ++count_;
    } else {
      place = std::size_t(std::max_element(distances_.begin(), distances_.end()) - distances_.begin());
      if (distances_[place] <= distance) return;
    }
    distances_[place] = distance;
    put(8 * place, around);
    put(8 * place + 4, middle);
  }
  WatchedBodies kept() const { return {spheres_, count_}; }

 private:
  void put(std::size_t at, const Ball& ball) {
    spheres_[at] = ball.centre.x;
    spheres_[at + 1] = ball.centre.y;
    spheres_[at + 2] = ball.centre.z;
    spheres_[at + 3] = ball.radius;
  }

  std::array<float, NOOK_WATCHED_BODIES> distances_{};
  std::array<float, 8 * NOOK_WATCHED_BODIES> spheres_{};
  std::size_t count_ = 0;
};

// Calls visit for each group that has casters.
template <class Visit>
void each_group(const ReachingGroups& groups, Visit&& visit) {
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    PosedCaster room;
    const ReachingGroup group = groups.group(groups.user, g, room);
    if (!group.casters.empty()) visit(group);
  }
}

// Returns the bodies in view as they would be without a mistake.
WatchedBodies bodies_without(const Mistake& mistake, const WorldFrame& frame, const ReachingGroups& groups) {
  View given;
  std::copy_n(frame.view, given.size(), given.begin());
  const View view = mistake.view(given);
  const float factor = mistake.world_factor * mistake.view_factor;
  const world::TileGrid grid = one_tile(frame.screen);
  NearestBodies nearest;
  const auto placed = [&](Vec3 centre, float radius) {
    return Ball{mistake.view_factor * viewed(view.data(), mistake.world_factor * centre), factor * radius};
  };
  each_group(groups, [&](const ReachingGroup& group) {
    // Skin may be a little outside of the capsules.
    const Ball around = placed(group.centre, 1.2f * group.radius);
    // A body that is enlarged around the camera would contain all surfaces.
    if (factor > 1 && length(around.centre) < around.radius) return;
    if (world::covered_tiles(grid, around.centre, around.radius).empty) return;
    const Ball middle = middle_of(group);
    nearest.add(around, placed(middle.centre, middle.radius));
  });
  return nearest.kept();
}

constexpr Mistake no_mistake{given_view, 1, 1, "", ""};
static_assert(std::size(mistakes) == BodyWatch::mistake_count);

// Returns the radius of the smallest body that consists of several casters, or 0 if there is none. Props of
// one capsule, such as a cup, may be much smaller than everything in view.
float smallest_radius(const ReachingGroups& groups) {
  float smallest = 0;
  each_group(groups, [&](const ReachingGroup& group) {
    if (group.casters.size() > 1 && (smallest == 0 || group.radius < smallest)) smallest = group.radius;
  });
  return smallest;
}

bool has_casters(const ReachingGroups& groups) {
  bool found = false;
  each_group(groups, [&](const ReachingGroup&) { found = true; });
  return found;
}

bool is_identity(const float* view) {
  for (int i = 0; i < 16; ++i)
    if (view[i] != (i % 5 == 0 ? 1.0f : 0.0f)) return false;
  return true;
}

// The number of frames, one after another, that must look wrong. Without a mask, the bodies may be absent
// from depth for a while, for example if they are drawn later and jump, or if their meshes are still loading.
// With a mask, each mistake is tried twice before.
constexpr int least_wrong_frames = 60, least_masked_frames = 2 * int(std::size(mistakes)) + 2;
// A camera may look at the shadow side of a wall for a while.
constexpr int least_unlit_frames = 120;
// The number of frames after which bodies without a mask are surely where depth shows them.
constexpr int enough_right_frames = 10;
// The number of frames in which a mistake must explain the mask.
constexpr int least_explained_frames = 2;

}  // namespace

BodyWatch::BodyWatch(Device& device)
    : target_(device.gl.profile == Profile::desktop ? GL_SAMPLES_PASSED : GL_ANY_SAMPLES_PASSED) {
  for (Query& query : queries_) query.object = Object::make(device, Object::Kind::query);
}

bool BodyWatch::asks(int question) const {
  if (question == NOOK_BODIES_LIT) return watched_.has_cone && !light_known_;
  if (question == NOOK_BODIES_SURFACE) return (watched_.has_cone && !light_known_) || !bodies_known_;
  if (question == NOOK_BODIES_FAR_ENOUGH && watched_.smallest_radius == 0) return false;
  // Without a mask, bodies of another place may lie on surfaces by chance.
  if (question == NOOK_BODIES_FOUND_OTHERWISE && !watched_.has_mask) return false;
  return !bodies_known_;
}

bool BodyWatch::begin_frame(const Device& device, const WorldFrame& frame, const ReachingGroups& groups) {
  const bool is_done = bodies_known_ && (light_known_ || !frame.cone);
  if (is_done || !read(device)) return false;
  if (is_watching_) judge(device);
  is_watching_ = true;
  watch(frame, groups);
  return true;
}

void BodyWatch::watch(const WorldFrame& frame, const ReachingGroups& groups) {
  watched_ = {};
  watched_.has_mask = frame.screen.gbuffer_ao >= NOOK_GBUFFER_AO_REPLACE;
  watched_.has_identity = is_identity(frame.view);
  watched_.has_cone = frame.cone.has_value();
  if (frame.cone) {
    watched_.light_ws = frame.cone->axis;
    watched_.light_vs = turned(frame.view, frame.cone->axis);
  }
  View view;
  std::copy_n(frame.view, view.size(), view.begin());
  watched_.eye = eye_of(view);
  if (bodies_known_) return;
  watched_.smallest_radius = smallest_radius(groups);
  watched_.has_bodies = has_casters(groups);
  watched_.given = bodies_without(no_mistake, frame, groups);
  if (!watched_.has_mask) return;
  watched_.mistake = next_mistake_;
  next_mistake_ = (next_mistake_ + 1) % std::size(mistakes);
  watched_.otherwise = bodies_without(mistakes[watched_.mistake], frame, groups);
}

const WatchedBodies& BodyWatch::bodies(int question) const {
  return question == NOOK_BODIES_FOUND_OTHERWISE ? watched_.otherwise : watched_.given;
}

std::array<float, 4> BodyWatch::light() const {
  const Vec3 axis = watched_.light_vs;
  return {axis.x, axis.y, axis.z, 0.3f * watched_.smallest_radius};
}

bool BodyWatch::begin(const Device& device, int question) {
  Query& query = queries_[std::size_t(question)];
  query.pixels = 0;
  if (!asks(question)) return false;
  device.gl.BeginQuery(target_, query.object.name());
  query.pending = true;
  return true;
}

void BodyWatch::end(const Device& device) {
  device.gl.EndQuery(target_);
}

// Returns false if a result is not there yet.
bool BodyWatch::read(const Device& device) {
  const Functions& gl = device.gl;
  for (Query& query : queries_) {
    if (!query.pending) continue;
    GLuint there = GL_FALSE;
    gl.GetQueryObjectuiv(query.object.name(), GL_QUERY_RESULT_AVAILABLE, &there);
    if (!there) return false;
    gl.GetQueryObjectuiv(query.object.name(), GL_QUERY_RESULT, &query.pixels);
    query.pending = false;
  }
  return true;
}

void BodyWatch::judge(const Device& device) {
  if (pixels(NOOK_BODIES_SURFACE) == 0) return;
  if (!bodies_known_) judge_bodies(device);
  if (watched_.has_cone && !light_known_) judge_light(device);
}

// True if the mask would show the bodies without watched_.mistake. OpenGL ES does not count pixels, so it
// cannot tell.
bool BodyWatch::is_explained() const {
  const std::uint64_t masked = pixels(NOOK_BODIES_MASKED), found = pixels(NOOK_BODIES_FOUND),
                      otherwise = pixels(NOOK_BODIES_FOUND_OTHERWISE);
  // If there are more bodies than are compared, the mask shows bodies that are not found.
  const bool has_all = watched_.given.count < NOOK_WATCHED_BODIES;
  return target_ == GL_SAMPLES_PASSED && has_all && 8 * found < masked && 2 * otherwise > masked &&
         otherwise > 8 * found;
}

// Returns what is wrong with the bodies of the frame, or an empty finding.
BodyWatch::Finding BodyWatch::finding() const {
  const std::uint64_t masked = pixels(NOOK_BODIES_MASKED), found = pixels(NOOK_BODIES_FOUND),
                      through = pixels(NOOK_BODIES_SHOW_THROUGH);
  // Bodies that are only drawn after the pass are not in the depth, but the floor at their feet is found.
  // With a mask, bodies may be seen at least in part.
  const bool is_through = watched_.has_mask ? masked > 0 && through > 4 * found : found == 0;
  if (through > 0 && is_through)
    return {"surfaces are seen where bodies in front of them should hide them", general_advice()};
  if (watched_.has_mask && watched_.has_identity && watched_.given.count > 0 && masked > 0 && found == 0)
    return {"no surface of the mask is near a body", general_advice()};
  if (watched_.smallest_radius > 0 && found == 0 &&
      20 * pixels(NOOK_BODIES_FAR_ENOUGH) < pixels(NOOK_BODIES_SURFACE))
    return {"almost all surfaces are nearer to the camera than a third of the smallest body's radius",
            "give poses, capsules, frame.view and frame.projection in one unit"};
  return {};
}

const char* BodyWatch::general_advice() const {
  return watched_.has_identity
             ? "frame.view is the identity: set it to the matrix from world space to view space"
             : "set frame.view to the matrix from world space to view space of the camera and the frame that "
               "drew the depth, not to its inverse, and give poses, capsules, frame.view and "
               "frame.projection in one unit";
}

void BodyWatch::report(const Device& device, const Finding& found) {
  bodies_known_ = true;
  const Vec3 eye = watched_.eye;
  device.context.log(NOOK_LOG_WARNING,
                     "nook_world_render: bodies darken other places than depth shows them at: in earlier "
                     "frames, %s (got a view from %g %g %g); %s",
                     found.what, double(eye.x), double(eye.y), double(eye.z), found.advice);
}

void BodyWatch::judge_bodies(const Device& device) {
  if (!watched_.has_bodies) return;
  // Without a mask, a body may be found by chance. With it, most of the mask must be bodies.
  bodies_known_ = watched_.has_mask && 2 * pixels(NOOK_BODIES_FOUND) > pixels(NOOK_BODIES_MASKED);
  if (bodies_known_) return;
  const Mistake& mistake = mistakes[watched_.mistake];
  int& explained_frames = explained_frames_[watched_.mistake];
  explained_frames = is_explained() ? explained_frames + 1 : 0;
  if (explained_frames >= least_explained_frames) report(device, {mistake.what, mistake.advice});
  if (explained_frames > 0) return;
  const Finding found = finding();
  if (!found.what) {
    wrong_frames_ = 0;
    bodies_known_ = pixels(NOOK_BODIES_FOUND) > 0 && ++right_frames_ >= enough_right_frames;
    return;
  }
  if (++wrong_frames_ >= (watched_.has_mask ? least_masked_frames : least_wrong_frames))
    report(device, found);
}

void BodyWatch::judge_light(const Device& device) {
  // A light that shines on 1 of 20 surfaces was probably meant. For OpenGL ES, which only tells 1 from 0, it
  // must shine on none.
  if (20 * pixels(NOOK_BODIES_LIT) >= pixels(NOOK_BODIES_SURFACE)) {
    light_known_ = true;
    return;
  }
  if (++unlit_frames_ < least_unlit_frames) return;
  light_known_ = true;
  const Vec3 axis = watched_.light_ws;
  device.context.log(NOOK_LOG_WARNING,
                     "nook_world_render: almost all surfaces of earlier frames face away from "
                     "desc.light_axis (got %g %g %g); it is the direction towards the light, in world space: "
                     "negate it if yours is the direction in which the light shines. While a sun is below "
                     "the horizon, set desc.light_degrees to 0",
                     double(axis.x), double(axis.y), double(axis.z));
}

}  // namespace nook::gl
