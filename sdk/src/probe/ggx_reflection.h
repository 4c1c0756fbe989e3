// The parts of a GGX surface's reflection that depend only on the view: the directional albedo, and a few
// visible normals that represent all visible normals.
//
// tests/probe/ggx_fit.cpp fits the polynomials to a quadrature over visible normals, for alpha from 0.004 to
// 1 and facing from 0.02 to 1, and prints their coefficients. shaders/probe/ggx_reflection.glsl has the same
// functions.
#pragma once

#include <array>
#include <span>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"

namespace nook::probe {

struct Surface {
  Vec3 normal{0, 0, 1};       // unit
  Vec3 view{0, 0, 1};         // unit, towards the eye
  Vec3 tangent{1, 0, 0};      // unit, perpendicular to the normal; only read if alpha_x and alpha_y differ
  float alpha_x = 0.25f;      // GGX width along the tangent: the squared roughness
  float alpha_y = 0.25f;      // GGX width along the bitangent; the isotropic form uses the geometric mean of
                              // both widths
  float reflectance = 0.04f;  // at normal incidence
};

// A surface, seen from a direction. The plane of incidence contains the normal and the view direction. If the
// view direction equals the normal, every plane through the normal would be correct; the plane that contains
// the tangent is used.
struct SurfaceView {
  Vec3 tangent, bitangent;
  float view_x, view_y;  // dot(view, tangent), dot(view, bitangent)
  float facing;          // dot(normal, view), 1e-3 or more
  float stretched_x;     // the direction of the plane of incidence in stretched space: a unit vector in the
                         // axes tangent and bitangent
  float stretched_y;
  float alpha2_in_plane;     // squared width of slopes within the plane
  float alpha2_across;       // squared width of slopes across the plane
  float openness;            // facing / sqrt(facing^2 + (slopes towards the eye)^2); 0 is fully masked, 1 is
                             // open
  float roughness_in_plane;  // the square root of the isotropic alpha that tilts normals equally far
};
SurfaceView view_of(const Surface& surface);

// Returns the fraction of uniform light that the surface reflects towards the eye, with single scattering. It
// uses Smith masking with correlated heights (E. Heitz, Understanding the Masking-Shadowing Function, 2014,
// equation 99) and Schlick Fresnel. For a reflectance of at least 0.02, the error of the isotropic form is at
// most 5 %; nook_probe.h documents the other errors.
float directional_albedo(const SurfaceView& view, const Surface& surface);

// A normal that the eye sees. The normal is given as a point of a unit disc, in which all visible normals are
// evenly distributed (E. Heitz, Sampling the GGX Distribution of Visible Normals, 2018). The mapping depends
// on both widths and on the view. The normal represents all normals near it.
struct VisibleNormal {
  float across, along;  // coordinates in the disc, across and along the plane of incidence
  float share;          // area of the disc that the normal represents, relative to the other normals
  float sharpness;  // the normals around this one reflect a lobe; this is the lobe's sharpness, divided by
                    // the density of reflected directions there
};
// middle_normal returns the normal for a single lobe. visible_normals returns four normals for four lobes:
// two in the plane of incidence, and one on each side of it.
VisibleNormal middle_normal(const SurfaceView& view, const Surface& surface);
std::array<VisibleNormal, 4> visible_normals(const SurfaceView& view, const Surface& surface);

// Writes the lobes that the normals reflect towards the eye, one lobe for each normal, to `lobes`. Their
// integrals sum to 1. Each lobe is weighted by the share of its normal and by the masking of the light.
void reflect(const SurfaceView& view, const Surface& surface, std::span<const VisibleNormal> normals,
             std::span<SphericalGaussian> lobes);

}  // namespace nook::probe
