// A .glb file as a .gltf file and its buffer.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

// Writes the JSON of the bytes of a .glb file to `gltf`, and its buffer to `buffer`. The JSON names the
// buffer by `uri`; the members of `more` are added, or replace the members of the file.
void write_gltf_parts(const std::string& glb, const std::string& gltf, const std::string& buffer,
                      const std::string& uri, const nlohmann::json& more = nlohmann::json::object());
