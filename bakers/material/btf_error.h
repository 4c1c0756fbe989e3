// The error of a compressed material against the raw one.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/material/neural_tile.h"
#include "bakers/material/raw_material.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/material/material.h"
#include "sdk/src/material/neural_tables.h"

namespace nook::bake::material {

// Returns 10 log10(||A||^2 / ||A - A^||^2).
double signal_to_error_db(double squared_signal, double squared_error);

// Decodes the BTF of one view, 3 lights x texels (x slow, y fast), or the VOTF's values of one view.
tensor::Matrix decode_btf_view(const std::vector<float>& light_basis,
                               const nook::material::ClusteredTensor& btf, std::size_t view);
std::vector<float> decode_votf_view(const nook::material::ClusteredTensor& votf, std::size_t view);

// Decodes the BTF of a material as the view sees it on its relief, or as its network draws it.
tensor::Matrix decode_btf_view(const nook::material::Material& material, std::size_t view);

// Returns the radiance that a neural material's network gives the texels of a view, for each light: 3 lights
// x texels.
tensor::Matrix draw_neural(const nook::material::NeuralTables& tables, Vec3 view,
                           std::span<const Vec3> lights);

// Returns the value on a screen, from 0 to 1: the root of y / (1 + y), where y is pi times the radiance. y is
// 1 for a white matt plane that faces its light (E. Reinhard and others: Photographic Tone Reproduction,
// 2002).
float toned(float radiance);

struct BtfError {
  double squared_signal = 0, squared_error = 0;
  double peak = 0;  // the raw BTF's greatest value
  std::size_t values = 0;
  double squared_error_toned = 0;  // after toned()
  double se_db() const { return signal_to_error_db(squared_signal, squared_error); }
  double psnr_db() const;
  double psnr_toned_db() const;  // the peak is 1
};
// Adds the error of the decoded values; there must be as many as true ones.
void add_error(std::span<const float> truth, const float* decoded, BtfError& error);
BtfError sum_of_errors(std::span<const BtfError> parts);
// Throws Failure(INVALID_ARGUMENT) if the sizes differ from the raw material's.
BtfError measure_btf(const RawMaterial& raw, const std::vector<float>& light_basis,
                     const nook::material::ClusteredTensor& btf);

// Measures a neural material in the views and lights of the raw one, whichever they are.
BtfError measure_btf(const RawMaterial& raw, const nook::material::Material& material);

BtfError measure_neural_tile(const RawMaterial& raw, const NeuralTile& tile);

// Counts texels, summed over views, whose decoded mask (binary > 0.5 or distance > 0) differs from the raw
// one.
std::size_t count_error_texels(const RawMaterial& raw, const nook::material::ClusteredTensor& votf,
                               nook::material::VisibilityForm form);

}  // namespace nook::bake::material
