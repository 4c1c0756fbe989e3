#include "samples/crowd/floor_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace crowd {
namespace {

constexpr std::uint32_t kSide = 320;  // texels of the texture
constexpr std::uint32_t kAzimuths = 64, kHeights = 16;
constexpr float kReach_m = 4;  // bodies that are farther away hardly darken the ground
constexpr float kMargin_m = 2;
constexpr float kMinRadius_m = 0.025f;  // fingers and the like are thinner and left out

std::vector<std::vector<glm::vec3>> vertices_by_bone(const Hero& hero) {
  std::vector<std::vector<glm::vec3>> of_bone(hero.bone_count());
  for (std::size_t v = 0; v < hero.vertex_count(); ++v) {
    const float* weights = &hero.weights[4 * v];
    const auto strongest = std::max_element(weights, weights + 4) - weights;
    const float* p = &hero.positions_m[3 * v];
    of_bone[hero.joints[4 * v + std::size_t(strongest)]].push_back({p[0], p[1], p[2]});
  }
  return of_bone;
}

// The direction in which the points spread most, by a few steps of the power method.
glm::vec3 long_axis(const std::vector<glm::vec3>& points, const glm::vec3& centre) {
  glm::vec3 axis(0.5f, 0.7f, 0.5f);
  for (int step = 0; step < 12; ++step) {
    glm::vec3 next(0);
    for (const glm::vec3& p : points) next += (p - centre) * glm::dot(p - centre, axis);
    if (!(glm::dot(next, next) > 0)) return glm::vec3(0, 1, 0);
    axis = glm::normalize(next);
  }
  return axis;
}

// Puts a chain of spheres along each bone, as thick as the vertices that follow the bone.
std::vector<BodySphere> body_spheres(const Hero& hero) {
  std::vector<BodySphere> spheres;
  const std::vector<std::vector<glm::vec3>> of_bone = vertices_by_bone(hero);
  for (std::uint32_t bone = 0; bone < of_bone.size(); ++bone) {
    const std::vector<glm::vec3>& points = of_bone[bone];
    if (points.size() < 8) continue;
    glm::vec3 centre(0);
    for (const glm::vec3& p : points) centre += p / float(points.size());
    const glm::vec3 axis = long_axis(points, centre);
    float low = 0, high = 0, across = 0;
    for (const glm::vec3& p : points) {
      const float along = glm::dot(p - centre, axis);
      low = std::min(low, along);
      high = std::max(high, along);
      across += glm::length(p - centre - along * axis) / float(points.size());
    }
    if (across < kMinRadius_m) continue;
    const int count = std::max(1, int(std::lround((high - low) / (2 * across))));
    for (int i = 0; i < count; ++i)
      spheres.push_back(
          {bone, centre + axis * (low + (float(i) + 0.5f) * (high - low) / float(count)), across});
  }
  return spheres;
}

struct Ball {
  glm::vec3 centre_ws;
  float radius_m;
};

struct Body {
  glm::vec2 middle_m;  // x and z
  std::vector<Ball> balls;
};

Body posed(const std::vector<BodySphere>& spheres, const Bones& bones) {
  Body body{glm::vec2(0), {}};
  for (const BodySphere& sphere : spheres) {
    const float* m = &bones[12 * std::size_t(sphere.bone)];
    const glm::vec4 c(sphere.centre_m, 1.0f);
    const auto row = [&](int r) {
      return glm::dot(glm::vec4(m[4 * r], m[4 * r + 1], m[4 * r + 2], m[4 * r + 3]), c);
    };
    body.balls.push_back({{row(0), row(1), row(2)}, sphere.radius_m});
    body.middle_m += glm::vec2(row(0), row(2)) / float(spheres.size());
  }
  return body;
}

}  // namespace

FloorLight::FloorLight(const GladGLContext& gl, const Hero& hero, const std::vector<Placement>& places,
                       const Light& light)
    : gl_(gl), body_(body_spheres(hero)) {
  std::vector<float> directions, rgb(3 * kAzimuths * kHeights);
  for (std::uint32_t h = 0; h < kHeights; ++h)
    for (std::uint32_t a = 0; a < kAzimuths; ++a) {
      const float y = (float(h) + 0.5f) / kHeights,
                  turn = 6.2831853f * (float(a) + 0.5f) / kAzimuths - 3.14159265f;
      const float across = std::sqrt(1 - y * y);
      directions.insert(directions.end(), {across * std::cos(turn), y, across * std::sin(turn)});
    }
  nook::check(nook_probe_lobes_radiance(light.lobes().data(), std::uint32_t(light.lobes().size()),
                                        directions.data(), rgb.data(), kAzimuths * kHeights));
  const std::vector<float> up = light.irradiance({0, 1, 0});
  for (std::size_t i = 0; i < kAzimuths * kHeights; ++i) {
    glm::vec3 r;
    for (int c = 0; c < 3; ++c)
      r[c] = std::clamp(3.14159265f * rgb[3 * i + std::size_t(c)] / std::max(up[std::size_t(c)], 1e-6f), 0.0f,
                        8.0f);
    ratio_.push_back(r);
  }
  const float half_m = crowd_radius_m(places) + kMargin_m;
  floor_.first_m = glm::vec2(-half_m);
  floor_.extent_m = glm::vec2(2 * half_m);
  gl.GenTextures(1, &floor_.texture);
  gl.BindTexture(GL_TEXTURE_2D, floor_.texture);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

FloorLight::~FloorLight() {
  gl_.DeleteTextures(1, &floor_.texture);
}

glm::vec3 FloorLight::ratio(const glm::vec3& direction) const {
  const float turn = std::atan2(direction.z, direction.x) + 3.14159265f;
  const auto a = std::min(std::uint32_t(turn * (kAzimuths / 6.2831854f)), kAzimuths - 1);
  const auto h = std::min(std::uint32_t(std::max(direction.y, 0.0f) * kHeights), kHeights - 1);
  return ratio_[h * kAzimuths + a];
}

FloorTexture FloorLight::draw(const std::vector<Bones>& poses) {
  std::vector<Body> bodies(poses.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i] = posed(body_, poses[i]);
  std::vector<glm::vec3> left(kSide * kSide);
  tbb::parallel_for(0u, kSide, [&](std::uint32_t row) {
    for (std::uint32_t column = 0; column < kSide; ++column) {
      const glm::vec2 at =
          floor_.first_m + floor_.extent_m * ((glm::vec2(float(column), float(row)) + 0.5f) / float(kSide));
      glm::vec3 taken(0);
      for (const Body& body : bodies) {
        if (glm::distance(body.middle_m, at) > kReach_m) continue;
        for (const Ball& ball : body.balls) {
          const glm::vec3 to = ball.centre_ws - glm::vec3(at.x, 0, at.y);
          const float distance2 = std::max(glm::dot(to, to), ball.radius_m * ball.radius_m);
          const glm::vec3 d = to / std::sqrt(distance2);
          const float share = ball.radius_m * ball.radius_m * std::max(d.y, 0.0f) / distance2;
          taken += share * ratio(d);
        }
      }
      left[row * kSide + column] = glm::exp(-taken);
    }
  });
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, floor_.texture);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB16F, GLsizei(kSide), GLsizei(kSide), 0, GL_RGB, GL_FLOAT,
                 left.data());
  return floor_;
}

}  // namespace crowd
