/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of checkpoints: bit for bit what was written, two generations of it, and others' refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/build.h"
#include "files/h5/checkpoint_file.h"
#include "files/h5/checksum_trailer.h"
#include "files/h5/hdf5_writer.h"
#include "files/h5/result_reader.h"
#include "own_folder.h"
#include "scene/scene.h"

static gg_archive archive(double first)
{
  gg_archive a = {0};
  const double f64[3] = {first, -0.0, 1e-310};
  const int64_t i64 = INT64_MIN;
  const uint64_t u64[2] = {UINT64_MAX, 1};
  gg_base_archive_put(&a, "z/last name first", GG_ITEM_F64, f64, 3, NULL);
  gg_base_archive_put(&a, "replica0/md/grains", GG_ITEM_I64, &i64, 1, NULL);
  gg_base_archive_put(&a, "u64", GG_ITEM_U64, u64, 2, NULL);
  gg_base_archive_put(&a, "bytes", GG_ITEM_U8, "\0\1\377", 3, NULL);
  gg_base_archive_put(&a, "empty", GG_ITEM_F64, NULL, 0, NULL);
  return a;
}

static void assert_same(const gg_archive *a, const gg_archive *b)
{
  assert_int_equal(a->n_items, b->n_items);
  for (size_t i = 0; i < a->n_items; i++) {
    assert_string_equal(a->items[i].name, b->items[i].name);
    assert_int_equal(a->items[i].type, b->items[i].type);
    assert_int_equal(a->items[i].count, b->items[i].count);
    assert_memory_equal(a->items[i].data, b->items[i].data,
                        a->items[i].count * gg_base_archive_item_size(a->items[i].type));
  }
}

/* In the first byte of the first place in a file that holds these. */
static void flip_bit(const char *path, const void *bytes, size_t size)
{
  FILE *f = fopen(path, "r+b");
  char *all = calloc(1, 100000);
  char *at = memmem(all, fread(all, 1, 100000, f), bytes, size);
  assert_non_null(at);
  fseek(f, at - all, SEEK_SET);
  fputc(at[0] ^ 1, f);
  fclose(f);
  free(all);
}

static void seal_anew(const char *path)
{
  struct stat about;
  unsigned char seal[GG_TRAILER_SIZE];
  int fd = open(path, O_RDWR);
  assert_true(fstat(fd, &about) == 0 && ftruncate(fd, about.st_size - GG_TRAILER_SIZE) == 0);
  assert_int_equal(gg_files_checksum_trailer_of_file(fd, seal), 0);
  assert_int_equal(pwrite(fd, seal, sizeof seal, about.st_size - GG_TRAILER_SIZE), GG_TRAILER_SIZE);
  close(fd);
}

/* Bit for bit; the generation before is kept, and taken when the present one is damaged or gone. */
static void checkpoint_generations(void **state)
{
  (void)state;
  gg_error err = {0};
  bool older;
  gg_scene scene = gg_scene_defaults();
  gg_archive one = archive(1), two = archive(2), back = {0};
  assert_int_equal(gg_files_checkpoint_write("c.h5", false, true, &one, &scene, &err), GG_OK);
  assert_int_equal(gg_files_checkpoint_write("c.h5", false, true, &two, &scene, &err), GG_OK);
  assert_int_equal(gg_files_checkpoint_read("c.h5", false, &back, &older, &err), GG_OK);
  assert_false(older);
  assert_same(&two, &back);
  gg_base_archive_clear(&back);

  /* One flipped bit in the data is found by the checksum. */
  double wanted = 2;
  flip_bit("c.h5", &wanted, sizeof wanted);
  assert_int_equal(gg_files_checkpoint_read("c.h5", false, &back, &older, &err), GG_OK);
  assert_true(older);
  assert_same(&one, &back);
  gg_base_archive_clear(&back);
  unlink("c.h5");
  assert_int_equal(gg_files_checkpoint_read("c.h5", false, &back, &older, &err), GG_OK);
  assert_true(older);
  gg_base_archive_clear(&back);
  unlink("c.h5.1");
  assert_int_equal(gg_files_checkpoint_read("c.h5", false, &back, &older, &err), GG_BAD_FILE);
  assert_string_equal(err.message, "c.h5: cannot be read: No such file or directory");
  gg_base_archive_clear(&one);
  gg_base_archive_clear(&two);
  remove_all();
}

/* States go in as they stand in memory: those of a build of other sources are rejected with both named, unless they
 * are wanted all the same. */
static void checkpoint_of_another_build(void **state)
{
  (void)state;
  gg_error err = {0};
  bool older;
  gg_scene scene = gg_scene_defaults();
  gg_archive one = archive(1), back = {0};
  assert_int_equal(gg_files_checkpoint_write("c.h5", false, true, &one, &scene, &err), GG_OK);
  flip_bit("c.h5", gg_base_build_identity, strlen(gg_base_build_identity));
  seal_anew("c.h5");
  char other[40], expected[400];
  snprintf(other, sizeof other, "%s", gg_base_build_identity);
  other[0] ^= 1;
  assert_int_equal(gg_files_checkpoint_read("c.h5", false, &back, &older, &err), GG_BAD_FILE);
  snprintf(
      expected, sizeof expected,
      "c.h5: cannot be read: graingas %s (build %s, layout %d) wrote it, and this is graingas %s (build %s, layout "
      "%d): numbers may differ; --accept-version (in programs accept_version) resumes it anyway",
      gg_base_build_version, other, GG_CHECKPOINT_LAYOUT, gg_base_build_version, gg_base_build_identity,
      GG_CHECKPOINT_LAYOUT);
  assert_string_equal(err.message, expected);
  assert_int_equal(gg_files_checkpoint_read("c.h5", true, &back, &older, &err), GG_OK);
  gg_base_archive_clear(&back);
  gg_base_archive_clear(&one);
  remove_all();
}

/* The same of another layout, by the same version; one from before layouts had a number is the first. */
static void checkpoint_of_another_layout(void **state)
{
  (void)state;
  const struct {
    int layout;
    bool remove;
  } cases[] = {{GG_CHECKPOINT_LAYOUT + 1, false}, {1, true}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    gg_error err = {0};
    bool older;
    char expected[400];
    gg_scene scene = gg_scene_defaults();
    gg_archive one = archive(1), back = {0};
    assert_int_equal(gg_files_checkpoint_write("c.h5", false, true, &one, &scene, &err), GG_OK);
    unsigned char seal[GG_TRAILER_SIZE]; /* HDF5 cuts it off */
    hid_t file = H5Fopen("c.h5", H5F_ACC_RDWR, H5P_DEFAULT),
          version = H5Dopen(file, "/checkpoint/version", H5P_DEFAULT);
    hid_t layout = H5Aopen(version, "layout", H5P_DEFAULT);
    if (!cases[k].remove) assert_true(H5Awrite(layout, H5T_NATIVE_INT, &cases[k].layout) >= 0);
    H5Aclose(layout);
    if (cases[k].remove) assert_true(H5Adelete(version, "layout") >= 0);
    H5Dclose(version);
    H5Fclose(file);
    int fd = open("c.h5", O_RDWR | O_APPEND);
    assert_int_equal(gg_files_checksum_trailer_of_file(fd, seal), 0);
    assert_int_equal(write(fd, seal, sizeof seal), GG_TRAILER_SIZE);
    close(fd);
    assert_int_equal(gg_files_checkpoint_read("c.h5", false, &back, &older, &err), GG_BAD_FILE);
    snprintf(
        expected, sizeof expected,
        "c.h5: cannot be read: graingas %s (build %s, layout %d) wrote it, and this is graingas %s (build %s, layout "
        "%d): only a checkpoint of the same layout can be resumed",
        gg_base_build_version, gg_base_build_identity, cases[k].layout, gg_base_build_version, gg_base_build_identity,
        GG_CHECKPOINT_LAYOUT);
    assert_string_equal(err.message, expected);
    gg_stored_result result;
    assert_int_equal(gg_files_stored_result_read(&result, "c.h5", &err),
                     GG_BAD_FILE); /* nor is it advised to go on from it */
    assert_string_equal(err.message, expected);
    gg_base_archive_clear(&one);
    remove_all();
  }
}

/* A checkpoint that cannot be written leaves both generations as they were. */
static void checkpoint_without_room(void **state)
{
  (void)state;
  gg_error err = {0};
  bool older;
  gg_scene scene = gg_scene_defaults();
  gg_archive one = archive(1), back = {0};
  assert_int_equal(gg_files_checkpoint_write("c.h5", false, true, &one, &scene, &err), GG_OK);
  struct rlimit whole, small;
  getrlimit(RLIMIT_FSIZE, &whole);
  small = whole;
  small.rlim_cur = 100;
  setrlimit(RLIMIT_FSIZE, &small);
  gg_status status = gg_files_checkpoint_write("c.h5", false, true, &one, &scene, &err);
  setrlimit(RLIMIT_FSIZE, &whole);
  assert_int_equal(status, GG_BAD_FILE);
  assert_int_equal(gg_files_checkpoint_read("c.h5", false, &back, &older, &err), GG_OK);
  assert_false(older);
  assert_same(&one, &back);
  assert_int_equal(count_files(), 1);
  gg_base_archive_clear(&one);
  gg_base_archive_clear(&back);
  remove_all();
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(checkpoint_generations),
      cmocka_unit_test(checkpoint_of_another_build),
      cmocka_unit_test(checkpoint_of_another_layout),
      cmocka_unit_test(checkpoint_without_room),
  };
  H5dont_atexit();
  return cmocka_run_group_tests(tests, enter, leave);
}
