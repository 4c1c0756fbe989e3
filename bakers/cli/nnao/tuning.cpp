#include "cli/nnao/tuning.h"

#include <cmath>
#include <cstdio>
#include <deque>
#include <string>

#include "cli/nnao/peer_pass.h"
#include "core/failure.h"

namespace nook::cli {
namespace {

constexpr float radius_scales[] = {0.5f, 0.63f, 0.8f, 1.0f, 1.26f, 1.6f, 2.0f};
constexpr float powers[] = {0.5f, 0.63f, 0.8f, 1.0f, 1.26f, 1.6f, 2.0f, 2.5f};

std::vector<float> shapes_of(Peer peer) {
  switch (peer) {
    case Peer::ssao:
      return {};
    case Peer::ssao_plus:
      return {0.01f, 0.03f, 0.06f, 0.1f};
    case Peer::hbao:
      return {0.0f, 0.05f, 0.1f, 0.2f, 0.35f};
    case Peer::gtao:
      return {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 0.95f};
    default:
      return {0.1f, 0.2f, 0.35f, 0.6f, 1.0f, 1.6f};
  }
}

struct Search {
  const GladGLContext& gl;
  std::span<const MeasuredView> views;
  std::deque<GpuView> images;
  PeerPass pass;

  double mse(const PeerMethod& method) {
    double sum = 0, count = 0;
    for (std::size_t v = 0; v < views.size(); ++v) {
      AoRequest request;
      request.radius = views[v].radius;
      request.max_radius_px = 0.5f * float(images[v].height);
      const std::vector<float> ao =
          read_red(gl, pass.draw(method, images[v], request, true), images[v].width, images[v].height);
      for (std::size_t i = 0; i < ao.size(); ++i) {
        if (!std::isfinite(views[v].view.depth[i])) continue;
        const double error = double(ao[i]) - double(views[v].truth[i]);
        sum += error * error;
        count += 1;
      }
    }
    return sum / count;
  }

  // Whether another value of one parameter is better than the one in `best`.
  template <class Value>
  bool improve(TunedPeer& best, Value PeerTuning::*parameter, const std::vector<Value>& values) {
    bool better = false;
    for (const Value value : values) {
      PeerMethod tried = best.method;
      if (tried.tuning.*parameter == value) continue;
      tried.tuning.*parameter = value;
      const double tried_mse = mse(tried);
      if (!(tried_mse < best.mse)) continue;
      best = {tried, tried_mse};
      better = true;
    }
    return better;
  }
};

TunedPeer tune(Search& search, const PeerMethod& start) {
  TunedPeer best{start, search.mse(start)};
  constexpr int max_rounds = 4;
  for (int round = 0; round < max_rounds; ++round) {
    bool better = search.improve(best, &PeerTuning::power, {std::begin(powers), std::end(powers)});
    better |=
        search.improve(best, &PeerTuning::radius_scale, {std::begin(radius_scales), std::end(radius_scales)});
    better |= search.improve(best, &PeerTuning::shape, shapes_of(start.peer));
    if (start.peer == Peer::bitmask)
      better |= search.improve(best, &PeerTuning::equal_weights, std::vector<bool>{false, true});
    if (!better) break;
  }
  return best;
}

}  // namespace

std::vector<TunedPeer> tune_peers(platform::Context& context, std::span<const MeasuredView> views,
                                  const std::function<bool(std::size_t, std::size_t)>& progress) {
  const GladGLContext& gl = context.gl();
  Search search{gl,
                views,
                {},
                PeerPass(gl, int(views.front().view.camera.width), int(views.front().view.camera.height))};
  for (const MeasuredView& view : views) search.images.emplace_back(gl, view.view);
  std::vector<TunedPeer> tuned;
  for (const PeerMethod& method : peer_methods()) {
    tuned.push_back(tune(search, method));
    if (!progress(tuned.size(), peer_methods().size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while tuning");
  }
  return tuned;
}

std::string tuning_line(const PeerMethod& method) {
  constexpr const char* names[] = {"ssao", "ssao_plus", "hbao", "gtao", "bitmask"};
  char text[120];
  std::snprintf(text, sizeof text, "    {Peer::%s, %d, {%.2ff, %.2ff, %.2ff, %s}},\n",
                names[int(method.peer)], method.taps, double(method.tuning.radius_scale),
                double(method.tuning.power), double(method.tuning.shape),
                method.tuning.equal_weights ? "true" : "false");
  return text;
}

}  // namespace nook::cli
