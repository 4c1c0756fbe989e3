// Explains a difference between the model's and the host's vertices, if one transform of the whole body
// causes it.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sdk/src/character/pose_check.h"

namespace nook {
namespace {

// Finds the affine map from one set of points to another set of the same size, by least squares. Returns
// false if the points of the first set lie in a plane.
bool best_map(std::span<const Point3> from_points, std::span<const Point3> to_points, Affine& map) {
  Point3 from{}, to{};
  const double share = 1 / static_cast<double>(from_points.size());
  for (std::size_t v = 0; v < from_points.size(); ++v)
    for (int i = 0; i < 3; ++i) {
      from[i] += share * from_points[v][i];
      to[i] += share * to_points[v][i];
    }
  Affine own, cross;  // 3x3 parts: the sum of p p^T and the sum of x p^T, where p and x are relative to their
                      // means
  own.m.fill(0);
  cross.m.fill(0);
  for (std::size_t v = 0; v < from_points.size(); ++v)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double p = from_points[v][j] - from[j];
        own.m[4 * i + j] += (from_points[v][i] - from[i]) * p;
        cross.m[4 * i + j] += (to_points[v][i] - to[i]) * p;
      }
  const double trace = own.m[0] + own.m[5] + own.m[10];
  if (!(determinant(own) > 1e-7 * trace * trace * trace)) return false;
  map = cross * inverse(own);
  const Point3 moved = transform(map, from[0], from[1], from[2]);
  for (int i = 0; i < 3; ++i) map.m[4 * i + 3] = to[i] - moved[i];
  return true;
}

// Returns the scale of a map if it is a similarity within 1 %. The similarity may be mirrored. Otherwise
// returns 0.
double scale_of_similarity(const Affine& map) {
  const double scale = std::cbrt(std::abs(determinant(map)));
  double difference = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double dot = 0;
      for (int k = 0; k < 3; ++k) dot += map.m[4 * k + i] * map.m[4 * k + j];
      difference = std::max(difference, std::abs(dot - (i == j ? scale * scale : 0)));
    }
  return difference <= 0.02 * scale * scale ? scale : 0;
}

// Returns the rotation angle of a similarity with the given scale.
double turn_degrees(const Affine& map, double scale) {
  const double cosine = 0.5 * ((map.m[0] + map.m[5] + map.m[10]) / scale - 1);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 57.29577951308232;
}

bool is_same_turn(const Affine& a, const Affine& b) {
  double difference = 0, size = 0;
  for (int i = 0; i < 12; ++i) {
    if (i % 4 == 3) continue;
    difference = std::max(difference, std::abs(a.m[i] - b.m[i]));
    size = std::max(size, std::abs(b.m[i]));
  }
  return difference <= 0.01 * size;
}

bool is_same(const Affine& a, const Affine& b, double tolerance_m) {
  bool out = is_same_turn(a, b);
  for (int i = 3; i < 12; i += 4) out = out && std::abs(a.m[i] - b.m[i]) <= tolerance_m;
  return out;
}

Affine turned_back(const Affine& place) {
  Affine out = place;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out.m[4 * i + j] = place.m[4 * j + i];
  return out;
}

// Corrects a place that the host passed as four columns of three numbers, instead of three rows of four.
Affine from_columns_4x3(const Affine& place) {
  Affine out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) out.m[4 * i + j] = place.m[3 * j + i];
  return out;
}

// Returns true if the model's vertices match the host's vertices when the pose has this place.
bool fits_under(const PosedPoints& points, const Affine& place) {
  const Affine map = place * inverse(points.pose_place);
  for (std::size_t v = 0; v < points.posed.size(); ++v) {
    const Point3& p = points.posed[v];
    if (!(distance(transform(map, p[0], p[1], p[2]), points.host[v]) <= points.tolerance_ws)) return false;
  }
  return true;
}

// Tries to explain the difference by a place that the host uses for its vertices, but did not pass with the
// pose, or passed in a wrong form. With true_place, the vertices would match.
bool explain_by_known_place(const PosedPoints& points, const Affine& true_place, PoseFinding& finding) {
  const Affine none, &given = points.pose_place;
  const double tolerance_m = points.tolerance_ws;
  const bool is_given = !is_same(given, none, tolerance_m);
  constexpr nook_pose_fault fault = NOOK_POSE_FAULT_PLACE;
  if (is_given && fits_under(points, inverse(given))) {
    explain(finding, fault, "desc.place_3x4 is inverted; pass the matrix from model space to world space");
    return true;
  }
  // If the host passed the columns of a 4x4 matrix, the translation is lost. So only the rotation is
  // compared.
  if (is_given &&
      (fits_under(points, from_columns_4x3(given)) ||
       (!is_same_turn(given, turned_back(given)) && is_same_turn(turned_back(given), true_place)))) {
    explain(finding, fault,
            "desc.place_3x4 is transposed: pass three rows of four numbers, with the translation in the last "
            "column");
    return true;
  }
  const bool is_of_vertices = !is_same(points.vertex_place, none, tolerance_m);
  if (is_of_vertices && fits_under(points, points.vertex_place)) {
    if (is_given)
      explain(finding, fault,
              "desc.place_3x4 is not the place of the vertices; with check.place_3x4 as the place, the pose "
              "matches the vertices");
    else
      explain(finding, fault,
              "desc.place_3x4 is missing; with check.place_3x4 as the place, the pose matches the vertices");
    return true;
  }
  if (is_given && fits_under(points, none)) {
    explain(finding, fault,
            "the pose is at another place than the vertices, but matches them if desc.place_3x4 is left out: "
            "either the transforms already lead to world space, or check.place_3x4 (the place of the "
            "vertices) is missing");
    return true;
  }
  return false;
}

// Returns the axis of the character's space that a map mirrors, as text that can follow "mirror image".
// Returns an empty text if the map also rotates.
const char* mirrored_axis(const Affine& map, double scale, const Affine& place) {
  const Affine own = inverse(place) * map * place;
  constexpr const char* names[] = {" in x", " in y", " in z"};
  for (int axis = 0; axis < 3; ++axis) {
    Affine mirror;
    for (int i = 0; i < 3; ++i) mirror.m[5 * i] = i == axis ? -scale : scale;
    if (is_same_turn(own, mirror)) return names[axis];
  }
  return "";
}

}  // namespace

bool explain_by_place(const PosedPoints& points, PoseFinding& finding) {
  Affine map;
  if (determinant(points.pose_place) == 0 || !best_map(points.posed, points.host, map)) return false;
  const double scale = scale_of_similarity(map);
  if (scale == 0) return false;
  for (std::size_t v = 0; v < points.posed.size(); ++v) {
    const Point3& p = points.posed[v];
    if (!(distance(transform(map, p[0], p[1], p[2]), points.host[v]) <= points.tolerance_ws)) return false;
  }
  if (explain_by_known_place(points, map * points.pose_place, finding)) return true;
  const bool is_mirrored = determinant(map) < 0;
  const char* const axis = is_mirrored ? mirrored_axis(map, scale, points.pose_place) : "";
  if (std::abs(scale - 1) > 0.02) {
    if (explain(finding, NOOK_POSE_FAULT_UNIT,
                "the pose is in another unit than the vertices: it matches when multiplied by %.6g%s%s; "
                "scale desc.place_3x4 or check.place_3x4",
                scale, is_mirrored ? " and mirrored" : "", axis))
      finding.scale = scale;
  } else if (is_mirrored) {
    explain(
        finding, NOOK_POSE_FAULT_PLACE,
        "the pose is a mirror image of the vertices%s: one of the two is left-handed; mirror desc.place_3x4 "
        "of the pose in the same way",
        axis);
  } else {
    explain(finding, NOOK_POSE_FAULT_PLACE,
            "the pose is right, but is at another place than the vertices: it matches when turned by %.3g "
            "degrees and moved by (%.4g %.4g %.4g); desc.place_3x4 or check.place_3x4 is wrong or missing",
            turn_degrees(map, scale), map.m[3], map.m[7], map.m[11]);
  }
  return true;
}

}  // namespace nook
