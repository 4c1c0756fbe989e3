#include "bakers/job/transfer_bake.h"
#include <nook/experimental/nook_bake_materials.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "bakers/character/mesh_choice.h"
#include "bakers/import/content_hash.h"
#include "bakers/import/surface_mesh.h"
#include "platform/peak_memory.h"
#include "platform/stopwatch.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/transfer/transfer_file.h"

namespace nook::bake {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Vec3> directions_of(const float* xyz, std::size_t count) {
  std::vector<Vec3> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
  return out;
}

std::string hash_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

// Returns a hash of the hole table, for the identity. The file stores only holes.votf_hash, the hash of the
// VOTF that the table is made from.
std::string hash_of_holes(const transfer::HoleTable& holes) {
  ContentHash hash;
  hash.add(holes.votf_hash);
  hash.add_list(holes.cover);
  return hash.hex();
}

double mean_share(const nook::transfer::Transfer& transfer) {
  double sum = 0;
  for (const std::uint8_t share : transfer.shares) sum += share;
  return sum / (255.0 * double(transfer.shares.size()));
}

}  // namespace

std::shared_ptr<const nook::material::MaterialTables> tables_of_material(std::span<const std::byte> bytes) {
  return std::make_shared<const nook::material::MaterialTables>(
      nook::material::make_tables(nook::material::read_material(bytes), {}, default_memory()));
}

std::shared_ptr<const transfer::HoleTable> holes_of_material(std::span<const std::byte> bytes) {
  return std::make_shared<const transfer::HoleTable>(transfer::make_hole_table(*tables_of_material(bytes)));
}

TransferTask transfer_task_of(const nook_bake_transfer_desc& desc) {
  need(desc.positions, "desc.positions");
  need(desc.normals, "desc.normals");
  need(desc.uvs, "desc.uvs");
  need(desc.indices, "desc.indices");
  if (desc.index_count % 3)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.index_count is not a multiple of 3 (got %u)",
                  desc.index_count);
  TransferTask task;
  task.settings.lobes = desc.lobes;
  task.settings.side = desc.ray_side;
  task.settings.bounces = desc.bounces;
  task.settings.tiles = desc.tiles;
  SurfaceMesh& mesh = task.mesh;
  const std::size_t count = desc.vertex_count;
  mesh.position = directions_of(desc.positions, count);
  mesh.normal = directions_of(desc.normals, count);
  mesh.uv.resize(count);
  for (std::size_t v = 0; v < count; ++v) mesh.uv[v] = {desc.uvs[2 * v], desc.uvs[2 * v + 1]};
  for (std::size_t i = 0; i < desc.index_count; i += 3)
    mesh.triangle.push_back({desc.indices[i], desc.indices[i + 1], desc.indices[i + 2]});
  mesh.tangent.assign(count, {{1, 0, 0}, 1});
  if (desc.tangents) {
    for (std::size_t v = 0; v < count; ++v) {
      const float* const t = desc.tangents + 4 * v;
      if (!(t[3] == 1 || t[3] == -1))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "the tangent of vertex %zu has a handedness that is neither 1 nor -1 (got %g)", v,
                      double(t[3]));
      mesh.tangent[v] = {{t[0], t[1], t[2]}, t[3]};
    }
    transfer::check_bake(mesh, task.settings);
  } else {
    transfer::check_bake(mesh, task.settings);
    mesh.tangent = surface_tangents(mesh, task.warnings);
  }
  if (desc.form != NOOK_FORM_DEFAULT && desc.form != NOOK_FORM_PAPER)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.form is unknown (got %d); use a NOOK_FORM_ constant",
                  int(desc.form));
  if ((desc.form == NOOK_FORM_PAPER) != (desc.material != nullptr))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        desc.material
            ? "desc.material is given, but desc.form is NOOK_FORM_DEFAULT; set desc.form to NOOK_FORM_PAPER"
            : "desc.material is NULL, but NOOK_FORM_PAPER needs the file of a material");
  if (desc.material) {
    task.material = tables_of_material({static_cast<const std::byte*>(desc.material), desc.material_size});
    task.material_hash = sha256(std::span(static_cast<const std::byte*>(desc.material), desc.material_size));
    task.paper.clusters = desc.clusters;
    transfer::check_paper_bake(mesh, task.paper);
  }
  if (desc.votf)
    task.settings.holes = holes_of_material({static_cast<const std::byte*>(desc.votf), desc.votf_size});
  return task;
}

BakeIdentity identify_transfer(const TransferTask& task) {
  const transfer::BakeSettings& s = task.settings;
  nlohmann::json settings = {{"form", task.material ? "paper" : "separated"},
                             {"lobes", s.lobes},
                             {"ray_side", s.side},
                             {"bounces", s.bounces}};
  nlohmann::json inputs = {{"shape", content_hash(task.mesh)}};
  if (s.holes) {
    settings["tiles"] = s.tiles;
    inputs["votf"] = hash_of_holes(*s.holes);
  }
  if (task.material) {
    const transfer::PaperSettings& paper = task.paper;
    settings["paper"] = {{"clusters", paper.clusters},
                         {"lobe_rank", paper.lobe_rank},
                         {"vertex_rank", paper.vertex_rank},
                         {"common_rank", paper.common_rank},
                         {"iterations", paper.iterations},
                         {"nearest", paper.nearest},
                         {"seed", paper.seed}};
    inputs["material"] = task.material_hash;
  }
  return identify_bake(BakeKind::transfer, settings, inputs);
}

BakedFile bake_transfer_file(const TransferTask& task, const StageReport& progress) {
  platform::Stopwatch watch;
  const auto stage = [&](JobStage at) {
    return [&progress, at](std::size_t done, std::size_t total) { return progress(at, done, total); };
  };
  const JobStage tracing = JobStage::raytrace;
  nook::transfer::Transfer transfer =
      task.material ? transfer::bake_paper(task.mesh, task.settings, task.paper, *task.material,
                                           stage(tracing), stage(JobStage::fit))
                    : transfer::bake_transfer(task.mesh, task.settings, stage(tracing));
  const double seconds = watch.seconds();
  const char* const form = task.material ? "paper" : "separated";
  Json recipe;
  if (!task.source.empty()) recipe["source"] = task.source;
  store_meshes(recipe, task.meshes);
  recipe["form"] = form;
  recipe["bounces"] = task.settings.bounces;
  recipe["rays"] = 6 * task.settings.side * task.settings.side;
  if (task.settings.holes) {
    recipe["votf"] = hash_text(task.settings.holes->votf_hash);
    recipe["tiles"] = task.settings.tiles;
  }
  store_identity(recipe, identify_transfer(task));
  transfer.recipe = recipe.dump(-1, ' ', false, Json::error_handler_t::replace).c_str();
  BakedFile file;
  file.model = nook::transfer::write_transfer(transfer);
  Json report;
  report["form"] = form;
  report["vertices"] = transfer.vertex_count();
  report["triangles"] = task.mesh.triangle.size();
  report["lobes"] = transfer.lobes;
  report["bounces"] = transfer.bounces;
  report["rays"] = recipe["rays"];
  report["file_bytes"] = file.model.size();
  report["indirect_bytes"] = sizeof(std::uint16_t) * transfer.indirect.size();
  report["votf"] = recipe.contains("votf") ? recipe["votf"] : Json();
  report["mean_share"] = task.material ? Json() : Json(mean_share(transfer));
  report["light_modes"] = task.material ? Json(transfer.paper.light_modes) : Json();
  report["clusters"] = task.material ? Json(transfer.paper.clusters) : Json();
  report["paper_bytes"] =
      task.material ? Json(nook::transfer::paper_bytes(transfer.vertex_count(), transfer.paper.clusters,
                                                       transfer.lobes, transfer.paper.light_modes,
                                                       transfer.paper.lobe_rank, transfer.paper.vertex_rank))
                    : Json();
  report["seconds"] = seconds;
  report["peak_bytes"] = platform::peak_bytes();
  report["warnings"] = task.warnings;
  file.report = report.dump(2, ' ', false, Json::error_handler_t::replace);
  return file;
}

}  // namespace nook::bake
