// Writes small glTF files into memory, so that each test describes its file.
#pragma once

#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace nook::test {

using Json = nlohmann::json;

class GltfBuilder {
 public:
  Json document = {{"asset", {{"version", "2.0"}}},
                   {"scene", 0},
                   {"scenes", Json::array({{{"nodes", Json::array({0})}}})}};

  Json room;  // a second buffer; null: none

  // One buffer view and one accessor of any component type; returns the accessor's index.
  template <typename T>
  int add(const std::vector<T>& values, const char* type, int component_type, bool normalised = false) {
    const std::size_t components = type == std::string("SCALAR") ? 1
                                   : type == std::string("VEC2") ? 2
                                   : type == std::string("VEC3") ? 3
                                   : type == std::string("VEC4") ? 4
                                                                 : 16;
    document["accessors"].push_back({{"bufferView", add_view(values)},
                                     {"componentType", component_type},
                                     {"count", values.size() / components},
                                     {"type", type},
                                     {"normalized", normalised}});
    return static_cast<int>(document["accessors"].size()) - 1;
  }
  int add_floats(const std::vector<float>& values, const char* type) { return add(values, type, 5126); }

  template <typename T>
  int add_view(const std::vector<T>& values) {
    while (buffer_.size() % 4 != 0) buffer_.push_back(0);
    const std::size_t offset = buffer_.size();
    buffer_.resize(offset + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(buffer_.data() + offset, values.data(), values.size() * sizeof(T));
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
    return static_cast<int>(document["bufferViews"].size()) - 1;
  }

  // A channel of the last animation.
  void add_channel(int node, const char* path, const std::vector<float>& times_s,
                   const std::vector<float>& values, const char* interpolation = "LINEAR") {
    Json& animation = document["animations"].back();
    const int input = add_floats(times_s, "SCALAR");
    const int output = add_floats(values, path == std::string("rotation") ? "VEC4" : "VEC3");
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }
  void add_animation(const std::string& name) {
    Json animation = {{"samplers", Json::array()}, {"channels", Json::array()}};
    if (!name.empty()) animation["name"] = name;
    document["animations"].push_back(animation);
  }

  std::vector<std::byte> glb() const {
    std::string json = with_buffer("").dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::vector<unsigned char> data = buffer_;
    data.resize((data.size() + 3) / 4 * 4);
    std::vector<std::byte> out;
    const auto word = [&](std::size_t value) {
      for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::byte>(value >> shift & 255));
    };
    word(0x46546c67);
    word(2);
    word(12 + 8 + json.size() + 8 + data.size());
    word(json.size());
    word(0x4e4f534a);
    for (const char c : json) out.push_back(static_cast<std::byte>(c));
    word(data.size());
    word(0x004e4942);
    for (const unsigned char c : data) out.push_back(static_cast<std::byte>(c));
    return out;
  }

  // As text, the buffer in a data URI or in the file that `uri` names.
  std::vector<std::byte> gltf(const std::string& uri = "") const {
    return bytes_of(
        with_buffer(uri.empty() ? "data:application/octet-stream;base64," + base64() : uri).dump());
  }
  const std::vector<unsigned char>& buffer() const { return buffer_; }

  static std::vector<std::byte> bytes_of(const std::string& text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
  }

 private:
  Json with_buffer(const std::string& uri) const {
    Json out = document;
    Json buffer = {{"byteLength", buffer_.size()}};
    if (!uri.empty()) buffer["uri"] = uri;
    if (!buffer_.empty()) out["buffers"] = Json::array({buffer});
    if (!room.is_null()) out["buffers"].push_back(room);
    return out;
  }

  std::string base64() const {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < buffer_.size(); i += 3) {
      const auto at = [&](std::size_t k) { return k < buffer_.size() ? buffer_[k] : 0u; };
      const unsigned bits = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
      for (int digit = 0; digit < 4; ++digit)
        out += i + digit > buffer_.size() ? '=' : digits[bits >> (18 - 6 * digit) & 63];
    }
    return out;
  }

  std::vector<unsigned char> buffer_;
};

}  // namespace nook::test
