// Measures the error of a compressed material against the raw one.
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

// Decodes one view of the BTF, 3 lights x texels (x slow, y fast), or the VOTF's values in one view.
tensor::Matrix decode_btf_view(const std::vector<float>& light_basis,
                               const nook::material::ClusteredTensor& btf, std::size_t view);
std::vector<float> decode_votf_view(const nook::material::ClusteredTensor& votf, std::size_t view);

// Decodes one view of a material's BTF as it is drawn, on the relief or by the network.
tensor::Matrix decode_btf_view(const nook::material::Material& material, std::size_t view);

// Returns the radiance that the network of a neural material gives for the texels in a view, for each light:
// 3 lights x texels.
tensor::Matrix draw_neural(const nook::material::NeuralTables& tables, Vec3 view,
                           std::span<const Vec3> lights);

// Returns a tone-mapped display value from 0 to 1: the square root of y / (1 + y), where y is pi times the
// radiance. For a white matt plane that faces the light, y is 1 (E. Reinhard and others: Photographic Tone
// Reproduction, 2002).
float toned(float radiance);

struct BtfError {
  double squared_signal = 0, squared_error = 0;
  double peak = 0;  // largest value of the raw BTF
  std::size_t values = 0;
  double squared_error_toned = 0;  // of values after toned()
  double se_db() const { return signal_to_error_db(squared_signal, squared_error); }
  double psnr_db() const;
  double psnr_toned_db() const;  // the peak is 1
};
// Adds the error of the decoded values. There must be as many decoded values as true values.
void add_error(std::span<const float> truth, const float* decoded, BtfError& error);
BtfError sum_of_errors(std::span<const BtfError> parts);
// Throws Failure(INVALID_ARGUMENT) if the sizes differ from the raw material's.
BtfError measure_btf(const RawMaterial& raw, const std::vector<float>& light_basis,
                     const nook::material::ClusteredTensor& btf);

// Measures a neural material in the views and lights of the raw material. These may be any views and lights.
BtfError measure_btf(const RawMaterial& raw, const nook::material::Material& material);

BtfError measure_neural_tile(const RawMaterial& raw, const NeuralTile& tile);

// Counts the texels for which the decoded mask (binary > 0.5 or distance > 0) differs from the raw mask,
// summed over views.
std::size_t count_error_texels(const RawMaterial& raw, const nook::material::ClusteredTensor& votf,
                               nook::material::VisibilityForm form);

}  // namespace nook::bake::material
