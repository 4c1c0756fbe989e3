/* Writes files so that other programs never see an incomplete file. */
#ifndef WHOLE_FILE_H
#define WHOLE_FILE_H

#include <stddef.h>
#include <stdio.h>

/* A temporary file in the folder of the target. Its name is new, so that it never replaces a file of the
 * user. */
typedef struct WholeFile {
  FILE* stream;
  char path[1024], part[1064];
} WholeFile;

/* Write to file->stream afterwards. Returns 0 on failure. */
int whole_file_open(WholeFile* file, const char* path);
/* If `ok`, the file is renamed to the target, otherwise it is removed. Returns 0 if the target was not
 * written. */
int whole_file_close(WholeFile* file, int ok);

/* Writes all bytes of a file. Returns 0 on failure. */
int whole_file_write(const char* path, const void* bytes, size_t size);

#endif
