#include "bakers/import/clip.h"

#include <algorithm>
#include <cmath>

#include "bakers/import/gltf.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/core/mirroring_similarity.h"

namespace nook::bake {
namespace {

using Value = std::array<double, 4>;

Value load(const Channel& channel, std::size_t element) {
  Value v{};
  const int n = channel.components();
  for (int i = 0; i < n; ++i) v[i] = channel.value[element * n + i];
  return v;
}

Value mixed(const Value& a, double wa, const Value& b, double wb) {
  return {a[0] * wa + b[0] * wb, a[1] * wa + b[1] * wb, a[2] * wa + b[2] * wb, a[3] * wa + b[3] * wb};
}

double dot(const Value& a, const Value& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

Value unit_quaternion(const Value& q) {
  const double length = std::sqrt(dot(q, q));
  return length > 1e-12 ? mixed(q, 1 / length, q, 0) : Value{0, 0, 0, 1};
}

// Spherical interpolation along the shorter arc (Shoemake 1985, "Animating Rotation with Quaternion Curves").
Value slerp(Value a, Value b, double t) {
  a = unit_quaternion(a);
  b = unit_quaternion(b);
  double cosine = dot(a, b);
  if (cosine < 0) {
    b = mixed(b, -1, b, 0);
    cosine = -cosine;
  }
  if (cosine > 1 - 1e-9) return unit_quaternion(mixed(a, 1 - t, b, t));
  const double angle = std::acos(cosine);
  const double s = 1 / std::sin(angle);
  return mixed(a, std::sin((1 - t) * angle) * s, b, std::sin(t * angle) * s);
}

// glTF 2.0, appendix C.5: cubic Hermite spline, tangents in units per second.
Value hermite(const Channel& channel, std::size_t key, double t, double span_s) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  const Value p0 = load(channel, 3 * key + 1);
  const Value m0 = load(channel, 3 * key + 2);
  const Value m1 = load(channel, 3 * (key + 1));
  const Value p1 = load(channel, 3 * (key + 1) + 1);
  const Value ends = mixed(p0, 2 * t3 - 3 * t2 + 1, p1, 3 * t2 - 2 * t3);
  const Value slopes = mixed(m0, span_s * (t3 - 2 * t2 + t), m1, span_s * (t3 - t2));
  return mixed(ends, 1, slopes, 1);
}

Value key_value(const Channel& channel, std::size_t key) {
  return load(channel, channel.interpolation == Interpolation::cubic_spline ? 3 * key + 1 : key);
}

Value evaluate(const Channel& channel, double time_s) {
  const std::vector<float>& times = channel.time_s;
  const auto after = std::upper_bound(times.begin(), times.end(), time_s);
  if (after == times.begin()) return key_value(channel, 0);
  const std::size_t key = after - times.begin() - 1;
  if (after == times.end()) return key_value(channel, key);
  const double span_s = static_cast<double>(times[key + 1]) - times[key];
  const double t = (time_s - times[key]) / span_s;  // upper_bound gives times[key] <= time < times[key + 1]
  switch (channel.interpolation) {
    case Interpolation::step:
      return key_value(channel, key);
    case Interpolation::cubic_spline:
      return hermite(channel, key, t, span_s);
    case Interpolation::linear:
      break;
  }
  const Value a = key_value(channel, key);
  const Value b = key_value(channel, key + 1);
  return channel.path == ChannelPath::rotation ? slerp(a, b, t) : mixed(a, 1 - t, b, t);
}

}  // namespace

Pose bone_matrices(const ImportedCharacter& character, const std::vector<Trs>& locals,
                   std::vector<double>* deviation) {
  const std::vector<Affine> world = world_transforms(character.nodes, locals);
  if (deviation) deviation->clear();
  Pose pose;
  pose.reserve(character.bindings.size());
  for (std::size_t b = 0; b < character.bindings.size(); ++b) {
    const BoneBinding& binding = character.bindings[b];
    const Similarity bone =
        nearest_mirroring_similarity(world[binding.node] * binding.node_from_rest, binding.origin_rest);
    pose.push_back(to_float(bone.matrix));
    if (!is_pose_matrix(pose.back()))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "a clip or the default pose moves bone %zu (\"%s\") beyond 1e9 m, scales it by more than "
                    "1e6, or gives it a matrix that is not finite",
                    b, character.mesh.bones[b].name.c_str());
    if (deviation) deviation->push_back(bone.deviation);
  }
  return pose;
}

void apply_clip(const Clip& clip, float time_s, std::vector<Trs>& locals) {
  const double time = std::isfinite(time_s) ? std::clamp(time_s, 0.0f, clip.duration_s) : 0.0;
  for (const Channel& channel : clip.channels) {
    const Value v = evaluate(channel, time);
    Trs& local = locals[channel.node];
    switch (channel.path) {
      case ChannelPath::translation:
        local.translation = {v[0], v[1], v[2]};
        break;
      case ChannelPath::rotation:
        local.rotation = unit_quaternion(v);
        break;
      case ChannelPath::scale:
        local.scale = {v[0], v[1], v[2]};
        break;
    }
  }
}

Pose sample_clip(const ImportedCharacter& character, std::size_t clip, float time_s) {
  if (clip >= character.clips.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "clip index out of range (got %zu, file has %zu clips)", clip,
                  character.clips.size());
  std::vector<Trs> locals = default_locals(character.nodes);
  apply_clip(character.clips[clip], time_s, locals);
  return bone_matrices(character, locals, nullptr);
}

Pose rest_pose(const ImportedCharacter& character) {
  return Pose(character.mesh.bones.size());
}

std::size_t find_clip(const ImportedCharacter& character, std::string_view name) {
  std::string names;
  for (std::size_t i = 0; i < character.clips.size(); ++i) {
    if (character.clips[i].name == name) return i;
    names += (i ? ", " : "") + character.clips[i].name;
  }
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "no clip is called \"%.*s\"; this file has %s",
                static_cast<int>(name.size()), name.data(), names.empty() ? "no clips" : names.c_str());
}

}  // namespace nook::bake
