// Compares the light vectors at the vertices with exact sums over 6,144 directions, for baked transfer and
// for simpler forms.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bakers/import/surface_mesh.h"
#include "bakers/raytrace/environment.h"
#include "bakers/transfer/surface_holes.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/lobe_fit.h"
#include "sdk/src/transfer/response.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::measure {

// Forms of the per-vertex vectors, best first.
enum class TransferForm {
  baked = 0,  // baked transfer as the runtime computes it, in the separated form or in the paper's form
  ao = 1,     // the vectors of an unoccluded vertex, times the vertex's ambient occlusion
  none = 2,   // the vectors of an unoccluded vertex
};
inline constexpr std::array<const char*, 3> transfer_form_names{"separated", "ao", "none"};
inline constexpr const char* paper_form_name = "paper";

// A light, in every representation that the measurements need.
struct MeasuredLight {
  std::string name;
  bake::Environment map;    // the reference of the pictures samples this map
  std::vector<Vec3> cells;  // the mean of the map over each of the 6,144 cells of the reference
  std::vector<float> amplitudes;
  nook::transfer::FitQuality quality;
  double fit_ms = 0;
};
// If without_suns is true, first removes the suns of the map (bakers/raytrace/environment.h).
MeasuredLight measured_light(std::string name, bake::Environment map, const nook::transfer::LobeFit& fit,
                             bool without_suns = false);

// Returns whether the transfer was baked from this mesh.
bool is_baked_mesh(const bake::SurfaceMesh& mesh, const nook::transfer::Transfer& transfer);

// The vectors of all vertices under one light. Each vector has 3 x light_modes values.
struct LightVectors {
  std::array<std::vector<float>, 3> form;  // indexed by TransferForm
  double vectors_ms = 0;                   // computing time of the separated form on one thread
  // Signal-to-error ratio, dB.
  std::array<double, 3> se_db{};
  // The same ratio for the separated form, with direct sums in place of the integrals of the response. It is
  // not set for the paper's form.
  double se_exact_db = 0;
};

// Called from worker threads, one call at a time. Return false to stop.
using VectorProgress = std::function<bool(std::size_t done, std::size_t total)>;

// The parts of light transport that the reference includes.
struct TruthSettings {
  std::uint32_t bounces = 0;  // number of reflections of the shape onto itself; used only by pictures
  const bake::transfer::HoleTable* holes = nullptr;  // holes of the material; null: none
  float tiles = 1;  // tiles of the material in one unit of texture coordinates
};

struct VectorMeasure {
  std::vector<LightVectors> lights;
  std::vector<float> ao;  // per vertex, cosine-weighted visibility
  std::uint32_t light_modes = 0;
};
// Traces the visibility of each vertex again, and fits the lights to the lobes of the transfer. The vectors
// of the separated form include reflected light if the file contains it. Their dB values only measure the
// direct light. Throws Failure(CANCELLED) if `progress` returns false.
VectorMeasure measure_vectors(const bake::SurfaceMesh& mesh, const nook::transfer::Transfer& transfer,
                              const nook::material::MaterialTables& tables,
                              std::span<const MeasuredLight> lights, const TruthSettings& settings,
                              const VectorProgress& progress);

// Returns the response of a material to light from the directions of the lobes.
nook::transfer::Response response_of(const nook::material::MaterialTables& tables, std::uint32_t lobes);

}  // namespace nook::measure
