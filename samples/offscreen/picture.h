/* Writes PNG files. */
#ifndef PICTURE_H
#define PICTURE_H

/* Writes width x height pixels of three bytes, the lowest row first, as glReadPixels returns them. The file
 * is written beside its target and then renamed. Returns 0 on failure. */
int picture_write(const char* path, const unsigned char* rgb, int width, int height);

#endif
