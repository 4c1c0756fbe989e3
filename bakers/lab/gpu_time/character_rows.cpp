#include "bakers/lab/gpu_time/crowd.h"
#include "bakers/lab/gpu_time/timed_rows.h"

namespace nook::lab {

using namespace measure;

namespace {

constexpr float spacing = 1.4f;  // metres
constexpr std::uint32_t neighbours = 4;

// Creates a nook_gl of the given tier on an existing context.
class Tier {
 public:
  Tier(platform::Context& context, nook_context made_by, nook_gl_tier tier) {
    nook_gl_desc desc;
    succeed(nook_gl_desc_init(&desc));
    desc.get_proc = platform::Context::loader;
    desc.get_proc_user = &context;
    desc.max_tier = tier;
    succeed(nook_gl_create(made_by, &desc, &gl_));
  }
  ~Tier() { nook_gl_destroy(&gl_); }
  Tier(const Tier&) = delete;
  Tier& operator=(const Tier&) = delete;

  nook_gl get() const { return gl_; }

 private:
  nook_gl gl_ = nullptr;
};

}  // namespace

std::vector<TimedRow> time_characters(const Timing& timing, const std::filesystem::path& model) {
  std::vector<TimedRow> rows;
  for (const nook_gl_tier tier : {NOOK_GL_TIER_43, NOOK_GL_TIER_33}) {
    const Tier made(timing.context, timing.nook.context(), tier);
    for (const std::uint32_t count : {1u, 100u, 1000u})
      for (const std::uint32_t k : {0u, neighbours}) {
        const std::string name = std::to_string(count) + (count == 1 ? " character" : " characters") + ", " +
                                 std::to_string(k) + " neighbours, tier " + std::to_string(tier);
        if ((count == 1 && k > 0) || !timing.wanted(name)) continue;
        Crowd crowd(timing.nook, model, count, spacing);
        timing.add(
            rows, name, [&] { succeed(nook_gl_scene_update(made.get(), crowd.scene())); },
            [&] { crowd.pose(k); });
        succeed(nook_gl_scene_release(made.get(), crowd.scene()));
      }
  }
  return rows;
}

}  // namespace nook::lab
