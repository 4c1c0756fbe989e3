// The identity of a bake of a material: how it is compressed, and the content of what it is made from.
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

// Every setting of a compression.
nlohmann::json settings_of(const material::CompressionSettings& settings);

// The settings and the inputs of a source that is traced.
nlohmann::json settings_of(const MesoSource& source);
nlohmann::json inputs_of(const MesoSource& source);

// Identifies the bake of bake_material for a descriptor's task.
BakeIdentity identify_material(const MaterialTask& task);

}  // namespace nook::bake
