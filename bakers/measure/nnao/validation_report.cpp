#include "bakers/measure/nnao/validation_report.h"

namespace nook::measure {

using namespace bake::nnao;
using Json = nlohmann::ordered_json;

Json validation_rows(const nook::nnao::Network& network, const Dataset& data) {
  // Enough for two digits of the error.
  const std::size_t stride = data.validation.size() / 20000 + 1;
  Json rows = Json::array();
  rows.push_back({{"method", "constant"},
                  {"taps", 0},
                  {"mse", constant_mse(data)},
                  {"mse_blurred", constant_mse(data)}});
  const bool paper = network.form == nook::nnao::NetworkForm::paper;
  const std::vector<std::uint32_t> counts = paper ? std::vector<std::uint32_t>{16, 32, 64, 128, 256, 961}
                                                  : std::vector<std::uint32_t>{9, 16, 32, 64, 128, 256};
  for (const std::uint32_t taps : counts) {
    const ValidationRow row = validate(network, data, taps, stride);
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

}  // namespace nook::measure
