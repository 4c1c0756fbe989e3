/* Makes a room of 6 x 3 x 5 metres with a window in the wall at +x, a table, a shelf and four spheres. y is
 * up, and the origin is the middle of the floor. */
#ifndef RELIGHT_ROOM_H
#define RELIGHT_ROOM_H

/* `reflectance` is the mirror reflectance at normal incidence; 0 is matt. */
typedef struct room_vertex {
  float position[3], normal[3], albedo[3], roughness, reflectance;
} room_vertex;

/* Makes triangles with three vertices each, *count vertices in all. The caller frees them. Returns NULL if
 * memory runs out. */
room_vertex* room_make(int* count);

#endif
