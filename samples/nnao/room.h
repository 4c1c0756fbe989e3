/* The scene is the corner of a room with stairs, columns, crates, a table and balls. Metres, y up. */
#ifndef ROOM_H
#define ROOM_H

typedef struct room_vertex {
  float position[3], normal[3], albedo[3];
} room_vertex;

/* Makes triangles with three vertices each, *count vertices in all. The caller frees them. Returns NULL if
 * memory runs out. */
room_vertex* room_make(int* count);

/* Writes the view matrix of a camera that looks from above the room's open corner to its middle.
 * Column-major. */
void room_view(float view[16]);

#endif
