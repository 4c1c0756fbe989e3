#include "bakers/tool/plan/memory.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string_view>

#include "bakers/raytrace/instruction_set.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "platform/input_file.h"
#include "sdk/src/core/container.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/version.h"

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

constexpr int memory_version = 1;
constexpr std::int64_t step_of_time_ns = 20'000'000;

std::int64_t ns_of(const timespec& time) {
  return std::int64_t(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

Json json_of(const Stamp& stamp) {
  return Json::array({stamp.bytes, stamp.modified_ns, stamp.changed_ns});
}

Stamp stamp_in(const Json& json) {
  return {json.at(0).get<std::int64_t>(), json.at(1).get<std::int64_t>(), json.at(2).get<std::int64_t>()};
}

Json json_of(const KnownBake& bake) {
  Json read = Json::array();
  for (const StampedFile& file : bake.read)
    read.push_back({{"path", file.path}, {"stamp", json_of(file.stamp)}});
  return {{"words", bake.words}, {"read", read}, {"identity", bake.identity}};
}

KnownBake bake_in(const Json& json) {
  KnownBake bake{json.at("words").get<Words>(), {}, json.at("identity").get<std::string>()};
  for (const Json& file : json.at("read"))
    bake.read.push_back({file.at("path").get<std::string>(), stamp_in(file.at("stamp"))});
  return bake;
}

Memory memory_in(const Json& json) {
  Memory memory;
  for (const auto& item : json.at("bakes").items()) memory.bakes[item.key()] = bake_in(item.value());
  for (const auto& item : json.at("outputs").items())
    memory.outputs[item.key()] = {stamp_in(item.value().at("stamp")),
                                  item.value().at("identity").get<std::string>()};
  return memory;
}

}  // namespace

Stamp stamp_of(const fs::path& path) {
  struct stat there;
  if (stat(path.c_str(), &there) != 0) return {};
  return {std::int64_t(there.st_size), ns_of(there.st_mtim), ns_of(there.st_ctim)};
}

Memory read_memory(const fs::path& file, const std::string& tool) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  try {
    const std::vector<std::byte> bytes = read_any_file(file);
    const char* const text = reinterpret_cast<const char*>(bytes.data());
    const Json json = Json::parse(text, text + bytes.size());
    if (json.at("version") != memory_version || json.at("tool") != tool) return {};
    return memory_in(json);
  } catch (const Json::exception&) {
    return {};  // the plan then reads everything again
  } catch (const ToolError&) {
    return {};
  }
}

std::string memory_text(const Memory& memory, const std::string& tool) {
  Json bakes = Json::object(), outputs = Json::object();
  for (const auto& [output, bake] : memory.bakes) bakes[output] = json_of(bake);
  for (const auto& [output, known] : memory.outputs)
    outputs[output] = {{"stamp", json_of(known.stamp)}, {"identity", known.identity}};
  const Json json = {{"version", memory_version}, {"tool", tool}, {"bakes", bakes}, {"outputs", outputs}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string this_tool() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const Stamp stamp = stamp_of(program);
  // Identifies the program by its size and modification time. The time of the last status change is not used,
  // because it changes with every new hard link to the program.
  return std::string(version_text) + " " + bake::embree_version() + " " + bake::isa_level_name() + " " +
         program.string() + " " + std::to_string(stamp.bytes) + " " + std::to_string(stamp.modified_ns);
}

bool is_unchanged(const std::vector<StampedFile>& files) {
  return std::all_of(files.begin(), files.end(), [](const StampedFile& file) {
    return file.stamp.bytes >= 0 && stamp_of(file.path) == file.stamp;
  });
}

bool is_too_young(const std::vector<StampedFile>& files, std::int64_t began_ns) {
  return std::any_of(files.begin(), files.end(), [&](const StampedFile& file) {
    return std::max(file.stamp.modified_ns, file.stamp.changed_ns) > began_ns - step_of_time_ns;
  });
}

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return ns_of(now);
}

std::string identity_in(const fs::path& output) {
  try {
    const std::vector<std::byte> bytes = read_file(output);
    // Every kind of baked file stores its recipe in the same section.
    const Container file(bytes, {container_kind(bytes), "baked file", 0, UINT32_MAX});
    ByteReader recipe = file.section("RECP");
    const auto stored = bake::stored_identity(recipe.text(recipe.remaining()));
    return stored ? stored->text : "";
  } catch (const Failure&) {
    return "";
  } catch (const ToolError&) {
    return "";
  }
}

}  // namespace nook::tool::plan
