/* Files that appear whole or not at all. */
#ifndef WHOLE_FILE_H
#define WHOLE_FILE_H

#include <stddef.h>
#include <stdio.h>

/* A file beside its place. Its name is new, so that no file of the user's is lost. */
typedef struct WholeFile {
  FILE* stream;
  char path[1024], part[1064];
} WholeFile;

/* Write to file->stream afterwards. Returns 0 on failure. */
int whole_file_open(WholeFile* file, const char* path);
/* With ok the file takes its place, and is removed otherwise. Returns 0 if it is not in its place. */
int whole_file_close(WholeFile* file, int ok);

/* Writes all bytes of a file. Returns 0 on failure. */
int whole_file_write(const char* path, const void* bytes, size_t size);

#endif
