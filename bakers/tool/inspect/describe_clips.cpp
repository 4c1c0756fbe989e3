#include <string>

#include "bakers/tool/inspect/describe.h"
#include "sdk/src/character/clip_set.h"

namespace nook::tool {

Row describe_clips(std::span<const std::byte> bytes) {
  const ClipSet set = read_clip_set(bytes);
  const Container container(bytes, clip_kind);
  Row row;
  row["kind"] = "clips";
  row["format_version"] = container.version();
  row["bytes"] = bytes.size();
  row["clips"] = set.clips.size();
  row["frames"] = set.frame_count;
  row["vertices"] = set.ao.rows;
  row["bones"] = set.bones.size();
  row["modes"] = set.ao.modes;
  row["pose_modes"] = set.pose.modes;
  row["bytes_per_frame_vertex"] = double(bytes.size()) / (double(set.frame_count) * double(set.ao.rows));
  for (const char* name : {"HEAD", "NAME", "AO  ", "BONE", "POSE", "RECP"}) {
    const char letters[5] = {name[0], name[1], name[2], name[3], 0};
    std::string key = "bytes_";
    for (const char* c = name; *c && *c != ' '; ++c) key += *c;
    row[key] = container.section(letters).remaining();
  }
  Row names = Row::array();
  for (const ClipRange& clip : set.clips) names.push_back(std::string(clip.name));
  row["clip_names"] = std::move(names);
  add_recipe(row, set.recipe);
  return row;
}

}  // namespace nook::tool
