// Makes the identity of a material bake from the compression settings and the content of the source.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/job/bake_identity.h"
#include "bakers/job/material_bake.h"
#include "bakers/material/pbr_maps.h"

namespace nook::bake {

std::string content_hash(const material::RawMaterial& raw);
std::string content_hash(const material::MesoSurface& surface);
std::string content_hash(const material::PbrMaps& maps);

// Returns all compression settings.
nlohmann::json settings_of(const material::CompressionSettings& settings);

// Return the settings and the inputs of a source that will be ray traced.
nlohmann::json settings_of(const MesoSource& source);
nlohmann::json inputs_of(const MesoSource& source);

// Returns the identity of a call of bake_material for a descriptor's task.
BakeIdentity identify_material(const MaterialTask& task);

}  // namespace nook::bake
