#include "samples/offscreen/picture.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "samples/offscreen/whole_file.h"

static uint32_t crc_of(const unsigned char* bytes, size_t count) {
  uint32_t crc = 0xffffffffU;
  for (size_t i = 0; i < count; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320U : 0);
  }
  return ~crc;
}

static unsigned char* put_32(unsigned char* out, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) *out++ = (unsigned char)(value >> shift);
  return out;
}

/* Writes a chunk of `size` bytes, which start at chunk + 8. It adds length and name before them, and the
 * checksum after them. */
static int write_chunk(FILE* file, unsigned char* chunk, const char* name, size_t size) {
  put_32(chunk, (uint32_t)size);
  memcpy(chunk + 4, name, 4);
  put_32(chunk + 8 + size, crc_of(chunk + 4, size + 4));
  return fwrite(chunk, 1, size + 12, file) == size + 12;
}

/* Makes a zlib stream of stored blocks. This is larger than a compressed stream, but needs no library. */
static size_t store(unsigned char* out, const unsigned char* bytes, size_t count) {
  unsigned char* const begin = out;
  uint32_t a = 1, b = 0;
  *out++ = 0x78;
  *out++ = 0x01;
  for (size_t done = 0; done < count;) {
    const size_t block = count - done < 65535 ? count - done : 65535;
    *out++ = done + block == count;
    *out++ = (unsigned char)block;
    *out++ = (unsigned char)(block >> 8);
    *out++ = (unsigned char)~block;
    *out++ = (unsigned char)(~block >> 8);
    memcpy(out, bytes + done, block);
    out += block;
    done += block;
  }
  for (size_t i = 0; i < count; ++i) {
    a = (a + bytes[i]) % 65521;
    b = (b + a) % 65521;
  }
  return (size_t)(put_32(out, b << 16 | a) - begin);
}

static int write_png(FILE* file, const unsigned char* rgb, int width, int height) {
  static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  const size_t row = (size_t)width * 3, raw = (row + 1) * (size_t)height;
  unsigned char header[25] = {0}, end[12];
  unsigned char* const rows = malloc(raw);
  unsigned char* const chunk = malloc(raw + raw / 65535 * 5 + 64);
  int ok = rows && chunk;
  put_32(put_32(header + 8, (uint32_t)width), (uint32_t)height);
  header[16] = 8; /* bits a channel */
  header[17] = 2; /* RGB */
  for (int y = 0; ok && y < height; ++y) {
    rows[(row + 1) * (size_t)y] = 0; /* no filter */
    memcpy(rows + (row + 1) * (size_t)y + 1, rgb + row * (size_t)(height - 1 - y), row);
  }
  ok = ok && fwrite(signature, 1, sizeof signature, file) == sizeof signature;
  ok = ok && write_chunk(file, header, "IHDR", 13);
  ok = ok && write_chunk(file, chunk, "IDAT", store(chunk + 8, rows, raw));
  ok = ok && write_chunk(file, end, "IEND", 0);
  free(rows);
  free(chunk);
  return ok;
}

int picture_write(const char* path, const unsigned char* rgb, int width, int height) {
  WholeFile file;
  return whole_file_open(&file, path) && whole_file_close(&file, write_png(file.stream, rgb, width, height));
}
