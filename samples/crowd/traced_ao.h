// The ray-traced AO of bodies of a crowd that stands still, computed in the background.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "samples/crowd/hero.h"

namespace crowd {

class TracedAo {
 public:
  // Begins to trace the characters, in their order, against the whole crowd and the ground y = 0. The hero
  // must outlive this object.
  TracedAo(const Hero& hero, std::vector<Bones> poses, std::vector<std::uint32_t> characters);
  // Stops after the character that is being traced.
  ~TracedAo();
  TracedAo(const TracedAo&) = delete;
  TracedAo& operator=(const TracedAo&) = delete;

  // The AO of the characters that are done: one value for each vertex in the file's order.
  std::map<std::uint32_t, std::vector<float>> done() const;
  bool is_done() const;
  // The message of a failure, or an empty text.
  std::string failure() const;

 private:
  void trace(const Hero& hero, const std::vector<Bones>& poses);

  std::vector<std::uint32_t> characters_;
  std::atomic<bool> stop_{false};
  mutable std::mutex lock_;  // of the next two
  std::map<std::uint32_t, std::vector<float>> done_;
  std::string failure_;
  std::thread thread_;
};

}  // namespace crowd
