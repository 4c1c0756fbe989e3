#include "bakers/job/nnao_training.h"

#include <nlohmann/json.hpp>

namespace nook::bake {

std::string network_recipe(const nnao::DatasetSettings& data, const nnao::TrainingSettings& t) {
  nlohmann::ordered_json recipe{{"form", t.form == nnao::NetworkForm::paper ? "paper" : "horizon"},
                                {"seed", t.seed},
                                {"scenes", data.scenes},
                                {"views", data.views},
                                {"points_per_view", data.points_per_view},
                                {"rays", data.rays},
                                {"epochs", t.epochs},
                                {"batch", t.batch},
                                {"rate", t.rate},
                                {"host_normal_share", data.host_normal_share}};
  if (t.form == nnao::NetworkForm::horizon) {
    recipe["unblurred_weight"] = t.unblurred_weight;
    recipe["dark_weight"] = t.dark_weight;
    recipe["bent_weight"] = t.bent_weight;
  }
  return recipe.dump();
}

SpecularTraining train_specular(const nnao::SpecularFitSettings& settings,
                                const nnao::DatasetProgress& progress) {
  const nook::nnao::Network network = nook::nnao::read_network(nook::nnao::default_network_file());
  const nnao::SpecularSamples samples = trace_specular_samples(network, settings, progress);
  const nook::nnao::SpecularNumbers numbers = fit_specular(samples.training, settings);
  return {specular_header(numbers, settings), specular_error(samples.validation, numbers),
          samples.training.size(), samples.validation.size()};
}

}  // namespace nook::bake
