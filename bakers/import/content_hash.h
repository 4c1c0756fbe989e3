// Hashes the imported data that a bake uses: geometry, skin, skeleton and clips. Two files with the same data
// have the same hash. It does not matter whether they are .glb or .gltf. Textures, materials, generators and
// node names do not change the hash.
#pragma once

#include <bit>
#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bakers/import/gltf.h"
#include "bakers/import/sha256.h"
#include "bakers/import/static_scene.h"
#include "bakers/import/surface_mesh.h"

namespace nook::bake {

// Hashes numbers by their bits (little-endian). A list is hashed together with its length, so that no two
// sequences of values give the same bytes.
class ContentHash {
 public:
  template <class Number>
  requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) void add(Number value) {
    static_assert(std::endian::native == std::endian::little);
    hash_.add(std::as_bytes(std::span(&value, 1)));
  }
  void add(std::string_view text) {
    add(std::uint64_t(text.size()));
    hash_.add(std::as_bytes(std::span(text)));
  }
  // The element type must not have padding. Use numbers, or arrays of numbers of one type.
  template <class Element>
  void add_list(std::span<const Element> list) {
    static_assert(std::is_trivially_copyable_v<Element>);
    add(std::uint64_t(list.size()));
    hash_.add(std::as_bytes(list));
  }
  template <class Element>
  void add_list(const std::vector<Element>& list) {
    add_list(std::span<const Element>(list));
  }
  std::string hex() { return hash_.hex(); }

 private:
  Sha256 hash_;
};

// Returns 64 hexadecimal digits.
std::string content_hash(const ImportedCharacter& character);
std::string content_hash(const SurfaceMesh& mesh);
std::string content_hash(const StaticScene& scene);

// Returns the first 64 bits of a hash.
std::uint64_t short_hash(const std::string& hex);

}  // namespace nook::bake
