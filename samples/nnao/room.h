/* The scene: the corner of a room with stairs, columns, crates, a table and balls. Metres, y up. */
#ifndef ROOM_H
#define ROOM_H

/* Position, normal, albedo. */
typedef struct room_vertex {
  float position[3], normal[3], albedo[3];
} room_vertex;

/* Triangles, three vertices each; *count vertices. The caller frees them. NULL: out of memory. */
room_vertex* room_make(int* count);

#endif
