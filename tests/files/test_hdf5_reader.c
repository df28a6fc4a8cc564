/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reader of HDF5 files beside HDF5, which wrote them: the same numbers of every shape, in whatever chunks, groups
 * of thousands of names, headers in many pieces, other types; and what it does not read is refused by name. Files that
 * were made to harm: words of one in turn set to what a word may be, under a checksum that is right. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <fcntl.h>
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files/h5/checksum_trailer.h"
#include "files/h5/hdf5_reader.h"
#include "files/h5/result_reader.h"
#include "graingas.h"
#include "planted.h"

static char folder[] = "/tmp/graingas-reader-XXXXXX";

static int enter(void **state)
{
  (void)state;
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
  (void)state;
  unlink("f.h5");
  return chdir("/") == 0 ? rmdir(folder) : -1;
}

static hid_t create(void)
{
  return H5Fcreate("f.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
}

static void seal(void)
{
  unsigned char seal[GG_TRAILER_SIZE];
  int fd = open("f.h5", O_RDWR | O_APPEND);
  assert_int_equal(gg_files_checksum_trailer_of_file(fd, seal), 0);
  assert_int_equal(write(fd, seal, sizeof seal), GG_TRAILER_SIZE);
  close(fd);
}

static void close_and_seal(hid_t file)
{
  H5Fclose(file);
  seal();
}

/* An array of so many dimensions whose elements are counted up; chunk NULL: in one piece. */
static void put_filtered(hid_t file, const char *name, hid_t type, int rank, const hsize_t *dims, const hsize_t *chunk,
                         const char *filters)
{
  double x[10000];
  hsize_t n = 1;
  for (int a = 0; a < rank; a++) n *= dims[a];
  for (hsize_t i = 0; i < n; i++) x[i] = (double)i;
  hsize_t most[3] = {H5S_UNLIMITED, dims[rank > 1], dims[rank > 2 ? 2 : 0]};
  hid_t space = H5Screate_simple(rank, dims, chunk ? most : NULL), how = H5Pcreate(H5P_DATASET_CREATE);
  if (chunk) H5Pset_chunk(how, rank, chunk);
  for (; *filters; filters++) {
    if (*filters == 'g') H5Pset_deflate(how, 6);
    if (*filters == 's') H5Pset_shuffle(how);
    if (*filters == 'f') H5Pset_fletcher32(how);
  }
  hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT);
  assert_true(set >= 0 && H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x) >= 0);
  H5Dclose(set);
  H5Pclose(how);
  H5Sclose(space);
}

static void put(hid_t file, const char *name, hid_t type, int rank, const hsize_t *dims, const hsize_t *chunk)
{
  put_filtered(file, name, type, rank, dims, chunk, "");
}

static void check(gg_h5_in *in, const char *name, size_t n)
{
  size_t count;
  double *x = gg_h5_read_array(in, name, GG_ITEM_F64, &count);
  assert_string_equal(in->why, "");
  assert_int_equal(count, n);
  for (size_t i = 0; i < n; i++) assert_true(x[i] == (double)i);
  free(x);
}

/* Chunks that do and do not divide the array, of one element and of all of it; whole, and row by row. */
static void chunked_arrays_are_read_whole_and_by_rows(void **state)
{
  (void)state;
  static const struct {
    int rank;
    hsize_t dims[3], chunk[3];
  } cases[] = {{1, {100}, {7}},
               {1, {5}, {1024}},
               {1, {3000}, {1}},
               {2, {13, 7}, {1, 3}},
               {2, {13, 7}, {4, 7}},
               {2, {9, 5}, {2, 2}},
               {3, {6, 50, 3}, {1, 50, 3}},
               {3, {6, 50, 3}, {1, 17, 3}},
               {3, {5, 4, 3}, {3, 3, 2}}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    const int rank = cases[k].rank;
    size_t row = 1;
    hid_t file = create();
    put(file, "x", H5T_NATIVE_DOUBLE, rank, cases[k].dims, cases[k].chunk);
    close_and_seal(file);
    for (int a = 1; a < rank; a++) row *= cases[k].dims[a];
    gg_h5_in in;
    gg_h5_open(&in, "f.h5", false);
    assert_non_null(in.whole);
    check(&in, "/x", row * cases[k].dims[0]);
    for (size_t i = 0; i < cases[k].dims[0]; i++) {
      double *one = gg_h5_read_row(&in, "/x", i, GG_ITEM_F64, row);
      assert_non_null(one);
      for (size_t j = 0; j < row; j++) assert_true(one[j] == (double)(i * row + j));
      free(one);
    }
    assert_null(gg_h5_read_row(&in, "/x", cases[k].dims[0], GG_ITEM_F64, row));
    gg_h5_in_close(&in);
  }
}

/* Arrays that other programs compress are read whole and by rows; filters in either order, and chunks that gzip cannot
 * shrink. */
static void arrays_of_other_programs_are_decompressed(void **state)
{
  (void)state;
  static const char *const all[] = {"g", "s", "f", "sg", "gs", "sgf", "fsg"};
  const hsize_t dims[] = {20, 50, 3}, chunk[] = {3, 17, 3}, tiny[] = {1, 1, 1};
  for (size_t k = 0; k < 2 * sizeof all / sizeof *all; k++) {
    hid_t file = create();
    put_filtered(file, "x", k % 2 ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT, 3, dims, k % 3 ? chunk : tiny, all[k / 2]);
    close_and_seal(file);
    gg_h5_in in;
    gg_h5_open(&in, "f.h5", false);
    check(&in, "/x", 3000);
    double *row = gg_h5_read_row(&in, "/x", 7, GG_ITEM_F64, 150);
    for (int i = 0; i < 150; i++) assert_true(row[i] == 7 * 150 + i);
    free(row);
    gg_h5_in_close(&in);
  }
}

/* A compressed array, every byte of its file in turn another: it is read or refused, and nothing else happens. */
static void damaged_filters(void **state)
{
  (void)state;
  const hsize_t dims[] = {20, 50, 3}, chunk[] = {7, 17, 3};
  hid_t file = create();
  put_filtered(file, "x", H5T_NATIVE_DOUBLE, 3, dims, chunk, "sgf");
  H5Fclose(file);
  struct stat about;
  const int fd = open("f.h5", O_RDWR);
  assert_int_equal(fstat(fd, &about), 0);
  const size_t size = (size_t)about.st_size;
  unsigned char *all = malloc(size + GG_TRAILER_SIZE);
  assert_int_equal(pread(fd, all, size, 0), size);
  int refused = 0;
  for (size_t at = 8; at < size; at++) {
    gg_h5_in in;
    size_t n;
    all[at] ^= (unsigned char)(1u << at % 8);
    gg_files_checksum_trailer_of(all, size, all + size);
    assert_int_equal(pwrite(fd, all, size + GG_TRAILER_SIZE, 0), size + GG_TRAILER_SIZE);
    gg_h5_open(&in, "f.h5", false);
    free(gg_h5_read_array(&in, "/x", GG_ITEM_F64, &n));
    refused += in.failed;
    gg_h5_in_close(&in);
    all[at] ^= (unsigned char)(1u << at % 8);
  }
  assert_true(refused > 100);
  free(all);
  close(fd);
}

/* Without its checksum a file is one that another program has changed, if it is as long as it says. */
static void bare_files(void **state)
{
  (void)state;
  hid_t file = create();
  put(file, "x", H5T_NATIVE_DOUBLE, 1, &(hsize_t){100}, NULL);
  H5Fclose(file);
  struct stat about;
  gg_h5_in in;
  gg_h5_open(&in, "f.h5", false);
  assert_true(in.failed && strstr(in.why, "checksum is missing"));
  gg_h5_in_close(&in);
  gg_h5_open(&in, "f.h5", true);
  assert_true(in.changed);
  check(&in, "/x", 100);
  gg_h5_in_close(&in);
  stat("f.h5", &about);
  for (int k = -1; k <= 1; k += 2) {
    assert_int_equal(truncate("f.h5", about.st_size + k), 0);
    gg_h5_open(&in, "f.h5", true);
    assert_true(in.failed && strstr(in.why, "cut off or damaged"));
    gg_h5_in_close(&in);
  }
}

/* One group with thousands of names is a tree of several levels; a missing name is not found. */
static void thousands_of_names_are_found(void **state)
{
  (void)state;
  enum { MANY = 3000 };
  hid_t file = create();
  char name[40];
  for (int i = 0; i < MANY; i++) {
    snprintf(name, sizeof name, "/%d", i);
    put(file, name, H5T_NATIVE_INT32, 1, &(hsize_t){(hsize_t)(i % 3)}, NULL);
  }
  for (int i = 0; i < 14; i++) { /* larger than what is kept in memory */
    snprintf(name, sizeof name, "/long%d", i);
    put(file, name, H5T_NATIVE_DOUBLE, 1, &(hsize_t){10000}, NULL);
  }
  close_and_seal(file);
  gg_h5_in in;
  gg_h5_open(&in, "f.h5", false);
  assert_null(in.whole);
  check(&in, "/long13", 10000);
  for (int i = 0; i < MANY; i++) {
    snprintf(name, sizeof name, "/%d", i);
    check(&in, name, (size_t)i % 3);
  }
  assert_false(gg_h5_exists(&in, "/x"));
  assert_false(gg_h5_exists(&in, "/30000"));
  assert_false(gg_h5_exists(&in, "/7/x"));
  assert_true(gg_h5_exists(&in, "/7"));
  assert_false(in.failed);
  gg_h5_in_close(&in);
}

/* Numbers of every type are converted to the requested type; values outside its range become its nearest limit. */
static void all_number_types_are_converted(void **state)
{
  (void)state;
  const hid_t kinds[] = {H5T_STD_I8LE,  H5T_STD_U8BE,  H5T_STD_I16BE,  H5T_STD_U16LE,  H5T_STD_I32LE,  H5T_STD_U32BE,
                         H5T_STD_I64BE, H5T_STD_U64LE, H5T_IEEE_F32LE, H5T_IEEE_F32BE, H5T_IEEE_F64BE, H5T_IEEE_F64LE};
  hid_t file = create();
  char name[8];
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    snprintf(name, sizeof name, "/%zu", k);
    put(file, name, kinds[k], 1, &(hsize_t){100}, NULL);
  }
  const double far[] = {-1e300, -3, 300, 1e300};
  hid_t space = H5Screate_simple(1, &(hsize_t){4}, NULL);
  hid_t set = H5Dcreate2(file, "/far", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, far);
  H5Dclose(set);
  H5Sclose(space);
  close_and_seal(file);
  gg_h5_in in;
  size_t n;
  gg_h5_open(&in, "f.h5", false);
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    snprintf(name, sizeof name, "/%zu", k);
    check(&in, name, 100);
    int64_t *x = gg_h5_read_array(&in, name, GG_ITEM_I64, &n);
    uint8_t *y = gg_h5_read_array(&in, name, GG_ITEM_U8, &n);
    for (size_t i = 0; i < n; i++) assert_true(x[i] == (int64_t)i && y[i] == i);
    free(x);
    free(y);
  }
  uint8_t *small = gg_h5_read_array(&in, "/far", GG_ITEM_U8, &n);
  assert_true(small[0] == 0 && small[1] == 0 && small[2] == 255 && small[3] == 255);
  int64_t *whole = gg_h5_read_array(&in, "/far", GG_ITEM_I64, &n);
  assert_true(whole[0] == INT64_MIN && whole[1] == -3 && whole[2] == 300 && whole[3] == INT64_MAX);
  free(small);
  free(whole);
  gg_h5_in_close(&in);
}

/* A header with many attributes has several pieces. */
static void headers_in_pieces_are_read(void **state)
{
  (void)state;
  enum { MANY = 200 };
  hid_t file = create(), group = H5Gcreate2(file, "/g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  hid_t one = H5Screate(H5S_SCALAR), text = H5Tcopy(H5T_C_S1);
  char name[20];
  H5Tset_size(text, 6);
  for (int i = 0; i < MANY; i++) {
    snprintf(name, sizeof name, "number %d", i);
    hid_t a = H5Acreate2(group, name, H5T_NATIVE_INT, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(a, H5T_NATIVE_INT, &i);
    H5Aclose(a);
  }
  hid_t a = H5Acreate2(group, "word", text, one, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(a, text, "grains");
  H5Aclose(a);
  H5Tclose(text);
  H5Sclose(one);
  H5Gclose(group);
  close_and_seal(file);
  gg_h5_in in;
  gg_h5_open(&in, "f.h5", false);
  for (int i = 0; i < MANY; i++) {
    double x = -1;
    snprintf(name, sizeof name, "number %d", i);
    gg_h5_read_attribute(&in, "/g", name, GG_ITEM_F64, &x);
    assert_true(x == i);
  }
  char *word = gg_h5_read_text_attribute(&in, "/g", "word");
  assert_string_equal(word, "grains");
  free(word);
  assert_false(gg_h5_has_attribute(&in, "/g", "numbe"));
  assert_false(in.failed);
  gg_h5_in_close(&in);
}

static void expect_refusal(const char *path, const char *words)
{
  gg_h5_in in;
  gg_error err;
  size_t n;
  gg_h5_open(&in, "f.h5", false);
  assert_null(gg_h5_read_array(&in, path, GG_ITEM_F64, &n));
  gg_h5_in_close(&in);
  assert_int_equal(gg_h5_in_status(&in, "f.h5", &err), GG_BAD_FILE);
  if (!strstr(err.message, words)) fail_msg("%s: %s", words, err.message);
}

/* Arrays of unknown compression, links to other files, texts and newer formats are rejected. */
static void unsupported_files_are_rejected(void **state)
{
  (void)state;
  const hsize_t dims = 1000, chunk = 100;
  hid_t file = create(), space = H5Screate_simple(1, &dims, NULL), how = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(how, 1, &chunk);
  H5Pset_scaleoffset(how, H5Z_SO_FLOAT_DSCALE, 2);
  double x[1000] = {0};
  hid_t set = H5Dcreate2(file, "/small", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x);
  H5Dclose(set);
  set = H5Dcreate2(file, "/never", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dclose(set);
  hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, H5T_VARIABLE);
  set = H5Dcreate2(file, "/text", text, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dclose(set);
  H5Lcreate_soft("/small", file, "/soft", H5P_DEFAULT, H5P_DEFAULT);
  hid_t group = H5Gcreate2(file, "/far", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_external("/etc/passwd", "/x", group, "away", H5P_DEFAULT, H5P_DEFAULT);
  H5Gclose(group);
  H5Pclose(how);
  H5Sclose(space);
  H5Tclose(text);
  close_and_seal(file);
  expect_refusal("/small", "/small: is compressed by another filter than gzip");
  expect_refusal("/never", "/never: is larger than its file");
  expect_refusal("/soft", "/soft: is not there");
  expect_refusal("/far/away", "/far/away: is not there");
  expect_refusal("/nothing", "/nothing: is not there");
  expect_refusal("/", "is not an array");
  hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  file = H5Fcreate("f.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  H5Pclose(access);
  put(file, "/x", H5T_NATIVE_DOUBLE, 1, &dims, NULL);
  close_and_seal(file);
  expect_refusal("/x", "of a form of HDF5 that graingas does not write");
}

/* A whole result, every 13th of its words in turn replaced: it is read or refused, and nothing else happens.
 * (validation/fuzz goes on from there.) */
static void replaced_words_are_read_or_rejected(void **state)
{
  (void)state;
  static const uint64_t bad[] = {0, 1, 7, 0x7FFFFFFFFFFFFFFF, UINT64_MAX, 0xFFFFFFFF, 96, 800};
  gg_error err = {0};
  gg_result *r = planted_result(GG_MD);
  assert_int_equal(gg_result_write(r, "f.h5", NULL, NULL, &err), GG_OK);
  gg_result_free(r);
  struct stat about;
  int fd = open("f.h5", O_RDWR), refused = 0;
  assert_int_equal(fstat(fd, &about), 0);
  const size_t size = (size_t)about.st_size - GG_TRAILER_SIZE;
  unsigned char *all = malloc(size + GG_TRAILER_SIZE);
  assert_int_equal(pread(fd, all, size, 0), size);
  for (size_t at = 8, k = 0; at + 8 <= size; at += 13 * 8, k++) {
    unsigned char was[8];
    gg_stored_result s;
    memcpy(was, all + at, 8);
    memcpy(all + at, &bad[k % (sizeof bad / sizeof *bad)], 8);
    gg_files_checksum_trailer_of(all, size, all + size);
    assert_int_equal(pwrite(fd, all, size + GG_TRAILER_SIZE, 0), size + GG_TRAILER_SIZE);
    if (gg_files_stored_result_read(&s, "f.h5", &err) == GG_OK)
      gg_files_stored_result_clear(&s);
    else
      refused++;
    memcpy(all + at, was, 8);
  }
  assert_true(refused > 20);
  free(all);
  close(fd);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(chunked_arrays_are_read_whole_and_by_rows),
                                     cmocka_unit_test(thousands_of_names_are_found),
                                     cmocka_unit_test(all_number_types_are_converted),
                                     cmocka_unit_test(headers_in_pieces_are_read),
                                     cmocka_unit_test(unsupported_files_are_rejected),
                                     cmocka_unit_test(replaced_words_are_read_or_rejected),
                                     cmocka_unit_test(arrays_of_other_programs_are_decompressed),
                                     cmocka_unit_test(damaged_filters),
                                     cmocka_unit_test(bare_files)};
  return cmocka_run_group_tests(tests, enter, leave);
}
