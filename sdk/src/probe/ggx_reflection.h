// The reflection of a GGX surface as numbers that depend only on the view: its directional albedo, and a few
// visible normals that stand for all.
//
// tests/probe/ggx_fit.cpp fits the polynomials to quadrature over visible normals, for alpha 0.004 to 1 and
// facing 0.02 to 1, and prints their coefficients. shaders/probe/ggx_reflection.glsl has the same functions.
#pragma once

#include <array>
#include <span>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"

namespace nook::probe {

struct Surface {
  Vec3 normal{0, 0, 1};       // unit
  Vec3 view{0, 0, 1};         // unit, towards the eye
  Vec3 tangent{1, 0, 0};      // unit, across the normal; read only if alpha_x and alpha_y differ
  float alpha_x = 0.25f;      // GGX width, roughness squared, along the tangent
  float alpha_y = 0.25f;      // across it; the isotropic form takes their geometric mean
  float reflectance = 0.04f;  // at normal incidence
};

// A surface seen from a direction. The plane of incidence contains normal and view. If the view is along the
// normal, any plane is right, and the tangent's is used.
struct SurfaceView {
  Vec3 tangent, bitangent;
  float view_x, view_y;  // dot(view, tangent), dot(view, bitangent)
  float facing;          // dot(normal, view), 1e-3 or more
  float stretched_x;     // the same plane among round slopes: a unit vector along tangent and bitangent
  float stretched_y;
  float alpha2_in_plane;     // squared width of slopes within the plane
  float alpha2_across;       // and at right angles to it
  float openness;            // facing / sqrt(facing^2 + (slopes towards the eye)^2): 0 where masked, 1 open
  float roughness_in_plane;  // root of the isotropic alpha with the same tilt
};
SurfaceView view_of(const Surface& surface);

// Returns the share of uniform light that leaves towards the eye, single scattering. It uses Smith masking
// with correlated heights (E. Heitz, Understanding the Masking-Shadowing Function, 2014, equation 99) and
// Schlick Fresnel. The isotropic form is within 5 % from reflectance 0.02 on; nook_probe.h has the rest.
float directional_albedo(const SurfaceView& view, const Surface& surface);

// A normal that the eye sees, as a point of the unit disc in which all visible normals are evenly distributed
// (E. Heitz, Sampling the GGX Distribution of Visible Normals, 2018). The mapping contains both widths and
// the view. The normal stands for the normals around it.
struct VisibleNormal {
  float across, along;  // at right angles to the plane of incidence, among round slopes, and within it
  float share;          // of the disc, relative to the others'
  float sharpness;      // of the lobe that the normals around it reflect, divided by the density of
                        // directions there
};
// middle_normal is for one lobe. The other is for four: two within the plane of incidence, and a pair beside
// it.
VisibleNormal middle_normal(const SurfaceView& view, const Surface& surface);
std::array<VisibleNormal, 4> visible_normals(const SurfaceView& view, const Surface& surface);

// Replaces `lobes` by as many lobes that the normals reflect to the eye, with integral 1 together. Each is
// weighted by its share and by the masking of the light.
void reflect(const SurfaceView& view, const Surface& surface, std::span<const VisibleNormal> normals,
             std::span<SphericalGaussian> lobes);

}  // namespace nook::probe
