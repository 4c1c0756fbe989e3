// Bakes radiance transfer for a mesh, and returns the bytes of a file and its report.
#pragma once

#include <nook/experimental/nook_bake_materials.h>
#include <string>
#include <vector>

#include "bakers/import/import_options.h"
#include "bakers/job/bake_identity.h"
#include "bakers/job/baked_file.h"
#include "bakers/transfer/paper_bake.h"

namespace nook::bake {

struct TransferTask {
  SurfaceMesh mesh;
  transfer::BakeSettings settings;
  // If set, bakes the paper's form for this material. Otherwise, bakes the separated form.
  std::shared_ptr<const nook::material::MaterialTables> material;
  transfer::PaperSettings paper;
  std::string source;                 // the name of the file, if there is one
  MeshSelection meshes;               // the meshes of the file that are baked
  std::string material_hash;          // SHA-256 of the material's file; empty without a material
  std::vector<std::string> warnings;  // warnings of the import
};

// Makes the mesh of a descriptor, and computes tangents if the descriptor has none. If there are errors,
// throws INVALID_ARGUMENT with the first one. Errors include those that transfer::check_bake finds.
TransferTask transfer_task_of(const nook_bake_transfer_desc& desc);

// Makes the tables of the material in the bytes of a .nook file. Throws what read_material throws.
std::shared_ptr<const nook::material::MaterialTables> tables_of_material(std::span<const std::byte> bytes);
// Makes the hole table of the material in the bytes of a .nook file. BakeSettings needs this table. Throws
// what read_material throws, and Failure(INVALID_ARGUMENT) if the material has no VOTF.
std::shared_ptr<const transfer::HoleTable> holes_of_material(std::span<const std::byte> bytes);

// Returns the identity of a call of bake_transfer_file.
BakeIdentity identify_transfer(const TransferTask& task);

// Progress first reports the stage JobStage::raytrace. This stage counts all vertices once for the direct
// light and once for each reflection. In the paper's form, the stage JobStage::fit follows and counts
// clusters. Throws Failure: INVALID_ARGUMENT, CANCELLED.
BakedFile bake_transfer_file(const TransferTask& task, const StageReport& progress);

}  // namespace nook::bake
