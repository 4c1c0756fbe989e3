#include "sdk/src/character/pose_check.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook {

double distance(const Point3& a, const Point3& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

double spread(std::span<const Point3> points) {
  const double share = 1 / static_cast<double>(points.size());
  Point3 mean{};
  double squares = 0;
  for (const Point3& point : points)
    for (int i = 0; i < 3; ++i) mean[i] += share * point[i];
  for (const Point3& point : points) squares += share * distance(point, mean) * distance(point, mean);
  return std::sqrt(squares);
}

bool best_map(std::span<const Point3> from_points, std::span<const Point3> to_points, Affine& map) {
  Point3 from{}, to{};
  const double share = 1 / static_cast<double>(from_points.size());
  for (std::size_t v = 0; v < from_points.size(); ++v)
    for (int i = 0; i < 3; ++i) {
      from[i] += share * from_points[v][i];
      to[i] += share * to_points[v][i];
    }
  Affine own, cross;  // 3x3 parts: sums of p p^T and of x p^T about the means
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

double turn_degrees(const Affine& map, double scale) {
  const double cosine = 0.5 * ((map.m[0] + map.m[5] + map.m[10]) / scale - 1);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 57.29577951308232;
}

void say(PoseFinding& finding, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(finding.text, sizeof finding.text, format, arguments);
  va_end(arguments);
}

// The check tries the readings of the host's transforms that mistakes turn into each other, and names the one
// under which the model's vertices fall on the host's. Where none does, a best affine map between the two
// sets of vertices tells a wrong unit, turn or mirror image of the whole pose.

namespace {

struct Distances {
  double max = INFINITY, rms = INFINITY;  // metres of the world
  std::size_t worst = 0;                  // index into the compared vertices
};

// Everything that the readings share.
struct Check {
  const CharacterModel& model;
  const PoseSource& given;
  double tolerance_ws = 0;
  Vector<const RestVertex*> vertex;  // those whose bones all have transforms
  Vector<Point3> host;               // where the host has them
  Vector<std::uint8_t> has_matrix;   // for each bone
  Vector<Affine> matrix;             // for each bone, of the latest reading
  Vector<Point3> posed;              // by the latest reading

  Check(const CharacterModel& of, const PoseSource& source, Memory* memory)
      : model(of),
        given(source),
        vertex(memory),
        host(memory),
        has_matrix(of.bone_count(), std::uint8_t{0}, memory),
        matrix(of.bone_count(), Affine{}, memory),
        posed(memory) {}
};

Point3 skinned(const Check& check, const RestVertex& vertex) {
  Point3 sum{};
  for (std::uint32_t b = 0; b < vertex.bone_count; ++b) {
    const Point3 p =
        transform(check.matrix[vertex.bone[b]], vertex.position.x, vertex.position.y, vertex.position.z);
    for (int i = 0; i < 3; ++i) sum[i] += vertex.weight[b] * p[i];
  }
  return sum;
}

// Poses the vertices by a reading. Returns false where the host's transforms cannot be read so.
bool pose(Check& check, const Reading& reading) {
  const PoseSource& source = reading.source;
  if (source.transform_of_bone.empty()) {
    const std::size_t expected = source.kind == NOOK_POSE_SKINNING
                                     ? check.model.bind.skins[source.skin].joint_count
                                     : check.model.bone_count();
    if (source.allows_surplus ? source.given_count < expected : source.transform_count != expected)
      return false;
  }
  std::fill(check.has_matrix.begin(), check.has_matrix.end(), std::uint8_t{0});
  PoseSource partial = source;
  partial.is_partial = true;
  for_each_transform(check.model, partial, [&](std::size_t bone, std::uint32_t index) {
    check.matrix[bone] = bone_matrix(check.model, source, bone, read_transform(reading, index));
    check.has_matrix[bone] = is_finite(check.matrix[bone]);
  });
  check.posed.clear();
  for (const RestVertex* vertex : check.vertex) {
    for (std::uint32_t b = 0; b < vertex->bone_count; ++b)
      if (!check.has_matrix[vertex->bone[b]]) return false;
    check.posed.push_back(skinned(check, *vertex));
  }
  return true;
}

template <class Map>
Distances compare(const Check& check, Map&& map) {
  Distances out{0, 0, 0};
  for (std::size_t v = 0; v < check.posed.size(); ++v) {
    const double d = distance(map(check.posed[v]), check.host[v]);
    if (!(d <= out.max)) {
      out.max = d;
      out.worst = v;
    }
    out.rms += d * d;
  }
  out.rms = std::sqrt(out.rms / static_cast<double>(check.posed.size()));
  return out;
}
Distances compare(const Check& check) {
  return compare(check, [](const Point3& p) { return p; });
}

bool explain_by_map(Check& check, PoseFinding& finding) {
  Affine map;
  if (!best_map(check.posed, check.host, map)) return false;
  const double scale = scale_of_similarity(map);
  if (scale == 0) return false;
  const Distances left = compare(check, [&](const Point3& p) { return transform(map, p[0], p[1], p[2]); });
  if (!(left.max <= check.tolerance_ws)) return false;
  finding.scale = scale;
  const bool is_mirrored = determinant(map) < 0;
  if (std::abs(scale - 1) > 0.02) {
    finding.fault = NOOK_POSE_FAULT_UNIT;
    say(finding,
        "the pose is in another unit than the vertices: it fits when multiplied by %.6g%s; scale "
        "desc.place_3x4 or the vertices' place",
        scale, is_mirrored ? " and mirrored" : "");
    return true;
  }
  finding.fault = NOOK_POSE_FAULT_PLACE;
  if (is_mirrored)
    say(finding,
        "the pose is a mirror image of the vertices: one of them is left-handed; put the mirroring into "
        "desc.place_3x4 of the pose as well");
  else
    say(finding,
        "the pose is right in itself, and stands elsewhere than the vertices: it fits when turned by %.3g "
        "degrees and moved by (%.4g %.4g %.4g); one of the two places is wrong or missing",
        turn_degrees(map, scale), map.m[3], map.m[7], map.m[11]);
  return true;
}

// The transform under which a vertex that hangs on one bone falls on the host's, or -1.
std::int64_t fitting_transform(const Check& check, const RestVertex& vertex, const Point3& host) {
  double nearest = 3 * check.tolerance_ws;
  std::int64_t fitting = -1;
  for (std::uint32_t t = 0; t < check.given.transform_count; ++t) {
    const Affine matrix =
        bone_matrix(check.model, check.given, vertex.bone[0], read_transform(check.given, t));
    const double d =
        distance(transform(matrix, vertex.position.x, vertex.position.y, vertex.position.z), host);
    if (!(d < nearest)) continue;
    nearest = d;
    fitting = t;
  }
  return fitting;
}

// Looks for the transforms of vertices that are off and hang on one bone almost alone.
bool explain_by_order(const Check& check, PoseFinding& finding) {
  std::size_t off = 0, found = 0;
  std::uint32_t bone = 0;
  std::int64_t transform_index = -1;
  for (std::size_t v = 0; v < check.vertex.size(); ++v) {
    const RestVertex& vertex = *check.vertex[v];
    if (vertex.weight[0] < 0.98f || distance(check.posed[v], check.host[v]) <= check.tolerance_ws) continue;
    ++off;
    const std::int64_t fitting = fitting_transform(check, vertex, check.host[v]);
    if (fitting < 0) continue;
    if (found++ == 0) {
      bone = vertex.bone[0];
      transform_index = fitting;
    }
  }
  if (off == 0 || 2 * found < off) return false;
  finding.fault = NOOK_POSE_FAULT_ORDER;
  say(finding,
      "transforms go to the wrong bones: %zu of %zu vertices fit under the transform of another bone; bone "
      "%u (\"%s\") fits with transform %lld; map bones by name",
      found, off, bone, check.model.bone_names[bone].c_str(), static_cast<long long>(transform_index));
  return true;
}

// Vertices that only bones with transforms move. The unit of the tolerance is that of the host's vertices,
// known by their spread, because the transforms may be misread. A pose changes the spread by a few tens of
// percent.
void choose_vertices(Check& check, std::span<const SkinnedVertex> vertices, double tolerance) {
  std::size_t first_missing = 0;
  for_each_transform(check.model, check.given,
                     [&](std::size_t bone, std::uint32_t) { check.has_matrix[bone] = 1; });
  for (const SkinnedVertex& vertex : vertices) {
    const RestVertex& rest = check.model.bind.vertices[vertex.rest_vertex];
    const auto last = rest.bone.begin() + rest.bone_count;
    const auto missing =
        std::find_if(rest.bone.begin(), last, [&](std::uint16_t bone) { return !check.has_matrix[bone]; });
    if (missing != last) {
      first_missing = *missing;
      continue;
    }
    check.vertex.push_back(&rest);
    check.host.push_back(vertex.position_ws);
  }
  if (check.vertex.empty())
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "none of the vertices hangs on bones of this pose alone (bone %zu, \"%s\", has no transform); "
        "check the skin that moves them",
        first_missing, check.model.bone_names[first_missing].c_str());
  Vector<Point3> at_rest(check.host.get_allocator());
  at_rest.reserve(check.vertex.size());
  for (const RestVertex* vertex : check.vertex)
    at_rest.push_back({vertex->position.x, vertex->position.y, vertex->position.z});
  const double rest = spread(at_rest), host = spread(check.host);
  const double scale = rest > 0 && host > 0 ? host / rest : 1;
  check.tolerance_ws = tolerance * std::max(check.model.bounding_radius, 1e-6f) * scale;
}

}  // namespace

PoseFinding find_pose_fault(const CharacterModel& model, const PoseSource& source,
                            std::span<const SkinnedVertex> vertices, double tolerance, Memory* memory) {
  Check check(model, source, memory);
  choose_vertices(check, vertices, tolerance);
  const Reading as_given{source};
  PoseFinding finding;
  const bool is_readable = pose(check, as_given);
  const Distances distances = is_readable ? compare(check) : Distances{};
  const double unit = check.tolerance_ws / tolerance;
  finding.max_error = distances.max / unit;
  finding.rms_error = distances.rms / unit;
  finding.worst_bone = check.vertex[distances.worst]->bone[0];
  if (distances.max <= check.tolerance_ws) {
    say(finding, "the pose is right: %zu vertices agree to %.2g of the bounding radius", check.vertex.size(),
        finding.max_error);
    return finding;
  }
  const Vector<Reading> readings = other_readings(model, source, memory);
  for (const Reading& reading : readings)
    if (pose(check, reading) && compare(check).max <= check.tolerance_ws) {
      describe(model, source, reading, finding);
      return finding;
    }
  if (is_readable && pose(check, as_given)) {
    if (explain_by_map(check, finding)) return finding;
    if (explain_by_order(check, finding)) return finding;
  }
  for (const Reading& reading : readings)
    if (pose(check, reading) && explain_by_map(check, finding)) {
      describe(model, source, reading, finding);
      return finding;
    }
  finding.fault = NOOK_POSE_FAULT_UNKNOWN;
  say(finding,
      "the pose differs by up to %.3g of the bounding radius, most at bone %u (\"%s\"), and no known mistake "
      "explains it: another clip or frame, another mesh, or vertices of another file",
      finding.max_error, finding.worst_bone, model.bone_names[finding.worst_bone].c_str());
  return finding;
}

}  // namespace nook
