// The check tries the readings of the host's transforms that mistakes turn into each other, and names the one
// under which the model's vertices fall on the host's. Where none does, a best affine map between the two
// sets of vertices tells a wrong unit, turn or mirror image of the whole pose.
#include "sdk/src/character/pose_check.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <vector>

#include "sdk/src/core/compiler.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/place.h"

namespace nook {
namespace {

using V3 = std::array<double, 3>;

// One way to read the host's transforms.
struct Reading {
  PoseSource source;
  bool is_turned_back = false;  // the 3x3 part is transposed, the translation stays
  bool is_inverted = false;
  double translation_scale = 1;
  nook_pose_fault fault = NOOK_POSE_RIGHT;
};

struct Distances {
  double max = INFINITY, rms = INFINITY;  // metres of the world
  std::size_t worst = 0;                  // index into the compared vertices
};

double distance(const V3& a, const V3& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

Affine read(const Reading& reading, std::uint32_t index) {
  Affine m = read_transform(reading.source, index);
  if (reading.is_turned_back) {
    std::swap(m.m[1], m.m[4]);
    std::swap(m.m[2], m.m[8]);
    std::swap(m.m[6], m.m[9]);
  }
  if (reading.is_inverted) m = inverse(m);
  for (int i = 3; i < 12; i += 4) m.m[i] *= reading.translation_scale;
  return m;
}

// Everything that the readings share.
struct Check {
  const CharacterModel& model;
  const PoseSource& given;
  double tolerance_ws = 0;
  Vector<const RestVertex*> vertex;  // those whose bones all have transforms
  Vector<V3> host;                   // where the host has them
  Vector<std::uint8_t> has_matrix;   // for each bone
  Vector<Affine> matrix;             // for each bone, of the latest reading
  Vector<V3> posed;                  // by the latest reading

  Check(const CharacterModel& of, const PoseSource& source, Memory* memory)
      : model(of),
        given(source),
        vertex(memory),
        host(memory),
        has_matrix(of.bone_count(), std::uint8_t{0}, memory),
        matrix(of.bone_count(), Affine{}, memory),
        posed(memory) {}
};

V3 skinned(const Check& check, const RestVertex& vertex) {
  V3 sum{};
  for (std::uint32_t b = 0; b < vertex.bone_count; ++b) {
    const V3 p =
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
    if (source.transform_count != expected) return false;
  }
  std::fill(check.has_matrix.begin(), check.has_matrix.end(), std::uint8_t{0});
  PoseSource partial = source;
  partial.is_partial = true;
  for_each_transform(check.model, partial, [&](std::size_t bone, std::uint32_t index) {
    check.matrix[bone] = bone_matrix(check.model, source, bone, read(reading, index));
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
  return compare(check, [](const V3& p) { return p; });
}

// The affine map from the posed vertices to the host's that is best in the least-squares sense. Returns false
// where the vertices lie in a plane.
bool best_map(const Check& check, Affine& map) {
  V3 from{}, to{};
  const double share = 1 / static_cast<double>(check.posed.size());
  for (std::size_t v = 0; v < check.posed.size(); ++v)
    for (int i = 0; i < 3; ++i) {
      from[i] += share * check.posed[v][i];
      to[i] += share * check.host[v][i];
    }
  Affine own, cross;  // 3x3 parts: sums of p p^T and of x p^T about the means
  own.m.fill(0);
  cross.m.fill(0);
  for (std::size_t v = 0; v < check.posed.size(); ++v)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double p = check.posed[v][j] - from[j];
        own.m[4 * i + j] += (check.posed[v][i] - from[i]) * p;
        cross.m[4 * i + j] += (check.host[v][i] - to[i]) * p;
      }
  const double trace = own.m[0] + own.m[5] + own.m[10];
  if (!(determinant(own) > 1e-7 * trace * trace * trace)) return false;
  map = cross * inverse(own);
  const V3 moved = transform(map, from[0], from[1], from[2]);
  for (int i = 0; i < 3; ++i) map.m[4 * i + 3] = to[i] - moved[i];
  return true;
}

// The scale of a map that is a similarity, mirrored or not, to 1 %; else 0.
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

void say(PoseFinding& finding, const char* format, ...) NOOK_PRINTF(2, 3);
void say(PoseFinding& finding, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(finding.text, sizeof finding.text, format, arguments);
  va_end(arguments);
}

const char* kind_name(nook_pose_kind kind) {
  constexpr const char* names[] = {"rest-to-world matrices", "joint world matrices", "skinning matrices"};
  return names[kind];
}

nook_transform_layout transposed(nook_transform_layout layout) {
  switch (layout) {
    case NOOK_TRANSFORM_ROWS_3X4:
      return NOOK_TRANSFORM_COLUMNS_4X3;
    case NOOK_TRANSFORM_COLUMNS_4X3:
      return NOOK_TRANSFORM_ROWS_3X4;
    case NOOK_TRANSFORM_ROWS_4X4:
      return NOOK_TRANSFORM_COLUMNS_4X4;
    case NOOK_TRANSFORM_COLUMNS_4X4:
      return NOOK_TRANSFORM_ROWS_4X4;
    default:
      return layout;
  }
}

// The readings of another kind or skin, the likeliest first.
void add_kinds(const Check& check, Vector<Reading>& out) {
  const PoseSource& given = check.given;
  for (std::uint32_t skin = 0; skin < check.model.bind.skins.size(); ++skin) {
    Reading reading{given};
    reading.source.kind = NOOK_POSE_SKINNING;
    reading.source.skin = skin;
    if (given.kind == NOOK_POSE_SKINNING && skin == given.skin) continue;
    reading.fault = given.kind == NOOK_POSE_SKINNING        ? NOOK_POSE_WRONG_SKIN
                    : given.kind == NOOK_POSE_REST_TO_WORLD ? NOOK_POSE_MISSING_S
                                                            : NOOK_POSE_WRONG_KIND;
    out.push_back(reading);
  }
  for (const nook_pose_kind kind : {NOOK_POSE_REST_TO_WORLD, NOOK_POSE_JOINT_TO_WORLD}) {
    if (kind == given.kind) continue;
    Reading reading{given};
    reading.source.kind = kind;
    reading.fault = NOOK_POSE_WRONG_KIND;
    out.push_back(reading);
  }
}

Vector<Reading> other_readings(const Check& check, Memory* memory) {
  Vector<Reading> out(memory);
  add_kinds(check, out);
  Reading other{check.given};
  other.source.layout = transposed(check.given.layout);
  other.fault = NOOK_POSE_TRANSPOSED;
  if (other.source.layout != check.given.layout) out.push_back(other);
  other = Reading{check.given};
  other.is_turned_back = true;
  other.fault = NOOK_POSE_TRANSPOSED;
  out.push_back(other);
  other = Reading{check.given};
  other.is_inverted = true;
  other.fault = NOOK_POSE_INVERTED;
  out.push_back(other);
  // Centimetres, millimetres, inches and feet against metres, both ways round.
  for (const double unit : {100.0, 0.01, 1000.0, 0.001, 1 / 0.0254, 0.0254, 1 / 0.3048, 0.3048}) {
    other = Reading{check.given};
    other.translation_scale = unit;
    other.fault = NOOK_POSE_WRONG_UNIT;
    out.push_back(other);
  }
  // A layout read wrong hides the kind; the two mistakes occur together.
  const std::size_t kinds = out.size();
  for (std::size_t r = 0; r < kinds && transposed(check.given.layout) != check.given.layout; ++r)
    if (out[r].source.kind != check.given.kind || out[r].source.skin != check.given.skin) {
      Reading both = out[r];
      both.source.layout = transposed(check.given.layout);
      both.fault = NOOK_POSE_TRANSPOSED;
      out.push_back(both);
    }
  return out;
}

void describe(const Check& check, const Reading& reading, PoseFinding& finding) {
  finding.fault = reading.fault;
  const PoseSource& source = reading.source;
  switch (reading.fault) {
    case NOOK_POSE_TRANSPOSED:
      if (source.kind != check.given.kind)
        say(finding, "the transforms are transposed, and they are %s; give desc.layout and desc.kind",
            kind_name(source.kind));
      else if (reading.is_turned_back)
        say(finding, "the rotations are transposed, while the translations are right");
      else
        say(finding,
            "the transforms are transposed: rows were given as columns or columns as rows; give "
            "desc.layout");
      break;
    case NOOK_POSE_MISSING_S:
      finding.fitting_skin = check.model.bind.skins[source.skin].file_index;
      say(finding,
          "skinning matrices were given as rest-to-world matrices, so that S^-1 is missing; give "
          "NOOK_POSE_SKINNING with skin %u",
          finding.fitting_skin);
      break;
    case NOOK_POSE_WRONG_SKIN:
      finding.fitting_skin = check.model.bind.skins[source.skin].file_index;
      say(finding, "the skinning matrices are those of skin %u, not of skin %u", finding.fitting_skin,
          check.model.bind.skins[check.given.skin].file_index);
      break;
    case NOOK_POSE_WRONG_KIND:
      say(finding, "the transforms are %s, not %s; give desc.kind", kind_name(source.kind),
          kind_name(check.given.kind));
      break;
    case NOOK_POSE_INVERTED:
      say(finding,
          "the transforms are the inverses of what is needed: they lead from the world to the joints");
      break;
    case NOOK_POSE_WRONG_UNIT:
      finding.scale = reading.translation_scale;
      say(finding, "the translations are in another unit than the vertices: they fit when multiplied by %.6g",
          reading.translation_scale);
      break;
    default:
      break;
  }
}

// The turn of a rotation in degrees.
double turn_degrees(const Affine& map, double scale) {
  const double cosine = 0.5 * ((map.m[0] + map.m[5] + map.m[10]) / scale - 1);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 57.29577951308232;
}

bool explain_by_map(Check& check, PoseFinding& finding) {
  Affine map;
  if (!best_map(check, map)) return false;
  const double scale = scale_of_similarity(map);
  if (scale == 0) return false;
  const Distances left = compare(check, [&](const V3& p) { return transform(map, p[0], p[1], p[2]); });
  if (!(left.max <= check.tolerance_ws)) return false;
  finding.scale = scale;
  const bool is_mirrored = determinant(map) < 0;
  if (std::abs(scale - 1) > 0.02) {
    finding.fault = NOOK_POSE_WRONG_UNIT;
    say(finding,
        "the pose is in another unit than the vertices: it fits when multiplied by %.6g%s; scale "
        "desc.place_3x4 "
        "or the vertices' place",
        scale, is_mirrored ? " and mirrored" : "");
    return true;
  }
  finding.fault = NOOK_POSE_WRONG_PLACE;
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
std::int64_t fitting_transform(const Check& check, const RestVertex& vertex, const V3& host) {
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
  finding.fault = NOOK_POSE_WRONG_ORDER;
  say(finding,
      "transforms go to the wrong bones: %zu of %zu vertices fit under the transform of another bone; bone "
      "%u "
      "(\"%s\") fits with transform %lld; map bones by name",
      found, off, bone, check.model.bone_names[bone].c_str(), static_cast<long long>(transform_index));
  return true;
}

// The root mean square distance of points from their mean.
template <class Point>
double spread(std::size_t count, Point&& point) {
  V3 mean{};
  double squares = 0;
  for (std::size_t v = 0; v < count; ++v)
    for (int i = 0; i < 3; ++i) mean[i] += point(v)[i] / static_cast<double>(count);
  for (std::size_t v = 0; v < count; ++v) {
    const double d = distance(point(v), mean);
    squares += d * d / static_cast<double>(count);
  }
  return std::sqrt(squares);
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
  const double rest = spread(check.vertex.size(), [&](std::size_t v) {
    const Vec3 p = check.vertex[v]->position;
    return V3{p.x, p.y, p.z};
  });
  const double host = spread(check.host.size(), [&](std::size_t v) { return check.host[v]; });
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
  const Vector<Reading> readings = other_readings(check, memory);
  for (const Reading& reading : readings)
    if (pose(check, reading) && compare(check).max <= check.tolerance_ws) {
      describe(check, reading, finding);
      return finding;
    }
  if (is_readable && pose(check, as_given)) {
    if (explain_by_map(check, finding)) return finding;
    if (explain_by_order(check, finding)) return finding;
  }
  for (const Reading& reading : readings)
    if (pose(check, reading) && explain_by_map(check, finding)) {
      describe(check, reading, finding);
      return finding;
    }
  finding.fault = NOOK_POSE_UNKNOWN_FAULT;
  say(finding,
      "the pose differs by up to %.3g of the bounding radius, most at bone %u (\"%s\"), and no known mistake "
      "explains it: another clip or frame, another mesh, or vertices of another file",
      finding.max_error, finding.worst_bone, model.bone_names[finding.worst_bone].c_str());
  return finding;
}

}  // namespace nook
