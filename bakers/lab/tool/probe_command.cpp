// nook-lab evaluate probe: the same command as in nook, but with every way to fit a probe. It also compares
// the glossy light with prefiltered cube maps.
#include "bakers/lab/probe/glossy_error.h"
#include "bakers/lab/probe/probe_methods.h"
#include "bakers/lab/probe/texel_error.h"
#include "bakers/lab/tool/lab_commands.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/peers.h"

namespace nook::lab {
namespace {

using Json = nlohmann::ordered_json;

class Peers : public tool::ProbePeers {
 public:
  void add_options(tool::Command command) override {
    const tool::Option glossy =
        command.add_flag("--glossy", glossy_,
                         "for maps: instead of comparing ways to fit a probe, compare the light of its lobes "
                         "with prefiltered cube maps, on random glossy surfaces");
    command
        .add_option("--surfaces", surfaces_.surfaces,
                    "with --glossy: number of random surfaces to measure for each kind of surface")
        .check(tool::in_range(1u, 1u << 20))
        .capture_default_str();
    command
        .add_flag("--texels", texels_,
                  "for maps: measure over all texels with the same weight, with the samples and normals of "
                  "Probulator, instead of comparing methods of fitting by solid angle")
        .excludes(glossy);
  }

  std::vector<bake::probe::ProbeMethod> methods(std::uint32_t lobes,
                                                const bake::probe::Region& region) const override {
    return probe_methods(lobes, region);
  }

  Json rows_of_map(const bake::Environment& map, const std::string& name, std::uint32_t lobes,
                   std::uint64_t seed, platform::ProgressBar& bar) const override {
    if (texels_) return texel_rows(map, name, lobes);
    if (!glossy_) return {};
    GlossySettings settings = surfaces_;
    settings.lobes = lobes;
    settings.seed = seed;
    return glossy_rows(map, name, settings, [&](std::size_t done, std::size_t total) {
      bar.show(name + ", glossy", "kinds of surface", done, total);
      return !tool::interrupted();
    });
  }

 private:
  bool glossy_ = false, texels_ = false;
  GlossySettings surfaces_;
};

}  // namespace

void add_evaluate_probe(tool::Command evaluate) {
  tool::add_evaluate_probe(evaluate, std::make_shared<Peers>());
}

}  // namespace nook::lab
