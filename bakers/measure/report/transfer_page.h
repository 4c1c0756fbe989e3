// The page of baked radiance transfer.
#pragma once

#include "bakers/import/surface_mesh.h"
#include "bakers/measure/report/page.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::report {

// mesh: what it was baked from. Throws Failure(BAD_FILE) for another one.
PageParts transfer_parts(std::size_t bytes, const transfer::Transfer& transfer,
                         const bake::SurfaceMesh& mesh);

}  // namespace nook::report
