// Makes a rigged tube and a rigged person, as the bytes of .glb files.
#pragma once

#include <string>
#include <vector>

// Two joints along x, 14 rings of 10 vertices; for each name a clip of one second that bends the second
// joint, each by another angle. With skin false the file has the mesh alone.
std::string glb_tube(const std::vector<std::string>& clips, bool skin = true);

// 19 joints with the names of a person's bones, each with an octahedron that it moves. Without clips.
std::string glb_person();
