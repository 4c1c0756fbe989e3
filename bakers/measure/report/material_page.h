// The page of a compressed material.
#pragma once

#include <cstddef>
#include <span>

#include "bakers/material/raw_material.h"
#include "bakers/measure/report/page.h"
#include "sdk/src/material/material.h"

namespace nook::report {

// bytes: the file. raw: what it was compressed from; null: it is not compared.
PageParts material_parts(std::span<const std::byte> bytes, const nook::material::Material& material,
                         const bake::material::RawMaterial* raw);

}  // namespace nook::report
