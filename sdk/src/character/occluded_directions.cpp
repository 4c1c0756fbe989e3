#include "sdk/src/character/occluded_directions.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/character/scene.h"
#include "sdk/src/character/scene_clips.h"
#include "sdk/src/core/failure.h"

namespace nook {
namespace {

void put(std::int8_t* out, Vec3 v) {
  out[0] = encode_coordinate(v.x);
  out[1] = encode_coordinate(v.y);
  out[2] = encode_coordinate(v.z);
}

// The normalised columns of a matrix that consists of a rotation and a uniform scale. Without the scale, the
// inverse of the matrix is its transpose, which transforms directions from rest space to the mesh's space.
struct Axes {
  Vec3 x, y, z;

  explicit Axes(const Mat3x4& m)
      : x(normalised({m.m[0], m.m[4], m.m[8]})),
        y(normalised({m.m[1], m.m[5], m.m[9]})),
        z(normalised({m.m[2], m.m[6], m.m[10]})) {}
  Vec3 to_mesh(Vec3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

// Returns the key point that has the largest blend weight for a vertex.
const KeyPoint& nearest_key_point(const CharacterModel& model, std::size_t vertex) {
  const std::size_t first = vertex * model.influences;
  std::size_t best = first;
  for (std::size_t e = first; e < first + model.influences; ++e)
    if (model.alpha[e] > 0 && (model.alpha[best] == 0 || model.blend[e] > model.blend[best])) best = e;
  return model.key_points[model.influence[best]];
}

Mat3x4 blended_bones(const KeyPoint& point, const Instance& instance) {
  Mat3x4 sum;
  for (float& element : sum.m) element = 0;
  for (int b = 0; b < KeyPoint::max_bones; ++b) {
    if (!(point.weight[b] > 0)) continue;
    const Mat3x4 bone = bone_of(instance, point.bone[b]);
    for (int i = 0; i < 12; ++i) sum.m[i] += point.weight[b] * bone.m[i];
  }
  return sum;
}

}  // namespace

void copy_occluded_directions(const CharacterModel& model, std::int8_t* out,
                              std::size_t stride_bytes) noexcept {
  const auto write = [&](std::size_t file_vertex, const auto& turned) {
    const OccludedEnds& ends = model.occluded[model.file_to_welded[file_vertex]];
    std::int8_t* const place = out + file_vertex * stride_bytes;
    put(place, turned(ends.dark));
    put(place + 4, turned(ends.open));
    place[3] = place[7] = 0;
  };
  for (std::size_t p = 0; p < model.primitives.size(); ++p) {
    const PrimitiveRange& range = model.primitives[p];
    const Axes axes(model.bind.empty() ? Mat3x4{} : model.bind.rest_from_mesh[model.bind.primitive_space[p]]);
    for (std::uint32_t i = 0; i < range.vertex_count; ++i)
      write(range.first_vertex + i, [&](Vec3 v) { return axes.to_mesh(v); });
  }
}

void check_bent_normals(const CharacterModel& model) {
  if (model.occluded.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the model was baked without bent normals; add them with `nook bake bent`");
  if (model.rest.normal.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED, "the model was baked without rest normals; bake it again");
}

// To avoid an allocation, first writes the AO of each vertex as a byte into `out`, and then reads it from
// there.
void read_bent_normals(const Scene& scene, const Instance& instance, std::int8_t* out,
                       std::size_t stride_bytes) noexcept {
  read_ao_as(scene, instance, NOOK_FORMAT_UNORM8, out + 3, stride_bytes);
  const CharacterModel& model = instance.model->model;
  const KeyPoint* turned_by = nullptr;
  Mat3x4 turn;
  for (std::size_t i = 0; i < model.file_to_welded.size(); ++i) {
    const std::size_t vertex = model.file_to_welded[i];
    const KeyPoint& point = nearest_key_point(model, vertex);
    if (&point != turned_by) {
      turn = blended_bones(point, instance);
      turned_by = &point;
    }
    std::int8_t* const place = out + i * stride_bytes;
    const float ao = static_cast<float>(static_cast<std::uint8_t>(place[3])) / 255;
    const Vec3 bent = bent_normal(model.rest.normal[vertex], model.occluded[vertex].at(ao));
    put(place, normalised(transform_vector(turn, bent)));
    place[3] = encode_coordinate(ao);
  }
}

}  // namespace nook
