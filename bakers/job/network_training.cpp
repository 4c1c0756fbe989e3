#include "bakers/job/network_training.h"

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

}  // namespace nook::bake
