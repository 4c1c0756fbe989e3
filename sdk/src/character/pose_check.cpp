#include "sdk/src/character/pose_check.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>

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

bool explain(PoseFinding& finding, nook_pose_fault fault, const char* format, ...) {
  char text[sizeof finding.text];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  const bool is_first = finding.text[0] == 0;
  if (is_first) finding.fault = fault;
  if (std::strstr(finding.text, text)) return is_first;
  const std::size_t used = std::strlen(finding.text), more = std::strlen(text);
  const std::size_t between = is_first ? 0 : 5;
  if (used + between + more >= sizeof finding.text) return is_first;
  std::memcpy(finding.text + used, "; or ", between);
  std::memcpy(finding.text + used + between, text, more + 1);
  return is_first;
}

// Hosts may pass transforms of a different kind, layout or order than they declare. The check interprets the
// transforms in each of these ways ("readings"). It reports the readings for which the model's vertices match
// the host's vertices. In the bind pose, several readings may match. If the whole pose has a wrong place,
// unit, rotation or mirroring, the best affine map between the two sets of vertices shows it.

namespace {

struct Distances {
  double max = INFINITY, rms = INFINITY;  // in metres, world space
  std::size_t worst = 0;                  // index of the vertex with the largest distance, among the compared
                                          // vertices
};

// The data that is shared by all readings.
struct Check {
  const CharacterModel& model;
  const PoseSource& given;
  std::span<const SkinnedVertex> all;
  Affine vertex_place;
  double tolerance_ws = 0;
  std::size_t least_vertices = 1;    // number of vertices that a reading needs to be conclusive
  Vector<const RestVertex*> vertex;  // in the latest reading, the vertices whose bones all have transforms
  Vector<Point3> host;               // the same vertices, as the host skinned them
  Vector<Point3> posed;              // the same vertices, as the latest reading poses them
  Vector<std::uint8_t> has_matrix;   // for each bone
  Vector<Affine> matrix;             // for each bone

  Check(const CharacterModel& of, const PoseSource& source, std::span<const SkinnedVertex> vertices,
        Memory* memory)
      : model(of),
        given(source),
        all(vertices),
        vertex(memory),
        host(memory),
        posed(memory),
        has_matrix(of.bone_count(), std::uint8_t{0}, memory),
        matrix(of.bone_count(), Affine{}, memory) {}
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

// Returns the index of the first bone of a vertex that has no matrix, or the vertex's bone_count if all have
// one.
std::uint32_t first_missing(const Check& check, const RestVertex& vertex) {
  std::uint32_t b = 0;
  while (b < vertex.bone_count && check.has_matrix[vertex.bone[b]]) ++b;
  return b;
}

// Selects the vertices whose bones all have matrices, and poses them.
void pose_vertices(Check& check) {
  check.vertex.clear();
  check.host.clear();
  check.posed.clear();
  for (const SkinnedVertex& vertex : check.all) {
    const RestVertex& rest = check.model.bind.vertices[vertex.rest_vertex];
    if (first_missing(check, rest) < rest.bone_count) continue;
    check.vertex.push_back(&rest);
    check.host.push_back(vertex.position_ws);
    check.posed.push_back(skinned(check, rest));
  }
}

// Poses the vertices according to a reading. Returns false if the host's transforms cannot be read in this
// way, or if too few vertices remain.
bool pose(Check& check, const Reading& reading) {
  PoseSource source = reading.source;
  source.is_partial = true;
  if (!reading.map.empty()) source.transform_of_bone = {reading.map.data(), reading.map.size()};
  if (source.transform_of_bone.empty()) {
    const std::size_t expected = source.kind == NOOK_POSE_SKINNING
                                     ? check.model.bind.skins[source.skin].joint_count
                                     : check.model.bone_count();
    if (source.given_count < expected) return false;
  }
  std::fill(check.has_matrix.begin(), check.has_matrix.end(), std::uint8_t{0});
  for_each_transform(check.model, source, [&](std::size_t bone, std::uint32_t index) {
    if (index >= reading.readable_count) return;
    check.matrix[bone] = bone_matrix(check.model, source, bone, read_transform(reading, index));
    check.has_matrix[bone] = is_finite(check.matrix[bone]);
  });
  pose_vertices(check);
  return check.vertex.size() >= check.least_vertices;
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

// For a vertex that follows one bone, returns the index of the transform with which it matches the host's
// vertex. Returns -1 if no transform matches.
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

// A vertex that is at a wrong place and follows almost only one bone. With another bone's transform, it would
// be at the right place.
struct Misplaced {
  std::uint32_t bone = 0;
  std::int64_t transform = -1;
};

std::size_t count_of_different(std::span<const Misplaced> all, std::int64_t (*key)(const Misplaced&)) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    out += std::none_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                        [&](const Misplaced& other) { return key(other) == key(all[i]); });
  return out;
}

// For vertices at wrong places, looks for the transforms that would put them at the right places. If several
// bones match the same transform, the host's pose does not move these bones relative to each other, as in the
// bind pose. Then the function returns false, because the vertices probably belong to another frame. If only
// some of the vertices do not match, the text mentions both explanations.
bool explain_by_order(const Check& check, PoseFinding& finding) {
  std::size_t off = 0;
  Vector<Misplaced> found(check.host.get_allocator());
  for (std::size_t v = 0; v < check.vertex.size(); ++v) {
    const RestVertex& vertex = *check.vertex[v];
    if (vertex.weight[0] < 0.98f || distance(check.posed[v], check.host[v]) <= check.tolerance_ws) continue;
    ++off;
    const std::int64_t fitting = fitting_transform(check, vertex, check.host[v]);
    if (fitting >= 0) found.push_back({vertex.bone[0], fitting});
  }
  if (off == 0 || 2 * found.size() < off) return false;
  const std::span<const Misplaced> all(found.data(), found.size());
  const std::size_t bones = count_of_different(all, [](const Misplaced& m) { return std::int64_t(m.bone); });
  const std::size_t transforms = count_of_different(all, [](const Misplaced& m) { return m.transform; });
  if (bones > 1 && 2 * transforms <= bones) return false;
  const std::uint32_t bone = found[0].bone;
  explain(finding, NOOK_POSE_FAULT_ORDER,
          "the transforms are assigned to the wrong bones: %zu of %zu vertices match only with the transform "
          "of another bone; for example, bone %u (\"%s\") matches with transform %lld; map bones by name",
          found.size(), off, bone, check.model.bone_names[bone].c_str(),
          static_cast<long long>(found[0].transform));
  if (found.size() < off || transforms < bones)
    explain(finding, NOOK_POSE_FAULT_UNKNOWN, "the pose and the vertices are from different frames");
  return true;
}

// Sets the tolerance in the unit of the host's vertices. This unit is estimated from the spread of the
// vertices, because the transforms may be interpreted wrongly. A pose changes the spread only by a few tens
// of percent.
void set_tolerance(Check& check, double tolerance) {
  Vector<Point3> at_rest(check.host.get_allocator());
  at_rest.reserve(check.vertex.size());
  for (const RestVertex* vertex : check.vertex)
    at_rest.push_back({vertex->position.x, vertex->position.y, vertex->position.z});
  const double rest = spread(at_rest), host = spread(check.host);
  const double scale = rest > 0 && host > 0 ? host / rest : 1;
  check.tolerance_ws = tolerance * std::max(check.model.bounding_radius, 1e-6f) * scale;
}

[[noreturn]] void fail_without_vertices(const Check& check) {
  const RestVertex& rest = check.model.bind.vertices[check.all[0].rest_vertex];
  const std::size_t bone = rest.bone[std::min(first_missing(check, rest), rest.bone_count - 1)];
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "every vertex follows at least one bone that has no transform in this pose (for example bone "
                "%zu, \"%s\"); check which skin moves the vertices",
                bone, check.model.bone_names[bone].c_str());
}

bool fits(Check& check, const Reading& reading) {
  return pose(check, reading) && compare(check).max <= check.tolerance_ws;
}

PosedPoints points_of(const Check& check) {
  return {{check.posed.data(), check.posed.size()},
          {check.host.data(), check.host.size()},
          check.tolerance_ws,
          check.given.place,
          check.vertex_place};
}

// Tries pairs of mistakes that are often made together. The most likely pair comes first.
void explain_by_two_mistakes(Check& check, std::span<const Reading> single, PoseFinding& finding,
                             Memory* memory) {
  for (const Reading& reading : readings_of_two_mistakes(check.model, check.given, memory))
    if (fits(check, reading)) return describe(check.model, check.given, reading, finding);
  for (const Reading& reading : single) {
    PoseFinding placed;
    if (!pose(check, reading) || !explain_by_place(points_of(check), placed)) continue;
    describe(check.model, check.given, reading, finding);
    const std::size_t used = std::strlen(finding.text);
    std::snprintf(finding.text + used, sizeof finding.text - used, "; besides, %.*s",
                  static_cast<int>(sizeof finding.text - used - 12), placed.text);
    return;
  }
}

void explain_difference(Check& check, const Reading& as_given, PoseFinding& finding, Memory* memory) {
  const Vector<Reading> readings = other_readings(check.model, check.given, memory);
  for (const Reading& reading : readings)
    if (fits(check, reading)) describe(check.model, check.given, reading, finding);
  if (finding.fault == NOOK_POSE_FAULT_NONE)
    for (const Reading& reading : readings_of_other_layouts(check.given, memory))
      if (fits(check, reading)) describe(check.model, check.given, reading, finding);
  const bool is_readable = pose(check, as_given);
  if (is_readable) explain_by_place(points_of(check), finding);
  if (finding.fault == NOOK_POSE_FAULT_NONE && is_readable) explain_by_order(check, finding);
  if (finding.fault == NOOK_POSE_FAULT_NONE)
    explain_by_two_mistakes(check, {readings.data(), readings.size()}, finding, memory);
  if (finding.fault == NOOK_POSE_FAULT_NONE)
    explain(finding, NOOK_POSE_FAULT_UNKNOWN,
            "the pose differs from the vertices by up to %.3g of the bounding radius, most at bone %u "
            "(\"%s\"), and no known mistake explains the difference; check that the pose and the vertices "
            "are from the same clip, frame, mesh and file",
            finding.max_error, finding.worst_bone, check.model.bone_names[finding.worst_bone].c_str());
}

}  // namespace

PoseFinding find_pose_fault(const CharacterModel& model, const PoseSource& source,
                            std::span<const SkinnedVertex> vertices, const Affine& vertex_place,
                            double tolerance, Memory* memory) {
  Check check(model, source, vertices, memory);
  check.vertex_place = vertex_place;
  for_each_transform(model, source, [&](std::size_t bone, std::uint32_t) { check.has_matrix[bone] = 1; });
  pose_vertices(check);
  if (check.vertex.empty()) fail_without_vertices(check);
  set_tolerance(check, tolerance);
  const std::size_t count = check.vertex.size();
  const RestVertex& first = *check.vertex[0];
  check.least_vertices = std::min<std::size_t>(count, 6);
  const Reading as_given(source, memory);
  PoseFinding finding;
  // A vertex whose posed position is not finite is treated as different from the host's vertex.
  const bool is_readable = pose(check, as_given) && check.vertex.size() == count;
  const Distances distances = is_readable ? compare(check) : Distances{};
  const double unit = check.tolerance_ws / tolerance;
  finding.max_error = distances.max / unit;
  finding.rms_error = distances.rms / unit;
  finding.worst_bone = is_readable ? check.vertex[distances.worst]->bone[0] : first.bone[0];
  if (distances.max <= check.tolerance_ws)
    explain(finding, NOOK_POSE_FAULT_NONE,
            "the pose is right: %zu vertices agree within %.2g of the bounding radius", check.vertex.size(),
            finding.max_error);
  else
    explain_difference(check, as_given, finding, memory);
  return finding;
}

}  // namespace nook
