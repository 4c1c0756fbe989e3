#include "bakers/import/gltf_clips.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "bakers/import/accessor.h"
#include "bakers/import/node_tree.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr std::size_t max_key_floats =
    std::size_t{1} << 26;  // for all clips together; limits the memory for malicious files

std::optional<ChannelPath> path_of(const std::string& text) {
  if (text == "translation") return ChannelPath::translation;
  if (text == "rotation") return ChannelPath::rotation;
  if (text == "scale") return ChannelPath::scale;
  return std::nullopt;
}

Interpolation interpolation_of(const std::string& text, const std::string& what) {
  if (text.empty() || text == "LINEAR") return Interpolation::linear;
  if (text == "STEP") return Interpolation::step;
  if (text == "CUBICSPLINE") return Interpolation::cubic_spline;
  throw Failure(NOOK_ERROR_BAD_FILE, "%s has the interpolation \"%s\" (need LINEAR, STEP or CUBICSPLINE)",
                what.c_str(), text.c_str());
}

// Counts the errors in keys that can be repaired in only one sensible way, over all channels.
struct KeyRepairs {
  std::size_t equal_times = 0, not_unit = 0, twice = 0;
};

// The length of a rotation stored in bytes may be off by 2 %. With floats, it is only off by rounding.
bool has_not_unit_rotation(const Channel& channel) {
  if (channel.path != ChannelPath::rotation) return false;
  const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
  for (std::size_t k = is_cubic ? 1 : 0; 4 * k + 3 < channel.value.size(); k += is_cubic ? 3 : 1) {
    double square = 0;
    for (std::size_t i = 0; i < 4; ++i)
      square += double(channel.value[4 * k + i]) * double(channel.value[4 * k + i]);
    if (!(std::abs(square - 1) < 0.05)) return true;
  }
  return false;
}

void look_at_keys(const Channel& channel, KeyRepairs& repairs) {
  if (std::adjacent_find(channel.time_s.begin(), channel.time_s.end()) != channel.time_s.end())
    ++repairs.equal_times;
  if (has_not_unit_rotation(channel)) ++repairs.not_unit;
}

void add_warnings(const KeyRepairs& repairs, std::vector<std::string>& warnings) {
  const auto warn = [&](std::size_t count, const char* what) {
    if (count > 0) warnings.push_back(std::to_string(count) + what);
  };
  warn(repairs.equal_times,
       " animation channels have several keys at the same time; the last key of each time is used");
  warn(repairs.not_unit,
       " animation channels have rotations that are not unit quaternions; they were normalised");
  warn(repairs.twice,
       " animation channels move the same value as another channel of their clip; the last one is used");
}

// `left` is the number of floats that max_key_floats still allows. Subtracts the floats of this channel.
Channel read_channel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                     const tinygltf::AnimationChannel& source, ChannelPath path, const std::string& what,
                     std::size_t& left) {
  if (source.sampler < 0 || static_cast<std::size_t>(source.sampler) >= animation.samplers.size())
    throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to sampler %d, but the animation has only %zu",
                  what.c_str(), source.sampler, animation.samplers.size());
  const tinygltf::AnimationSampler& sampler = animation.samplers[source.sampler];
  Channel channel;
  channel.node = static_cast<std::uint32_t>(source.target_node);
  channel.path = path;
  channel.interpolation = interpolation_of(sampler.interpolation, what);
  const std::size_t keys = element_count(model, sampler.input, what + " input");
  const std::size_t values = element_count(model, sampler.output, what + " output");
  const auto components = static_cast<std::size_t>(channel.components());
  if (keys > left || values > (left - keys) / components)
    throw Failure(NOOK_ERROR_BAD_FILE, "too many animation keys (need at most %zu numbers)", max_key_floats);
  left -= keys + components * values;
  channel.time_s = read_floats(model, sampler.input, 1, what + " input").value;
  Floats output = read_floats(model, sampler.output, channel.components(), what + " output");
  const std::size_t per_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
  if (channel.time_s.empty() || output.count != per_key * channel.time_s.size())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has %zu values for %zu keys (need %zu per key, and at least one key)", what.c_str(),
                  output.count, channel.time_s.size(), per_key);
  channel.value = std::move(output.value);
  const auto is_finite = [](float v) { return std::isfinite(v); };
  if (!std::all_of(channel.time_s.begin(), channel.time_s.end(), is_finite) ||
      !std::all_of(channel.value.begin(), channel.value.end(), is_finite))
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has a key that is not finite", what.c_str());
  if (!std::is_sorted(channel.time_s.begin(), channel.time_s.end()))
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has key times that decrease", what.c_str());
  return channel;
}

// Shifts the keys so that the clip's first key is at 0.
void settle_times(Clip& clip) {
  float first = clip.channels[0].time_s.front();
  float last = clip.channels[0].time_s.back();
  for (const Channel& channel : clip.channels) {
    first = std::min(first, channel.time_s.front());
    last = std::max(last, channel.time_s.back());
  }
  clip.start_s = first;
  clip.duration_s = last - first;
  if (!std::isfinite(clip.duration_s))
    throw Failure(NOOK_ERROR_BAD_FILE, "clip \"%s\" lasts longer than a float can represent",
                  clip.name.c_str());
  for (Channel& channel : clip.channels)
    for (float& t : channel.time_s) t -= first;
}

}  // namespace

std::vector<Clip> read_clips(const tinygltf::Model& model, const NodeTree& nodes,
                             std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  for (const tinygltf::Animation& animation : model.animations) names.push_back(animation.name);
  names = unique_names(names, "clip");

  std::vector<Clip> clips;
  std::size_t left = max_key_floats;
  std::size_t morph_channels = 0;
  KeyRepairs repairs;
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    const tinygltf::Animation& animation = model.animations[a];
    Clip clip;
    clip.name = names[a];
    std::set<std::pair<int, ChannelPath>> moved;
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      const tinygltf::AnimationChannel& source = animation.channels[c];
      const std::string what = "clip \"" + clip.name + "\" channel " + std::to_string(c);
      const std::optional<ChannelPath> path = path_of(source.target_path);
      // A channel without a node is legal and does nothing.
      if (!path || source.target_node < 0) {
        ++morph_channels;
        continue;
      }
      if (static_cast<std::size_t>(source.target_node) >= nodes.size())
        throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to node %d, but the file has only %zu", what.c_str(),
                      source.target_node, nodes.size());
      if (nodes.nodes[source.target_node].matrix)
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "%s animates node %d, which has a matrix (need translation, rotation, scale)",
                      what.c_str(), source.target_node);
      clip.channels.push_back(read_channel(model, animation, source, *path, what, left));
      look_at_keys(clip.channels.back(), repairs);
      if (!moved.insert({source.target_node, *path}).second) ++repairs.twice;
    }
    if (clip.channels.empty()) {
      warnings.push_back("clip \"" + clip.name + "\" moves no node and was left out");
      continue;
    }
    settle_times(clip);
    clips.push_back(std::move(clip));
  }
  add_warnings(repairs, warnings);
  if (morph_channels > 0)
    warnings.push_back(std::to_string(morph_channels) +
                       " animation channels move no node (morph targets) and were left out");
  return clips;
}

}  // namespace nook::bake
