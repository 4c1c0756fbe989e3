#include "bakers/measure/world/darkeners.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bakers/import/skinned_mesh.h"
#include "bakers/world/initial_casters.h"
#include "bakers/world/posed_casters.h"
#include "sdk/src/character/kernel.h"

namespace nook::measure {
namespace {

using bake::Pose;

float sphere_factor(Vec3 centre, float radius, Vec3 point, Vec3 normal) {
  const Vec3 d = (centre - point) * (1 / radius);
  return form_factor_exact(dot(d, normal), dot(d, d));
}

float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / std::max(to - from, 1e-6f), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Returns the share of a cone of light that a sphere hides. It is the overlap of two discs on the unit
// sphere. As the discs move apart, the overlap falls smoothly from the area of the smaller disc to 0.
float sphere_in_cone(Vec3 centre, float radius, Vec3 point, const LightCone& cone) {
  const Vec3 d = centre - point;
  const float distance = length(d);
  if (distance <= radius) return 1;
  const float own = std::asin(radius / distance);
  const float apart = std::acos(std::clamp(dot(d, cone.axis) / distance, -1.0f, 1.0f));
  const float full =
      std::min(1.0f, std::pow(std::sin(0.5f * own) / std::sin(0.5f * cone.half_angle_radians), 2.0f));
  return full *
         (1 - smooth_step(std::abs(own - cone.half_angle_radians), own + cone.half_angle_radians, apart));
}

class NookCasters final : public Darkener {
 public:
  explicit NookCasters(std::vector<WorldCaster> casters) : casters_(std::move(casters)) {}
  void pose(const Pose& pose) override {
    for_ao_ = bake::posed(casters_, pose, bake::CasterUse::ao);
    for_light_ = bake::posed(casters_, pose, bake::CasterUse::light);
  }
  float ao(Vec3 point, Vec3 normal) const override { return bake::open_share(for_ao_, point, normal); }
  float cone(Vec3 point, const LightCone& cone) const override {
    const float wide = cone.half_angle_radians + 2 * std::atan(cone.parts.slope);
    float clear[world::cone_parts];
    std::fill(std::begin(clear), std::end(clear), 1.0f);
    for (const Capsule& c : for_light_) {
      if (!bake::may_hide(c, point, cone.axis, wide)) continue;
      for (std::size_t i = 0; i < world::cone_parts; ++i)
        clear[i] *= 1 - bake::part_coverage_at(c, point, cone.parts.axis[i], cone.parts.slope);
    }
    float open = 0;
    for (const float part : clear) open += part;
    return open / float(world::cone_parts);
  }

 private:
  std::vector<WorldCaster> casters_;
  std::vector<Capsule> for_ao_, for_light_;
};

class NearestSpheres final : public Darkener {
 public:
  NearestSpheres(std::vector<WorldCaster> casters, float scale) : casters_(std::move(casters)) {
    for (WorldCaster& c : casters_) {
      c.capsule.radius_a *= scale;
      c.capsule.radius_b *= scale;
    }
  }
  void pose(const Pose& pose) override { capsules_ = bake::posed(casters_, pose, bake::CasterUse::light); }
  float ao(Vec3 point, Vec3 normal) const override {
    float open = 1;
    for (const Capsule& c : capsules_) {
      const Vec3 e = c.b - c.a;
      const float t = std::clamp(dot(point - c.a, e) / std::max(dot(e, e), 1e-12f), 0.0f, 1.0f);
      open *= 1 - sphere_factor(c.a + t * e, c.radius_a, point, normal);
    }
    return open;
  }
  float cone(Vec3 point, const LightCone& cone) const override {
    float open = 1;
    for (const Capsule& c : capsules_) {
      // Finds the point of the segment that is nearest to the line of the cone's axis.
      const Vec3 e = c.b - c.a, a = c.a - point, l = cone.axis;
      const Vec3 across = e - dot(e, l) * l;
      const float t = std::clamp(-dot(a, across) / std::max(dot(across, across), 1e-12f), 0.0f, 1.0f);
      open *= 1 - sphere_in_cone(c.a + t * e, c.radius_a, point, cone);
    }
    return open;
  }

 private:
  std::vector<WorldCaster> casters_;
  std::vector<Capsule> capsules_;
};

struct Ellipsoid {
  Vec3 centre, axis[3];
  float half[3]{};
  std::uint16_t bone = 0;
};

// Fits an ellipsoid to the surface that belongs to each bone. The half axes are sqrt(3) standard deviations
// along each principal axis, as for a surface with constant density.
std::vector<Ellipsoid> bone_ellipsoids(const bake::SkinnedMesh& mesh) {
  const std::vector<float> area = bake::vertex_areas(mesh, mesh.position);
  struct Moments {
    double area = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  };
  std::vector<Moments> bones(mesh.bones.size());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    Moments& m = bones[mesh.weights[v].bone[0]];
    const Eigen::Vector3d p(double(mesh.position[v].x), double(mesh.position[v].y),
                            double(mesh.position[v].z));
    const double w = double(area[v]) + 1e-12;
    m.area += w;
    m.sum += w * p;
    m.second += w * p * p.transpose();
  }
  std::vector<Ellipsoid> ellipsoids;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const Moments& m = bones[b];
    if (!(m.area > 0)) continue;
    const Eigen::Vector3d mean = m.sum / m.area;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
        Eigen::Matrix3d(m.second / m.area - mean * mean.transpose()));
    Ellipsoid e;
    e.bone = std::uint16_t(b);
    e.centre = {float(mean.x()), float(mean.y()), float(mean.z())};
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = solver.eigenvectors().col(i);
      e.axis[i] = {float(axis.x()), float(axis.y()), float(axis.z())};
      e.half[i] = std::max(1e-3f, float(std::sqrt(3 * std::max(0.0, solver.eigenvalues()[i]))));
    }
    ellipsoids.push_back(e);
  }
  return ellipsoids;
}

class Ellipsoids final : public Darkener {
 public:
  Ellipsoids(std::vector<Ellipsoid> ellipsoids, float scale) : rest_(std::move(ellipsoids)) {
    for (Ellipsoid& e : rest_)
      for (float& half : e.half) half *= scale;
  }
  void pose(const Pose& pose) override {
    posed_ = rest_;
    for (Ellipsoid& e : posed_) {
      const Mat3x4& m = pose[e.bone];
      const float scale = bake::scale_of(m);
      e.centre = transform_point(m, e.centre);
      for (Vec3& axis : e.axis) axis = normalised(transform_vector(m, axis));
      for (float& half : e.half) half *= scale;
    }
  }
  float ao(Vec3 point, Vec3 normal) const override {
    float open = 1;
    for (const Ellipsoid& e : posed_) {
      Vec3 d;
      float height = 0;
      float* const along[3] = {&d.x, &d.y, &d.z};
      // Positions are scaled, so the normal must be scaled by the inverse to stay perpendicular to its plane.
      Vec3 n;
      float* const facing[3] = {&n.x, &n.y, &n.z};
      for (int i = 0; i < 3; ++i) {
        *along[i] = dot(e.centre - point, e.axis[i]) / e.half[i];
        *facing[i] = dot(normal, e.axis[i]) * e.half[i];
      }
      height = dot(d, normalised(n));
      open *= 1 - form_factor_exact(height, dot(d, d));
    }
    return open;
  }
  float cone(Vec3 point, const LightCone& cone) const override {
    float open = 1;
    for (const Ellipsoid& e : posed_) {
      const Vec3 d = e.centre - point;
      const float distance = length(d);
      // Replaces the ellipsoid by a sphere with the same extent across the line of sight.
      const Vec3 aside = normalised(d - dot(d, cone.axis) * cone.axis);
      float radius2 = 0;
      for (int i = 0; i < 3; ++i) radius2 += std::pow(e.half[i] * dot(e.axis[i], aside), 2.0f);
      if (distance > 0) open *= 1 - sphere_in_cone(e.centre, std::sqrt(radius2), point, cone);
    }
    return open;
  }

 private:
  std::vector<Ellipsoid> rest_, posed_;
};

class Blob final : public Darkener {
 public:
  Blob(const bake::SkinnedMesh& mesh, float radius, float strength)
      : mesh_(mesh), radius_(radius), strength_(strength) {}
  void pose(const Pose& pose) override {
    std::vector<Vec3> body;
    bake::skin_positions(mesh_, pose, body);
    Vec3 low = body.front(), high = low;
    for (const Vec3 p : body) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    centre_ = {0.5f * (low.x + high.x), low.y, 0.5f * (low.z + high.z)};
  }
  float ao(Vec3 point, Vec3 normal) const override {
    if (normal.y < 0.5f || std::abs(point.y - centre_.y) > 0.1f) return 1;
    const float x = point.x - centre_.x, z = point.z - centre_.z;
    return 1 - strength_ * (1 - smooth_step(0, radius_, std::sqrt(x * x + z * z)));
  }
  float cone(Vec3 point, const LightCone&) const override { return ao(point, {0, 1, 0}); }

 private:
  const bake::SkinnedMesh& mesh_;
  float radius_, strength_;
  Vec3 centre_;
};

class ProxySpheres final : public Darkener {
 public:
  explicit ProxySpheres(const CharacterModel& model) : model_(model) {}
  void pose(const Pose& pose) override {
    spheres_.clear();
    for (const ProxySphere& s : model_.spheres) {
      const Mat3x4& m = pose[s.bone];
      spheres_.push_back({transform_point(m, s.centre), bake::scale_of(m) * s.radius, s.caster_weight});
    }
  }
  float ao(Vec3 point, Vec3 normal) const override {
    float depth = 0;
    for (const Sphere& s : spheres_) {
      const Vec3 d = (s.centre - point) * (1 / s.radius);
      depth += s.weight * form_factor_fast(dot(d, normal), dot(d, d));
    }
    return std::exp(-solid_depth(depth));
  }
  float cone(Vec3 point, const LightCone& cone) const override {
    float open = 1;
    for (const Sphere& s : spheres_) open *= 1 - sphere_in_cone(s.centre, s.radius, point, cone);
    return open;
  }

 private:
  struct Sphere {
    Vec3 centre;
    float radius, weight;
  };
  const CharacterModel& model_;
  std::vector<Sphere> spheres_;
};

// The scales among which the best one is chosen for a baseline.
constexpr int scale_count = 23;
float scale_at(int i) {
  return 0.5f + 0.05f * float(i);
}

}  // namespace

Method nook_method(std::vector<WorldCaster> casters) {
  Method method{"nook", {}};
  method.variant.push_back(std::make_unique<NookCasters>(std::move(casters)));
  return method;
}

Method capsule_method(const bake::SkinnedMesh& mesh) {
  const std::vector<WorldCaster> capsules =
      bake::bone_capsules(mesh, bake::vertex_areas(mesh, mesh.position));
  Method method{"capsules", {}};
  for (int i = 0; i < scale_count; ++i)
    method.variant.push_back(std::make_unique<NearestSpheres>(capsules, scale_at(i)));
  return method;
}

Method ellipsoid_method(const bake::SkinnedMesh& mesh) {
  const std::vector<Ellipsoid> ellipsoids = bone_ellipsoids(mesh);
  Method method{"ellipsoids", {}};
  for (int i = 0; i < scale_count; ++i)
    method.variant.push_back(std::make_unique<Ellipsoids>(ellipsoids, scale_at(i)));
  return method;
}

Method blob_method(const bake::SkinnedMesh& mesh) {
  Method method{"blobs", {}};
  for (const float radius : {0.3f, 0.5f, 0.7f, 1.0f, 1.4f})
    for (const float strength : {0.2f, 0.35f, 0.5f, 0.65f, 0.8f, 1.0f})
      method.variant.push_back(std::make_unique<Blob>(mesh, radius, strength));
  return method;
}

Method proxy_method(const CharacterModel& model) {
  Method method{"proxy spheres", {}};
  method.variant.push_back(std::make_unique<ProxySpheres>(model));
  return method;
}

}  // namespace nook::measure
