#include <algorithm>
#include <cmath>
#include <set>

#include "core/failure.h"
#include "import/accessor.h"
#include "import/gltf_parts.h"

namespace nook::bake {
namespace {

template <std::size_t N>
void copy_numbers(const std::vector<double>& from, std::array<double, N>& to, const std::string& node, const char* what) {
  if (from.empty()) return;
  if (from.size() != N)
    throw Failure(NOOK_ERROR_BAD_FILE, "node \"%s\": %s has %zu numbers, need %zu", node.c_str(), what, from.size(), N);
  for (std::size_t i = 0; i < N; ++i) {
    if (!std::isfinite(from[i]))
      throw Failure(NOOK_ERROR_BAD_FILE, "node \"%s\": %s is not finite", node.c_str(), what);
    to[i] = from[i];
  }
}

std::string unique_name(std::string name, std::set<std::string>& taken) {
  const std::string base = name;
  for (int n = 1; !taken.insert(name).second; ++n) name = base + "_" + std::to_string(n);
  return name;
}

}  // namespace

NodeTree read_nodes(const tinygltf::Model& model) {
  NodeTree tree;
  tree.nodes.resize(model.nodes.size());
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Node& from = model.nodes[n];
    Node& to = tree.nodes[n];
    to.name = from.name.empty() ? "node_" + std::to_string(n) : from.name;
    if (!from.matrix.empty()) {
      std::array<double, 16> columns{};
      copy_numbers(from.matrix, columns, to.name, "matrix");
      to.matrix = from_columns(columns.data());
    }
    copy_numbers(from.translation, to.local.translation, to.name, "translation");
    copy_numbers(from.rotation, to.local.rotation, to.name, "rotation");
    copy_numbers(from.scale, to.local.scale, to.name, "scale");
    double norm = 0;
    for (double q : to.local.rotation) norm += q * q;
    if (norm < 1e-12) throw Failure(NOOK_ERROR_BAD_FILE, "node \"%s\": rotation is a zero quaternion", to.name.c_str());
    for (double& q : to.local.rotation) q /= std::sqrt(norm);
    for (int child : from.children) {
      if (child < 0 || std::size_t(child) >= model.nodes.size())
        throw Failure(NOOK_ERROR_BAD_FILE, "node \"%s\": child %d does not exist (file has %zu nodes)", to.name.c_str(),
                      child, model.nodes.size());
      if (tree.nodes[std::size_t(child)].parent >= 0)
        throw Failure(NOOK_ERROR_BAD_FILE, "node %d has two parents", child);
      tree.nodes[std::size_t(child)].parent = std::int32_t(n);
    }
  }
  sort_parents_first(tree);
  return tree;
}

std::vector<Clip> read_clips(const tinygltf::Model& model, std::vector<std::string>& warnings) {
  std::vector<Clip> clips;
  std::set<std::string> taken;
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    const tinygltf::Animation& animation = model.animations[a];
    Clip clip;
    clip.name = unique_name(animation.name.empty() ? "clip_" + std::to_string(a) : animation.name, taken);
    float first = INFINITY, last = -INFINITY;
    for (const tinygltf::AnimationChannel& source : animation.channels) {
      const std::string what = "clip \"" + clip.name + "\"";
      Channel channel;
      if (source.target_path == "rotation") channel.path = ChannelPath::rotation;
      else if (source.target_path == "scale") channel.path = ChannelPath::scale;
      else if (source.target_path != "translation") continue;  // morph weights
      if (source.target_node < 0 || std::size_t(source.target_node) >= model.nodes.size()) {
        warnings.push_back(what + ": a channel without a node is left out");
        continue;
      }
      channel.node = std::uint32_t(source.target_node);
      if (source.sampler < 0 || std::size_t(source.sampler) >= animation.samplers.size())
        throw Failure(NOOK_ERROR_BAD_FILE, "%s: sampler %d does not exist", what.c_str(), source.sampler);
      const tinygltf::AnimationSampler& sampler = animation.samplers[std::size_t(source.sampler)];
      if (sampler.interpolation == "STEP") channel.interpolation = Interpolation::step;
      if (sampler.interpolation == "CUBICSPLINE") channel.interpolation = Interpolation::cubic_spline;
      channel.time_s = read_floats(model, sampler.input, 1, what + " times").value;
      channel.value = read_floats(model, sampler.output, channel.components(), what + " values").value;
      const std::size_t per_key =
          std::size_t(channel.components()) * (channel.interpolation == Interpolation::cubic_spline ? 3 : 1);
      if (channel.time_s.empty() || channel.value.size() != channel.time_s.size() * per_key)
        throw Failure(NOOK_ERROR_BAD_FILE, "%s: %zu times need %zu numbers, got %zu", what.c_str(), channel.time_s.size(),
                      channel.time_s.size() * per_key, channel.value.size());
      for (std::size_t k = 0; k < channel.time_s.size(); ++k)
        if (!std::isfinite(channel.time_s[k]) || (k > 0 && channel.time_s[k] < channel.time_s[k - 1]))
          throw Failure(NOOK_ERROR_BAD_FILE, "%s: key times must be finite and ascending (key %zu)", what.c_str(), k);
      for (float v : channel.value)
        if (!std::isfinite(v)) throw Failure(NOOK_ERROR_BAD_FILE, "%s: a key value is not finite", what.c_str());
      first = std::min(first, channel.time_s.front());
      last = std::max(last, channel.time_s.back());
      clip.channels.push_back(std::move(channel));
    }
    if (!clip.channels.empty()) {
      clip.start_s = first;
      clip.duration_s = last - first;
      for (Channel& channel : clip.channels)
        for (float& t : channel.time_s) t -= first;
    }
    clips.push_back(std::move(clip));
  }
  return clips;
}

}  // namespace nook::bake
