// A tube of two bones along x as a host would hold it in memory: 18 rings of 10 vertices, open at the ends,
// the joint in the middle. One metre long.
#pragma once

#include <nook/experimental/nook_bake_materials.h>
#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

enum { tube_rings = 18, tube_segments = 10, tube_vertices = tube_rings * tube_segments };
enum { tube_triangles = (tube_rings - 1) * tube_segments * 2 };

struct tube {
  float positions[3 * tube_vertices];
  uint32_t indices[3 * tube_triangles];
  uint16_t joints[2 * tube_vertices];
  float weights[2 * tube_vertices];
  int32_t parents[2];
  float frames[24];
  const char* names[2];
};

void make_tube(tube* out);

// A descriptor that points into the tube.
nook_bake_source_desc describe_tube(const tube* t);
