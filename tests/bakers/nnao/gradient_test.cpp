#include <array>
#include <cmath>
#include <numeric>

#include "bakers/nnao/forms.h"
#include "bakers/nnao/horizon_gradient.h"
#include "sdk/src/nnao/network_evaluate.h"
#include "tests/bakers/nnao/small_dataset.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::nnao;

namespace {

// Relative error of a gradient against central differences, in the square mean over the chosen parameters. A
// step of 1e-3 leaves about 1e-3 of rounding in float, and a kink of a PReLU within the step about as much.
template <class Loss>
double gradient_error(std::vector<float> parameters, const std::vector<float>& gradient,
                      const std::vector<std::size_t>& chosen, const Loss& loss) {
  constexpr float step = 1e-3f;
  double error = 0, size = 0;
  for (const std::size_t i : chosen) {
    const float kept = parameters[i];
    parameters[i] = kept + step;
    const double above = loss(parameters);
    parameters[i] = kept - step;
    const double below = loss(parameters);
    parameters[i] = kept;
    const double difference = (above - below) / (2 * double(step));
    error += (difference - double(gradient[i])) * (difference - double(gradient[i]));
    size += difference * difference;
  }
  return std::sqrt(error / size);
}

// A training starts with bent normals that are normals; gives their layer, which is the last one, other
// numbers.
void bend(TrainingState& state) {
  const std::size_t count = sizeof(HorizonNetwork::bent) / sizeof(float);
  for (std::size_t i = 0; i < count; ++i)
    state.parameter[state.parameter.size() - count + i] = 0.1f * std::sin(1.7f * float(i + 1));
}

std::vector<std::uint32_t> first_points(std::size_t count) {
  std::vector<std::uint32_t> points(count);
  std::iota(points.begin(), points.end(), 100u);
  return points;
}

}  // namespace

TEST_CASE("sixteen lanes agree with the reference") {
  const Dataset data = test::small_dataset();
  TrainingState state = start_training(data, {});
  bend(state);
  Network network;
  network.form = NetworkForm::horizon;
  export_horizon(state.parameter, network.horizon);
  for (const TapGrid grid : {TapGrid{3, 3}, TapGrid{8, 8}}) {
    HorizonBatch batch(grid);
    HorizonTrace trace(grid);
    for (int lane = 0; lane < lane_count; ++lane) {
      const DataPoint& point = data.training[std::size_t(lane) * 37];
      batch.set(lane, data.views[point.view].view(), point,
                nook::nnao::tap_noise_of_rank(std::uint32_t(lane) % NOOK_NOISE_COUNT));
    }
    HorizonOutput output;
    horizon_forward(state.parameter.data(), batch, trace, output);
    for (int lane = 0; lane < lane_count; ++lane) {
      const DataPoint& point = data.training[std::size_t(lane) * 37];
      const nook::nnao::Openness reference = nook::nnao::evaluate_openness(
          network, data.views[point.view].view(), point.normal,
          {point.radius, 1000, grid.directions * grid.steps}, point.x, point.y,
          nook::nnao::tap_noise_of_rank(std::uint32_t(lane) % NOOK_NOISE_COUNT));
      // The order of a few hundred sums differs.
      CHECK(std::abs(output.ao[lane] - reference.ao) < 1e-4f);
      const Vec3 bent{output.bent[0][lane], output.bent[1][lane], output.bent[2][lane]};
      CHECK(length(normalised(bent) - reference.bent_normal) < 1e-4f);
    }
  }
}

TEST_CASE("the gradient of the horizon form agrees with finite differences, in every parameter") {
  const Dataset data = test::small_dataset();
  TrainingState state = start_training(data, {});
  bend(state);
  const TapGrid grid{8, 4};
  HorizonBatch batch(grid);
  for (int lane = 0; lane < lane_count; ++lane) {
    const DataPoint& point = data.training[std::size_t(lane) * 61];
    batch.set(lane, data.views[point.view].view(), point,
              nook::nnao::tap_noise_of_rank(std::uint32_t(lane) % NOOK_NOISE_COUNT));
  }
  HorizonOutput weights;
  for (int lane = 0; lane < lane_count; ++lane) {
    weights.ao[lane] = 0.5f + 0.1f * float(lane);
    for (int i = 0; i < 3; ++i) weights.bent[i][lane] = 0.3f * float(i + 1) - 0.05f * float(lane);
  }
  const auto loss = [&](const std::vector<float>& parameters) {
    HorizonTrace trace(grid);
    HorizonOutput output;
    horizon_forward(parameters.data(), batch, trace, output);
    double sum = 0;
    for (int lane = 0; lane < lane_count; ++lane) {
      sum += double(weights.ao[lane]) * double(output.ao[lane]);
      for (int i = 0; i < 3; ++i) sum += double(weights.bent[i][lane]) * double(output.bent[i][lane]);
    }
    return sum;
  };
  HorizonTrace trace(grid);
  HorizonOutput output;
  horizon_forward(state.parameter.data(), batch, trace, output);
  LaneArray lanes = lane_array(state.parameter.size());
  horizon_backward(state.parameter.data(), batch, trace, weights, lanes.data());
  std::vector<float> gradient;
  for (const Lanes& g : lanes) {
    gradient.push_back(0);
    for (int lane = 0; lane < lane_count; ++lane) gradient.back() += g[lane];
  }
  std::vector<std::size_t> all(gradient.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  CHECK(gradient_error(state.parameter, gradient, all, loss) < 0.01);
}

TEST_CASE("the gradient of the pair loss agrees with finite differences") {
  const Dataset data = test::small_dataset();
  TrainingSettings settings;
  TrainingState state = start_training(data, settings);
  // AO between 0 and 1: where it is clamped the gradient is not the loss's, on purpose.
  for (float& parameter : state.parameter) parameter = std::abs(parameter);
  const std::size_t out = state.parameter.size() - sizeof(HorizonNetwork::bent) / sizeof(float) - 4;
  for (std::size_t i = out; i < out + 4; ++i)
    state.parameter[i] = -0.02f * std::max(state.parameter[i], 0.2f);
  bend(state);
  const std::vector<std::uint32_t> points = first_points(32);
  std::vector<float> gradient(state.parameter.size()), unused(state.parameter.size());
  horizon_step_gradient(data, settings, state.parameter, points, 7, gradient);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < gradient.size(); i += 7) chosen.push_back(i);
  const auto loss = [&](const std::vector<float>& parameters) {
    return horizon_step_gradient(data, settings, parameters, points, 7, unused);
  };
  CHECK(gradient_error(state.parameter, gradient, chosen, loss) < 0.02);
}

TEST_CASE("the gradient of the paper's cost agrees with finite differences") {
  const Dataset data = test::small_dataset();
  TrainingSettings settings;
  settings.form = NetworkForm::paper;
  const TrainingState state = start_training(data, settings);
  const PaperNormalisation normalisation = paper_normalisation(data);
  const std::vector<std::uint32_t> points = first_points(16);
  std::vector<float> gradient(state.parameter.size()), unused(state.parameter.size());
  // With dropout: the seed fixes what is dropped.
  paper_step_gradient(data, normalisation, settings, state.parameter, points, 3, gradient);
  const auto loss = [&](const std::vector<float>& parameters) {
    return paper_step_gradient(data, normalisation, settings, parameters, points, 3, unused);
  };
  std::vector<std::size_t> small_layers, some_filters;
  for (std::size_t i = 31 * 31 * 4 * 4; i < gradient.size(); ++i) small_layers.push_back(i);
  for (std::size_t i = 1500; i < 31 * 31 * 4 * 4; i += 211) some_filters.push_back(i);
  CHECK(gradient_error(state.parameter, gradient, small_layers, loss) < 0.02);
  CHECK(gradient_error(state.parameter, gradient, some_filters, loss) < 0.02);
}

TEST_CASE("folding the normalisation into the filters changes no output") {
  const Dataset data = test::small_dataset();
  TrainingSettings settings;
  settings.form = NetworkForm::paper;
  settings.dropout = 0;
  settings.gamma = 0;
  const TrainingState state = start_training(data, settings);
  const PaperNormalisation normalisation = paper_normalisation(data);
  Network network;
  network.form = NetworkForm::paper;
  export_paper(state.parameter, normalisation, network.paper);
  std::vector<float> unused(state.parameter.size());
  for (std::uint32_t p = 5; p < 400; p += 40) {
    const DataPoint& point = data.training[p];
    const std::array<std::uint32_t, 1> one{p};
    const double loss = paper_step_gradient(data, normalisation, settings, state.parameter, one, 1, unused);
    const double folded =
        double(nook::nnao::evaluate_unclamped(network, data.views[point.view].view(), point.normal,
                                              {point.radius, 1000, 961}, point.x, point.y, {}));
    // Sums of 3,844 floats, in another order.
    CHECK(std::abs(std::sqrt(loss) - std::abs(folded - double(point.ao))) < 1e-3);
  }
}
