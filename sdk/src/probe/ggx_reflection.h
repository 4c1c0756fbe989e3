// The reflection of a GGX surface as numbers that depend on the view alone: its directional albedo, and the
// mean and the widths of the lobe of directions that it reflects to the eye.
//
// Polynomials fitted to quadrature over visible normals, alpha 0.004 to 1, facing 0.02 to 1, by
// tests/probe/ggx_fit.cpp, which prints their coefficients; shaders/probe/ggx_reflection.glsl has the same.
#pragma once

#include "sdk/src/core/vec.h"

namespace nook::probe {

struct Surface {
  Vec3 normal{0, 0, 1};       // unit
  Vec3 view{0, 0, 1};         // unit, towards the eye
  Vec3 tangent{1, 0, 0};      // unit, across the normal; read where alpha_x and alpha_y differ
  float alpha_x = 0.25f;      // GGX width, roughness squared, along the tangent
  float alpha_y = 0.25f;      // across it; the isotropic form takes their geometric mean
  float reflectance = 0.04f;  // at normal incidence
};

// A view of a surface. The plane of incidence holds normal and view; seen straight on, any plane does, and
// the tangent's is taken.
struct SurfaceView {
  Vec3 tangent, bitangent;
  Vec3 in_plane;             // unit, across the normal, to the view's side
  float view_x, view_y;      // dot(view, tangent), dot(view, bitangent)
  float facing;              // dot(normal, view), 1e-3 or more
  float alpha2_in_plane;     // squared width of slopes along in_plane
  float alpha2_across;       // and at right angles to it
  float openness;            // facing / sqrt(facing^2 + (slopes towards the eye)^2): 0 where masked, 1 open
  float roughness_in_plane;  // root of the isotropic alpha that tilts alike
};
SurfaceView view_of(const Surface& surface);

// Share of uniform light that leaves towards the eye, single scattering: Smith masking of both directions,
// Schlick Fresnel. Isotropic within 5 % from reflectance 0.02 on; the header has the rest.
float directional_albedo(const SurfaceView& view, const Surface& surface);

// The mean normal, weighed by what it reflects: the lobe's centre is the view mirrored in it. Towards the
// eye of the surface's own normal, ever more so the rougher it is.
Vec3 mean_micro_normal(const SurfaceView& view, const Surface& surface);

// Squared widths of the lobe over those of slopes: how much of GGX's tails counts for broad lights, less what
// masking cuts off.
struct LobeWidths {
  float in_plane, across;
};
LobeWidths lobe_widths(const SurfaceView& view);

}  // namespace nook::probe
