// C++17 wrappers of functions for debug views: nook_debug.h.
#ifndef NOOK_DEBUG_HPP
#define NOOK_DEBUG_HPP

#include <cstdint>
#include <vector>

#include "../nook_character.hpp"
#include "nook_debug.h"

namespace nook {
inline namespace wrapper {

inline nook_scene_instance_info instance_info(const Scene& scene, nook_instance_id id) {
  nook_scene_instance_info info{};
  info.struct_size = sizeof info;
  check(nook_scene_describe_instance(scene.get(), id, &info));
  return info;
}

// `terms` is a sum of NOOK_TERM_ values.
inline void set_terms(Scene& scene, std::uint32_t terms) {
  check(nook_scene_set_terms(scene.get(), terms));
}

namespace detail {

// Calls a read function twice: the first call gets the count, the second call fills the elements.
template <class Element>
std::vector<Element> read_all(nook_result (*read)(nook_scene, nook_instance_id, Element*, std::uint32_t*),
                              const Scene& scene, nook_instance_id id) {
  std::uint32_t count = 0;
  check(read(scene.get(), id, nullptr, &count));
  std::vector<Element> elements(count);
  check(read(scene.get(), id, elements.data(), &count));
  return elements;
}

}  // namespace detail

// Returns the proxy spheres of an instance in its pose.
inline std::vector<nook_scene_sphere> posed_spheres(const Scene& scene, nook_instance_id id) {
  return detail::read_all(nook_scene_read_spheres, scene, id);
}

// Returns the key points of an instance in its pose.
inline std::vector<nook_scene_key_point> posed_key_points(const Scene& scene, nook_instance_id id) {
  return detail::read_all(nook_scene_read_key_points, scene, id);
}

// Returns the instances that darken an instance by links.
inline std::vector<nook_instance_id> linked_casters(const Scene& scene, nook_instance_id id) {
  return detail::read_all(nook_scene_read_links, scene, id);
}

}  // namespace wrapper
}  // namespace nook
#endif
