#include "bakers/job/nnao_training.h"

namespace nook::bake {

using Json = nlohmann::ordered_json;

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

Json validation_rows(const nook::nnao::Network& network, const nnao::Dataset& data) {
  // About 20,000 points are enough to determine the error to two digits.
  const std::size_t stride = data.validation.size() / 20000 + 1;
  Json rows = Json::array();
  rows.push_back({{"method", "constant"},
                  {"taps", 0},
                  {"mse", nnao::constant_mse(data)},
                  {"mse_blurred", nnao::constant_mse(data)}});
  const bool paper = network.form == nook::nnao::NetworkForm::paper;
  const std::vector<std::uint32_t> counts = paper ? std::vector<std::uint32_t>{16, 32, 64, 128, 256, 961}
                                                  : std::vector<std::uint32_t>{9, 16, 32, 64, 128, 256};
  for (const std::uint32_t taps : counts) {
    const nnao::ValidationRow row = nnao::validate(network, data, taps, stride);
    rows.push_back({{"method", paper ? "paper" : "horizon"},
                    {"taps", taps},
                    {"mse", row.mse},
                    {"mse_blurred", row.mse_blurred},
                    {"dark_bias", row.dark_bias},
                    {"bent_angle", row.bent_angle},
                    {"normal_angle", row.normal_angle}});
  }
  return rows;
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
