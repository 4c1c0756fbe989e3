#include "samples/offscreen/whole_file.h"

int whole_file_open(WholeFile* file, const char* path) {
  file->stream = NULL;
  if (snprintf(file->path, sizeof file->path, "%s", path) >= (int)sizeof file->path) return 0;
  for (int i = 0; !file->stream && i < 100; ++i) {
    snprintf(file->part, sizeof file->part, "%s.nook-part-sample-%d", file->path, i);
    file->stream = fopen(file->part, "wbx"); /* fails if a file with this name exists */
  }
  return file->stream != NULL;
}

int whole_file_close(WholeFile* file, int ok) {
  if (!file->stream) return 0;
  ok = fclose(file->stream) == 0 && ok;
  file->stream = NULL;
  if (ok && rename(file->part, file->path) == 0) return 1;
  remove(file->part);
  return 0;
}

int whole_file_write(const char* path, const void* bytes, size_t size) {
  WholeFile file;
  return whole_file_open(&file, path) && whole_file_close(&file, fwrite(bytes, 1, size, file.stream) == size);
}
