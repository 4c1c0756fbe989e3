#include "tests/bakers/api/tube.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

static constexpr float identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

void make_tube(tube* out) {
  std::uint32_t* index = out->indices;
  for (int r = 0; r < tube_rings; ++r)
    for (int s = 0; s < tube_segments; ++s) {
      const int v = r * tube_segments + s;
      const float x = float(r) / float(tube_rings - 1);
      const float angle = 6.2831853f * float(s) / float(tube_segments);
      const float tip = std::clamp((x - 0.4f) / 0.2f, 0.0f, 1.0f);
      out->positions[3 * v] = x;
      out->positions[3 * v + 1] = 0.1f * std::cos(angle);
      out->positions[3 * v + 2] = 0.1f * std::sin(angle);
      out->joints[2 * v] = 0;
      out->joints[2 * v + 1] = 1;
      out->weights[2 * v] = 1 - tip;
      out->weights[2 * v + 1] = tip;
    }
  for (int r = 0; r + 1 < tube_rings; ++r)
    for (int s = 0; s < tube_segments; ++s) {
      const auto a = std::uint32_t(r * tube_segments + s),
                 b = std::uint32_t(r * tube_segments + (s + 1) % tube_segments);
      const std::uint32_t triangle[6] = {a, b, a + tube_segments, b, b + tube_segments, a + tube_segments};
      index = std::copy_n(triangle, 6, index);
    }
  out->parents[0] = -1;
  out->parents[1] = 0;
  std::copy_n(identity, 12, out->frames);
  std::copy_n(identity, 12, out->frames + 12);
  out->frames[12 + 3] = 0.5f;
  out->names[0] = "root";
  out->names[1] = "tip";
}

nook_bake_source_desc describe_tube(const tube* t) {
  nook_bake_source_desc desc;
  nook_bake_source_desc_init(&desc);
  desc.positions = t->positions;
  desc.indices = t->indices;
  desc.joints = t->joints;
  desc.weights = t->weights;
  desc.vertex_count = tube_vertices;
  desc.index_count = 3 * tube_triangles;
  desc.influences = 2;
  desc.bone_count = 2;
  desc.bone_names = t->names;
  desc.bone_parents = t->parents;
  desc.bone_frames_3x4 = t->frames;
  return desc;
}
