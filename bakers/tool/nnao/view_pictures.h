// The pictures of `nook evaluate nnao --images`: sheets of each view by method, and the networks' filters and
// units.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "bakers/measure/nnao/comparison.h"
#include "bakers/measure/nnao/scene_views.h"
#include "bakers/tool/nnao/networks.h"

namespace nook::tool {

// Returns true where a sheet has a column for the method.
bool is_shown(const std::string& method, int taps);

// Writes PNG files into the folder, which exists.
void write_sheets(const std::filesystem::path& folder, std::span<const measure::MeasuredView> views,
                  std::span<const measure::KeptImage> images);
void write_network_pictures(const std::filesystem::path& folder, const Networks& networks,
                            std::span<const measure::MeasuredView> views);

}  // namespace nook::tool
