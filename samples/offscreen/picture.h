/* Writes PNG files. */
#ifndef PICTURE_H
#define PICTURE_H

/* rgb: width x height pixels of three bytes, the lowest row first, as glReadPixels gives them. The file is
 * written beside its target and renamed. 0: failed. */
int picture_write(const char* path, const unsigned char* rgb, int width, int height);

#endif
