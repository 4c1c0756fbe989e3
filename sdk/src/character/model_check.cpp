#include "sdk/src/character/model.h"

#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook {
namespace {

// Upper bound for gamma. For larger values, the norm equals the maximum norm in float precision.
constexpr float max_gamma = 64;
constexpr float max_blend = 16;             // far above the values that a file can hold
constexpr std::size_t max_indexed = 65536;  // number of values of a 16-bit index

bool within(float value, float low, float high) {
  return value >= low && value <= high;
}  // the comparison is false for NaN
// The tolerance of 1e-3 is far above rounding and quantisation errors. A vector that was not normalised
// usually differs by far more.
bool is_unit(Vec3 n) {
  return within(dot(n, n), 1 - 2e-3f, 1 + 2e-3f);
}

struct Check {
  nook_result code;

  void count(const char* what, std::size_t got, std::size_t low, std::size_t high) const {
    if (got < low || got > high)
      throw Failure(code, "the number of %s is out of range (got %zu, need %zu to %zu); bake the model again",
                    what, got, low, high);
  }
  void sized(const char* what, std::size_t got, std::size_t need) const {
    if (got != need)
      throw Failure(code, "the array of %s has the wrong length (got %zu, need %zu); bake the model again",
                    what, got, need);
  }
  void that(bool sound, const char* what, std::size_t index, double got, const char* need) const {
    if (!sound)
      throw Failure(code, "%s %zu is out of range (got %g, need %s); bake the model again", what, index, got,
                    need);
  }
  void place(const char* what, std::size_t index, Vec3 p) const {
    if (!is_place(p))
      throw Failure(
          code, "%s %zu is out of range (got %g %g %g, need finite metres below 1e6); bake the model again",
          what, index, double(p.x), double(p.y), double(p.z));
  }
  void unit(const char* what, std::size_t index, Vec3 n) const {
    if (!is_unit(n))
      throw Failure(code, "%s %zu is not a unit vector (got %g %g %g); bake the model again", what, index,
                    double(n.x), double(n.y), double(n.z));
  }
};

void check_spheres(const CharacterModel& model, const Vector<ProxySphere>& spheres, const Check& check) {
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const ProxySphere& sphere = spheres[i];
    check.place("centre of sphere", i, sphere.centre);
    check.that(sphere.radius > 0 && sphere.radius <= max_metres, "radius of sphere", i, sphere.radius,
               "more than 0");
    check.that(sphere.bone < model.bone_count(), "bone of sphere", i, sphere.bone,
               "less than the number of bones");
    check.that(within(sphere.caster_weight, 0, max_coefficient), "caster weight of sphere", i,
               sphere.caster_weight, "0 to 1e4");
  }
}

void check_key_points(const CharacterModel& model, const Check& check) {
  for (std::size_t k = 0; k < model.key_points.size(); ++k) {
    const KeyPoint& point = model.key_points[k];
    check.place("position of key point", k, point.position);
    check.place("surface position of key point", k, point.surface_position);
    check.unit("normal of key point", k, point.normal);
    check.unit("surface normal of key point", k, point.surface_normal);
    float sum = 0;
    for (int b = 0; b < KeyPoint::max_bones; ++b) {
      check.that(point.bone[b] < model.bone_count(), "bone of key point", k, point.bone[b],
                 "less than the number of bones");
      check.that(within(point.weight[b], 0, 1), "bone weight of key point", k, point.weight[b], "0 to 1");
      sum += point.weight[b];
    }
    // The tolerance of 1e-4 is well above the error of four float additions and a conversion from double.
    check.that(within(sum, 1 - 1e-4f, 1 + 1e-4f), "sum of bone weights of key point", k, sum, "1");
    check.that(within(point.saturation, 0, max_saturation), "saturation of key point", k, point.saturation,
               "0 to 64");
  }
}

void check_linear_layer(const CharacterModel& model, const Check& check) {
  const std::size_t vertices = model.vertex_count(), entries = vertices * model.influences;
  check.sized("influences", model.influence.size(), entries);
  check.sized("alphas", model.alpha.size(), entries);
  check.sized("blend weights", model.blend.size(), entries);
  if (!model.static_ao.empty()) check.sized("static AO", model.static_ao.size(), vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    float sum = 0, blend_sum = 0;
    for (std::size_t e = i * model.influences; e < (i + 1) * model.influences; ++e) {
      check.that(model.influence[e] < model.key_points.size(), "key point of vertex", i, model.influence[e],
                 "less than the number of key points");
      check.that(within(model.alpha[e], 0, max_coefficient), "alpha of vertex", i, model.alpha[e],
                 "0 to 1e4");
      check.that(within(model.blend[e], -max_blend, max_blend), "blend weight of vertex", i, model.blend[e],
                 "-16 to 16");
      sum += model.alpha[e];
      blend_sum += model.blend[e];
    }
    check.that(sum > 0, "sum of alphas of vertex", i, sum, "more than 0");
    for (std::size_t e = i * model.influences; e < (i + 1) * model.influences; ++e)
      check.that(model.alpha[e] > 0 || model.blend[e] == 0, "blend weight of vertex", i, model.blend[e],
                 "0, because its alpha is 0");
    // The tolerance allows for the rounding errors of eight additions of values up to 16.
    check.that(within(blend_sum, 1 - 1e-4f, 1 + 1e-4f), "sum of blend weights of vertex", i, blend_sum, "1");
    check.that(within(std::abs(model.bias[i]), 0, max_coefficient), "bias of vertex", i, model.bias[i],
               "-1e4 to 1e4");
    if (!model.static_ao.empty())
      check.that(within(model.static_ao[i], 0, 1), "static AO of vertex", i, model.static_ao[i], "0 to 1");
  }
}

void check_level(const CharacterModel& model, const CharacterLevel& level, const Check& check) {
  const std::size_t key_points = model.key_points.size();
  check.count("spheres of a level", level.spheres.size(), 1, model.spheres.size());
  check_spheres(model, level.spheres, check);
  check.count("evaluated key points of a level", level.evaluated.size(), 1, key_points);
  for (std::size_t i = 0; i < level.evaluated.size(); ++i)
    check.that(level.evaluated[i] < key_points && (i == 0 || level.evaluated[i - 1] < level.evaluated[i]),
               "evaluated key point", i, level.evaluated[i], "ascending, less than the number of key points");
  check.sized("sources of a level", level.source.size(), key_points);
  check.sized("scales of a level", level.scale.size(), key_points);
  check.sized("offsets of a level", level.offset.size(), key_points);
  for (std::size_t k = 0; k < key_points; ++k) {
    check.that(level.source[k] < level.evaluated.size(), "source of key point", k, level.source[k],
               "less than the number of evaluated key points");
    check.that(within(level.scale[k], 0, max_coefficient), "scale of key point", k, level.scale[k],
               "0 to 1e4");
    check.that(within(std::abs(level.offset[k]), 0, max_coefficient), "offset of key point", k,
               level.offset[k], "-1e4 to 1e4");
  }
  check.that(within(level.error_rms, 0, max_coefficient), "error of level", 0, level.error_rms, "0 to 1e4");
}

void check_world_casters(const CharacterModel& model, const Check& check) {
  check.count("world casters", model.world_casters.size(), 0, CharacterModel::max_world_casters);
  for (std::size_t i = 0; i < model.world_casters.size(); ++i) {
    const WorldCaster& caster = model.world_casters[i];
    check.place("first end of world caster", i, caster.capsule.a);
    check.place("second end of world caster", i, caster.capsule.b);
    for (const float radius : {caster.capsule.radius_a, caster.capsule.radius_b})
      check.that(radius > 0 && radius <= max_metres, "radius of world caster", i, radius, "more than 0");
    check.that(caster.ao_scale > 0 && caster.ao_scale <= max_coefficient, "AO scale of world caster", i,
               caster.ao_scale, "more than 0");
    check.that(caster.bone < model.bone_count(), "bone of world caster", i, caster.bone,
               "less than the number of bones");
  }
}

void check_occluded(const CharacterModel& model, const Check& check) {
  if (model.occluded.empty()) return;
  check.sized("occluded directions", model.occluded.size(), model.vertex_count());
  for (std::size_t i = 0; i < model.occluded.size(); ++i)
    for (const Vec3 end : {model.occluded[i].dark, model.occluded[i].open})
      for (const float coordinate : {end.x, end.y, end.z})
        check.that(within(coordinate, -1, 1), "occluded direction of vertex", i, coordinate, "-1 to 1");
}

void check_file_order(const CharacterModel& model, const Check& check) {
  for (std::size_t i = 0; i < model.file_to_welded.size(); ++i)
    check.that(model.file_to_welded[i] < model.vertex_count(), "welded vertex of file vertex", i,
               model.file_to_welded[i], "less than the number of welded vertices");
  std::uint64_t next = 0;
  for (std::size_t p = 0; p < model.primitives.size(); ++p) {
    check.that(model.primitives[p].first_vertex == next, "first vertex of primitive", p,
               model.primitives[p].first_vertex, "the end of the previous primitive");
    next += model.primitives[p].vertex_count;
  }
  check.sized("file vertices", model.file_to_welded.size(), next);
}

// Returns true if the 3x3 part is invertible. The threshold is relative to the length of its columns.
bool is_invertible(const Mat3x4& matrix) {
  const float* m = matrix.m;
  const Vec3 x{m[0], m[4], m[8]}, y{m[1], m[5], m[9]}, z{m[2], m[6], m[10]};
  const double volume = std::abs(double(dot(cross(x, y), z)));
  const double size = double(length(x)) + length(y) + length(z);
  return is_pose_matrix(matrix) && volume > 1e-12 * size * size * size;
}

void check_bind_data(const CharacterModel& model, const Check& check) {
  const BindData& bind = model.bind;
  if (bind.empty()) return;
  check.sized("bind matrices", bind.bones.size(), model.bone_count());
  for (std::size_t b = 0; b < bind.bones.size(); ++b) {
    const BoneBind& bone = bind.bones[b];
    check.that(is_invertible(bone.node_from_rest), "bind matrix of bone", b, 0, "an invertible matrix");
    check.that(
        bone.first_of_joint <= b && bind.bones[bone.first_of_joint].first_of_joint == bone.first_of_joint,
        "first bone of the joint of bone", b, bone.first_of_joint,
        "the index of an earlier bone or of the bone itself");
  }
  const std::size_t spaces = bind.rest_from_mesh.size();
  check.count("spaces of meshes", spaces, 0, max_indexed);
  for (std::size_t s = 0; s < spaces; ++s)
    check.that(is_invertible(bind.rest_from_mesh[s]), "rest_from_mesh", s, 0, "an invertible matrix");
  check.sized("spaces of primitives", bind.primitive_space.size(), model.primitives.size());
  for (std::size_t p = 0; p < bind.primitive_space.size(); ++p)
    check.that(bind.primitive_space[p] < spaces, "space of primitive", p, bind.primitive_space[p],
               "less than the number of spaces");
  for (std::size_t s = 0; s < bind.skins.size(); ++s) {
    const SkinBind& skin = bind.skins[s];
    check.that(skin.space < spaces, "space of skin", s, skin.space, "less than the number of spaces");
    check.that(std::uint64_t(skin.first_joint) + skin.joint_count <= bind.bone_of_joint.size(),
               "joints of skin", s, skin.joint_count, "a range inside the list of joints");
  }
  for (std::size_t j = 0; j < bind.bone_of_joint.size(); ++j)
    check.that(bind.bone_of_joint[j] < model.bone_count(), "bone of joint", j, bind.bone_of_joint[j],
               "less than the number of bones");
  check.count("rest vertices", bind.vertices.size(), 0, BindData::max_vertices);
  for (std::size_t v = 0; v < bind.vertices.size(); ++v) {
    const RestVertex& vertex = bind.vertices[v];
    check.that(vertex.file_vertex < model.file_to_welded.size(), "file vertex of rest vertex", v,
               vertex.file_vertex, "less than the number of file vertices");
    check.place("position of rest vertex", v, vertex.position);
    check.that(vertex.bone_count >= 1 && vertex.bone_count <= RestVertex::max_bones,
               "bone count of rest vertex", v, vertex.bone_count, "1 to 8");
    float sum = 0;
    for (std::uint32_t b = 0; b < vertex.bone_count; ++b) {
      check.that(vertex.bone[b] < model.bone_count(), "bone of rest vertex", v, vertex.bone[b],
                 "less than the number of bones");
      check.that(within(vertex.weight[b], 0, 1), "bone weight of rest vertex", v, vertex.weight[b], "0 to 1");
      sum += vertex.weight[b];
    }
    check.that(within(sum, 1 - 1e-4f, 1 + 1e-4f), "sum of bone weights of rest vertex", v, sum, "1");
  }
}

// Checks only that the coordinates are finite. A mesh may use any unit, so their size is not limited.
bool is_finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void check_close_vertices(const CharacterModel& model, const Check& check) {
  const Vector<CloseVertex>& close = model.bind.close;
  for (std::size_t v = 0; v < close.size(); ++v) {
    const CloseVertex& vertex = close[v];
    check.that(vertex.welded < model.vertex_count(), "welded vertex of close vertex", v, vertex.welded,
               "less than the number of welded vertices");
    check.that(vertex.space < model.bind.rest_from_mesh.size(), "space of close vertex", v, vertex.space,
               "less than the number of spaces");
    check.that(is_finite(vertex.mesh_position), "position of close vertex", v, vertex.mesh_position.x,
               "finite numbers");
    const BoneWeights& weights = vertex.weights;
    check.that(weights.count <= BoneWeights::max_bones, "bone count of close vertex", v, weights.count,
               "0 to 8");
    float sum = 0;
    for (std::uint32_t b = 0; b < weights.count; ++b) {
      check.that(weights.bone[b] < model.bone_count(), "bone of close vertex", v, weights.bone[b],
                 "less than the number of bones");
      check.that(within(weights.weight[b], 0, 1), "bone weight of close vertex", v, weights.weight[b],
                 "0 to 1");
      sum += weights.weight[b];
    }
    check.that(weights.count == 0 || within(sum, 1 - 1e-4f, 1 + 1e-4f), "sum of bone weights of close vertex",
               v, sum, "1");
  }
}

void check_rest_surface(const CharacterModel& model, const Check& check) {
  const RestSurface& rest = model.rest;
  if (rest.position.empty() && rest.normal.empty()) return;
  check.sized("rest positions", rest.position.size(), model.vertex_count());
  check.sized("rest normals", rest.normal.size(), model.vertex_count());
  for (std::size_t i = 0; i < rest.position.size(); ++i) {
    check.place("rest position of vertex", i, rest.position[i]);
    check.unit("rest normal of vertex", i, rest.normal[i]);
  }
}

}  // namespace

void check_model(const CharacterModel& model, nook_result code) {
  const Check check{code};
  check.count("bones", model.bone_count(), 1, max_indexed);
  check.count("spheres", model.spheres.size(), 1, max_indexed);
  check.count("key points", model.key_points.size(), 1, max_indexed);
  check.count("vertices", model.vertex_count(), 1, UINT32_MAX);
  check.count("file vertices", model.file_to_welded.size(), 1, UINT32_MAX);
  check.count("primitives", model.primitives.size(), 1, UINT32_MAX);
  check.count("influences of a vertex", model.influences, 1, CharacterModel::max_influences);
  if (static_cast<int>(model.kernel.form) >= kernel_form_count)
    throw Failure(code, "the kernel form is unknown (got %d, need less than %d); use a newer library",
                  static_cast<int>(model.kernel.form), kernel_form_count);
  check.that(within(model.kernel.gamma, 1, max_gamma), "gamma", 0, model.kernel.gamma, "1 to 64");
  check.place("bounding centre", 0, model.bounding_centre);
  check.that(within(model.bounding_radius, 0, 2 * max_metres), "bounding radius", 0, model.bounding_radius,
             "metres");
  check.that(model.root_bone < model.bone_count(), "root bone", 0, model.root_bone,
             "less than the number of bones");
  for (std::size_t b = 0; b < model.bone_count(); ++b)
    if (model.bone_names[b].find('\0') != String::npos)
      throw Failure(code, "the name of bone %zu holds a NUL character; bake the model again", b);
  check_spheres(model, model.spheres, check);
  check_key_points(model, check);
  check_linear_layer(model, check);
  check_file_order(model, check);
  check_bind_data(model, check);
  check_close_vertices(model, check);
  check_rest_surface(model, check);
  check_world_casters(model, check);
  check_occluded(model, check);
  check.count("levels of detail", model.levels.size(), 0, CharacterModel::max_levels);
  for (const CharacterLevel& level : model.levels) check_level(model, level, check);
}

}  // namespace nook
