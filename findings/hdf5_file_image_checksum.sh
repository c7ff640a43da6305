#!/usr/bin/env bash
# A file of grasps or of distance grids that is made in memory (HDF5's core driver) and handed on as bytes (H5Fget_file_image) cannot be
# opened when it has the layout of HDF5 1.8 or later: the image is given a cleared status byte of the superblock, as documented, but keeps
# the checksum that the superblock had with the old one. In the earliest layout, whose superblock has no checksum, the same image is fine.
#
# Debian 12: libhdf5-103-1 and libhdf5-dev 1.10.8+repack1-1. Seen here: the image in the earliest layout opens; the one with
# H5Pset_libver_bounds(V18, V18) is refused by the library that wrote it and by h5py ("incorrect metadata checksum after all read
# attempts"), and opens once the checksum of its superblock (the last 4 of 48 bytes: Bob Jenkins' lookup3 of the 44 before) is put right.
set -euo pipefail

version=1.10.8+repack1-1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -qq "libhdf5-103-1=$version" "libhdf5-dev=$version" libaec0 libsz2 >/dev/null 2>&1
for package in ./*.deb; do dpkg-deb -x "$package" .; done
libraries=$(dirname "$(find . -name 'libhdf5_serial.so.103*' | head -1)")
headers=$(dirname "$(find . -name hdf5.h | grep serial | head -1)")

cat >image.c <<'C'
#include <hdf5.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t rot(uint32_t x, int k) { return (x << k) | (x >> (32 - k)); }

/* The checksum of HDF5's metadata: lookup3, hashlittle of 44 bytes = three blocks of 12 and a rest of 8. */
static uint32_t checksum(const unsigned char* key) {
  uint32_t w[11], a, b, c;
  memcpy(w, key, 44);
  a = b = c = 0xdeadbeef + 44u;
  for (int i = 0; i < 9; i += 3) {
    a += w[i], b += w[i + 1], c += w[i + 2];
    a -= c, a ^= rot(c, 4), c += b, b -= a, b ^= rot(a, 6), a += c, c -= b, c ^= rot(b, 8), b += a;
    a -= c, a ^= rot(c, 16), c += b, b -= a, b ^= rot(a, 19), a += c, c -= b, c ^= rot(b, 4), b += a;
  }
  a += w[9], b += w[10];
  c ^= b, c -= rot(b, 14), a ^= c, a -= rot(c, 11), b ^= a, b -= rot(a, 25), c ^= b, c -= rot(b, 16);
  a ^= c, a -= rot(c, 4), b ^= a, b -= rot(a, 14), c ^= b, c -= rot(b, 24);
  return c;
}

static int opens(const char* name, const void* image, size_t size) {
  FILE* const out = fopen(name, "wb");
  fwrite(image, 1, size, out);
  fclose(out);
  const hid_t file = H5Fopen(name, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file >= 0) H5Fclose(file);
  return file >= 0;
}

int main(void) {
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  for (int newer = 0; newer < 2; ++newer) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(access, 65536, 0);
    if (newer) H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    const hid_t file = H5Fcreate("memory.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
    H5Gclose(H5Gcreate2(file, "grasps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Fflush(file, H5F_SCOPE_GLOBAL);
    const size_t size = (size_t)H5Fget_file_image(file, NULL, 0);
    unsigned char* const image = malloc(size);
    H5Fget_file_image(file, image, size);
    printf("%s layout: %s\n", newer ? "1.8's" : "earliest", opens("image.h5", image, size) ? "opens" : "refused");
    if (newer) {
      const uint32_t right = checksum(image);
      memcpy(image + 44, &right, 4);
      printf("with the superblock's checksum put right: %s\n", opens("mended.h5", image, size) ? "opens" : "refused");
    }
    free(image);
    H5Fclose(file);
  }
  return 0;
}
C
cc -I"$headers" image.c -o image "$libraries"/libhdf5_serial.so.103 -Wl,-rpath-link,"$libraries" 2>/dev/null
LD_LIBRARY_PATH="$libraries" ./image >seen
echo "HDF5 $version"
cat seen
diff - seen <<'EXPECTED'
earliest layout: opens
1.8's layout: refused
with the superblock's checksum put right: opens
EXPECTED
