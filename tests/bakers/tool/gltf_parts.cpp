#include "tests/bakers/tool/gltf_parts.h"

#include <cstdint>
#include <cstring>
#include <fstream>

namespace {

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

void write_gltf_parts(const std::string& glb, const std::string& gltf, const std::string& buffer,
                      const std::string& uri, const nlohmann::json& more) {
  constexpr std::size_t head = 12, chunk_head = 8, json = head + chunk_head;
  const std::size_t json_bytes = word_at(glb, head);
  nlohmann::json document = nlohmann::json::parse(glb.substr(json, json_bytes));
  document["buffers"][0]["uri"] = uri;
  document.update(more);
  write(gltf, document.dump());
  write(buffer, glb.substr(json + json_bytes + chunk_head));
}
