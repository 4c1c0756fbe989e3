// The evaluations of commands.h, extended by methods outside Nook. nook-lab adds the methods of bakers/lab.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/measure/character/character_report.h"
#include "bakers/measure/material/material_report.h"
#include "bakers/measure/probe/method_error.h"
#include "platform/progress_bar.h"

namespace nook::tool {

class Command;

void add_evaluate_character(Command evaluate, std::span<const measure::CharacterPeer> peers);

// The data that `evaluate material` has read and measured before other methods run.
struct MaterialEvaluation {
  const bake::material::RawMaterial& raw;
  measure::MaterialFile file;
  const bake::material::RawMaterial* unseen;  // null: none
  bool jumps;
  std::uint64_t seed;
  bake::material::CompressionSettings settings;  // settings of the file
  std::filesystem::path images;                  // empty: none
  measure::MethodProgress progress;
  // Adds a material to the pictures of --images.
  std::function<void(const std::string& name, const nook::material::Material& material,
                     const bake::material::MethodRow& row)>
      draw;
};

class MaterialPeers {
 public:
  virtual ~MaterialPeers() = default;
  virtual void add_options(Command command) = 0;
  // Throws Failure if the methods cannot be fitted to this file. Called before anything is measured.
  virtual void check(const nook::material::Material& material) const = 0;
  // Adds the rows and keys of the methods to the report.
  virtual void measure(const MaterialEvaluation& evaluation, nlohmann::ordered_json& report) const = 0;
};

void add_evaluate_material(Command evaluate, std::shared_ptr<MaterialPeers> peers);

class ProbePeers {
 public:
  virtual ~ProbePeers() = default;
  virtual void add_options(Command command) = 0;
  // Returns the ways to fit a probe. They are measured in place of Nook's own list.
  virtual std::vector<bake::probe::ProbeMethod> methods(std::uint32_t lobes,
                                                        const bake::probe::Region& region) const = 0;
  // Returns rows for a map, which replace the rows of the methods. Returns null if the options request no
  // such rows.
  virtual nlohmann::ordered_json rows_of_map(const bake::Environment& map, const std::string& name,
                                             std::uint32_t lobes, std::uint64_t seed,
                                             platform::ProgressBar& bar) const = 0;
};

void add_evaluate_probe(Command evaluate, std::shared_ptr<ProbePeers> peers);

}  // namespace nook::tool
