/* Every call of the public interface with its k-th allocation failing, whoever asked for it: our own code, HDF5, GSL,
 * FFTW, libyaml, jansson or the C library. Each try is a process of its own, so that a crash is one finding. It ends
 * with GG_OK and the whole answer, or with an error that says so; nothing leaks; no file is left half-written. (Blocks
 * that HDF5 and FFTW keep for themselves are not called leaks: they keep them on success, too.)
 *
 * Here some k of each call. By hand: MEMORY_TRIES=0 all, MEMORY_ONLY=word some calls, MEMORY_AT=k one, MEMORY_LAST=1
 * all later ones fail, too, MEMORY_IN=library (failing_malloc.h), MEMORY_HERE=1 all in this process, for a debugger. */
#include <dirent.h>
#include <graingas.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../faults/failing_malloc.h"

static const char scene_text[] = "flow: usf\nphi: 0.2\nparticles: 60\ncollision: {e: 0.9, beta: 0.3, mu: 0.4}\n"
                                 "dsmc: {particles: 100}\nmeasure: [rheology, velocity_distributions]\n"
                                 "run: {collisions: 40, warmup: 10}\n";
static const char simple_text[] = "flow: hcs\nphi: 0.1\nparticles: 60\ncollision: {e: 0.9}\ndsmc: {particles: 100}\n"
                                  "run: {collisions: 40, warmup: 10}\n";
static const char sweep_text[] = "flow: usf\nphi: 0.2\nparticles: 60\nrun: {collisions: 40, warmup: 10}\n"
                                 "vary: {phi: [0.1, 0.2]}\n";

/* What a call makes; all of it is freed afterwards. */
typedef struct things {
  gg_scene *scene, *other; /* scene is there before */
  gg_result *result;
  gg_comparison *comparison;
  gg_trajectory *trajectory;
  gg_simulation *simulation;
  gg_sweep *sweep;
  char *text[3];
  double numbers[8];
  int told;
  bool written; /* a call that writes files has ended well */
} things;

static char digest[1 << 21]; /* of a whole answer: texts, numbers to the last bit */
static size_t digested;

static void say(const char *format, ...) __attribute__((format(printf, 1, 2)));
static void say(const char *format, ...)
{
  va_list list;
  va_start(list, format);
  if (digested < sizeof digest)
    digested += (size_t)vsnprintf(digest + digested, sizeof digest - digested, format, list);
  va_end(list);
}

static void tell_line(void *context, const char *text)
{
  (void)text;
  ((things *)context)->told++;
}

static void tell_file(void *context, const char *file)
{
  tell_line(context, file);
}

static void say_result(const gg_result *r)
{
  gg_measurement m;
  gg_curve_data c;
  gg_result_info info;
  size_t n;
  const double *time, *value;
  for (size_t i = 0; gg_result_at(r, i, &m, NULL) == GG_OK; i++)
    say("%s %a %a %a %llu %s\n", m.name, m.mean, m.error, m.correlation_time, (unsigned long long)m.samples,
        m.reason ? m.reason : "");
  for (size_t i = 0; gg_result_curve(r, i, &c, NULL) == GG_OK; i++) {
    say("%s %s %zu", c.name, c.observable, c.n);
    for (size_t k = 0; k < c.n; k++) say(" %a %a %a", c.x[k], c.value[k], c.error[k]);
    for (size_t k = 0; gg_result_curve_number(r, i, k, &m, NULL) == GG_OK; k++)
      say(" %s %a %a", m.name, m.mean, m.error);
    say("\n");
  }
  for (size_t i = 0; gg_result_warning(r, i); i++) say("%s\n", gg_result_warning(r, i));
  if (gg_result_history(r, "temperature", &n, &time, &value, NULL) == GG_OK)
    for (size_t k = 0; k < n; k++) say(" %a %a", time[k], value[k]);
  if (gg_result_about(r, &info, NULL) == GG_OK)
    say("%s %d %s %lld %llu %zu\n", info.engine, info.steady, info.verdict, (long long)info.grains,
        (unsigned long long)info.collisions, info.frames);
}

static void say_comparison(const gg_comparison *c)
{
  gg_theory_info t;
  gg_curve_data curve;
  gg_remark remark;
  double value;
  for (int k = 0; k < 2; k++) {
    const char *engine = k ? "dsmc" : "md";
    if (gg_comparison_result(c, engine)) say_result(gg_comparison_result(c, engine));
    if (gg_comparison_refusal(c, engine)) say("%s\n", gg_comparison_refusal(c, engine));
  }
  for (size_t i = 0; gg_comparison_theory(c, i, &t, NULL) == GG_OK; i++) {
    say("%s %s\n", t.name, t.reason ? t.reason : "");
    static const char *const names[] = {"temperature", "pressure", "shear_viscosity", "cooling_rate", "a2"};
    for (size_t k = 0; k < 5; k++)
      if (gg_comparison_theory_value(c, t.name, names[k], &value, NULL, NULL) == GG_OK) say(" %a", value);
    for (size_t k = 0; gg_comparison_theory_curve(c, t.name, k, &curve, NULL) == GG_OK; k++) say(" %s", curve.name);
  }
  for (size_t i = 0; gg_comparison_warning(c, i); i++) say("%s\n", gg_comparison_warning(c, i));
  for (size_t i = 0; gg_comparison_remark(c, i, &remark, NULL) == GG_OK; i++)
    say("%s %s\n", remark.theory ? remark.theory : "", remark.cause ? remark.cause : "");
}

/* The same of files, read back. */
static void say_file(const char *path)
{
  gg_result *r = NULL;
  gg_comparison *c = NULL;
  if (gg_result_read(path, &r, NULL) == GG_OK)
    say_result(r);
  else if (gg_comparison_read(path, &c, NULL) == GG_OK)
    say_comparison(c);
  else
    say("%s cannot be read\n", path);
  gg_result_free(r);
  gg_comparison_free(c);
}

static void say_bytes(const char *path)
{
  static char buffer[1 << 16];
  size_t got;
  unsigned long sum = 5381;
  FILE *in = fopen(path, "rb");
  if (!in) return;
  while ((got = fread(buffer, 1, sizeof buffer, in)) > 0)
    for (size_t i = 0; i < got; i++) sum = 33 * sum + (unsigned char)buffer[i];
  fclose(in);
  say("%s %lx\n", path, sum);
}

static bool ends_with(const char *text, const char *end)
{
  size_t n = strlen(text), tail = strlen(end);
  return n >= tail && strcmp(text + n - tail, end) == 0;
}

/* JSON less what the clock says. */
static void say_json(const char *text)
{
  for (const char *line = text; line && *line;) {
    const char *end = strchr(line, '\n');
    size_t n = end ? (size_t)(end - line) : strlen(line);
    if (!memmem(line, n, "_seconds", 8)) say("%.*s\n", (int)n, line);
    line = end ? end + 1 : NULL;
  }
}

#define STEP(call)                                                                                                     \
  do {                                                                                                                 \
    gg_status step = (call);                                                                                           \
    if (step != GG_OK) return step;                                                                                    \
  } while (0)

static gg_status scenes(things *t, gg_error *err)
{
  STEP(gg_scene_parse(scene_text, "memory", &t->other, err));
  STEP(gg_scene_set(t->other, "collision.e", "0.8", err));
  STEP(gg_scene_check(t->other, err));
  STEP(gg_scene_to_yaml(t->other, &t->text[0], err));
  STEP(gg_scene_to_json(t->other, &t->text[1], err));
  STEP(gg_scene_describe(t->other, "md", tell_line, t, err));
  STEP(gg_scene_warnings(t->other, "md", tell_line, t, err));
  return gg_scene_get(t->other, "collision.e", (char *)t->numbers, sizeof t->numbers, err);
}

static gg_status steps(things *t, gg_error *err)
{
  gg_simulation_state s;
  STEP(gg_simulation_new(t->scene, 0, &t->simulation, err));
  STEP(gg_simulation_collide(t->simulation, 500, err));
  STEP(gg_simulation_get_state(t->simulation, &s, err));
  t->numbers[0] = s.temperature, t->numbers[1] = s.time, t->numbers[2] = (double)s.collisions;
  return GG_OK;
}

static gg_status steps_dsmc(things *t, gg_error *err)
{
  STEP(gg_scene_set(t->scene, "engine", "dsmc", err));
  return steps(t, err);
}

static gg_status save(things *t, gg_error *err)
{
  STEP(steps(t, err));
  STEP(gg_simulation_save(t->simulation, "saved.h5", err));
  gg_simulation_free(t->simulation);
  gg_trajectory_free(t->trajectory);
  t->simulation = NULL;
  STEP(gg_simulation_load("saved.h5", NULL, &t->simulation, err));
  return gg_checkpoint_about("saved.h5", &(gg_checkpoint_info){0}, NULL, err);
}

static gg_status run(things *t, gg_error *err)
{
  return gg_run(t->scene, NULL, &t->result, err);
}

static gg_status run_dsmc(things *t, gg_error *err)
{
  STEP(gg_scene_set(t->scene, "engine", "dsmc", err));
  return run(t, err);
}

static gg_status run_all(things *t, gg_error *err)
{
  STEP(gg_scene_set(t->scene, "measure",
                    "[rheology, velocity_distributions, velocity_correlations, orientation, sonine, collisions, "
                    "pair_correlation, structure, diffusion, impact_speed]",
                    err));
  return run(t, err);
}

/* With everything that is written on the way. */
static gg_status run_to_file(things *t, gg_error *err)
{
  const gg_run_options o = {.output = "new.h5", .checkpoint = "new.checkpoint.h5"};
  STEP(gg_scene_set(t->scene, "output", "{trajectory_every: 5, checkpoint_every: 1.0e-6}", err));
  STEP(gg_run(t->scene, &o, &t->result, err));
  t->written = true;
  return gg_result_to_json(t->result, &t->text[0], err);
}

static gg_status go_on(things *t, gg_error *err)
{
  const gg_run_options o = {.output = "new.h5", .checkpoint = "there.checkpoint.h5", .resume = "there.checkpoint.h5"};
  STEP(gg_scene_set(t->scene, "output", "{trajectory_every: 5, checkpoint_every: 1.0e-6}", err));
  return gg_run(t->scene, &o, &t->result, err);
}

static gg_status compare(things *t, gg_error *err)
{
  const gg_run_options o = {.output = "new.h5"};
  STEP(gg_compare(t->scene, &o, &t->comparison, err));
  t->written = true;
  return gg_comparison_to_json(t->comparison, &t->text[0], err);
}

static gg_status theories(things *t, gg_error *err)
{
  STEP(gg_scene_parse(simple_text, "simple", &t->other, err));
  STEP(gg_evaluate_theories(t->other, NULL, &t->comparison, err));
  return gg_comparison_to_json(t->comparison, &t->text[0], err);
}

static gg_status theories_rough(things *t, gg_error *err)
{
  STEP(gg_scene_set(t->scene, "collision", "{e: 0.9, beta: 0}", err));
  STEP(gg_evaluate_theories(t->scene, NULL, &t->comparison, err));
  return gg_comparison_to_json(t->comparison, &t->text[0], err);
}

static void note_ended(void *context, size_t i, gg_status status, const char *file, const char *message)
{
  (void)context, (void)i, (void)status, (void)file;
  if (strstr(message, "memory")) digest[sizeof digest - 1] = 1; /* the sum of a sweep names no single reason */
}

static gg_status sweep(things *t, gg_error *err)
{
  const gg_sweep_options o = {.ended = note_ended};
  STEP(gg_sweep_parse(sweep_text, "sweep", &t->sweep, err));
  STEP(gg_sweep_check(t->sweep, err));
  return gg_sweep_run(t->sweep, "new.sweep", &o, err);
}

static gg_status collect(things *t, gg_error *err)
{
  const gg_collecting o = {.picture = "none"};
  t->written = true; /* the first table may be there whole without the second */
  STEP(gg_sweep_parse(sweep_text, "sweep", &t->sweep, err));
  STEP(gg_sweep_check(t->sweep, err));
  STEP(gg_sweep_collect(t->sweep, "there.sweep", "new", &o, tell_file, t, err));
  return gg_sweep_to_json(t->sweep, "there.sweep", &t->text[0], err);
}

static gg_status read_result(things *t, gg_error *err)
{
  STEP(gg_result_read("there.h5", &t->result, err));
  return gg_result_to_json(t->result, &t->text[0], err);
}

static gg_status read_comparison(things *t, gg_error *err)
{
  STEP(gg_comparison_read("both.h5", &t->comparison, err));
  return gg_comparison_to_json(t->comparison, &t->text[0], err);
}

static gg_status play(things *t, gg_error *err)
{
  gg_simulation_state state;
  STEP(gg_trajectory_open("both.h5", &t->trajectory, err));
  return gg_trajectory_frame(t->trajectory, 0, &state, NULL, err);
}

static gg_status export(things *t, gg_error *err)
{
  return gg_export("there.h5", "new", GG_EXPORT_ALL, tell_file, t, err);
}

static gg_status plot(things *t, gg_error *err)
{
  t->written = true; /* a page that fails keeps none of the others from being drawn */
  return gg_plot("there.h5", "new.svg", NULL, tell_file, t, err);
}

static gg_status extend(things *t, gg_error *err)
{
  static const double speed[] = {0.1, 1}, e[] = {0.95, 0.8};
  static const gg_quantity_definition own = {"own", "1", "a number"};
  const gg_observable_definition observable = {.name = "mine", .n_quantities = 1, .quantities = &own};
  STEP(gg_scene_copy(t->scene, &t->other, err));
  STEP(gg_scene_set_restitution_table(t->other, "soft", 2, speed, e, err));
  gg_status refused = gg_scene_add_observable(t->other, &observable, err); /* it lacks its function */
  if (refused != GG_BAD_INPUT && refused != GG_FAILED) return GG_FAILED;
  return gg_run(t->other, NULL, &t->result, err);
}

static const struct op {
  const char *name;
  gg_status (*work)(things *t, gg_error *err);
} ops[] = {{"scenes", scenes},
           {"steps, md", steps},
           {"steps, dsmc", steps_dsmc},
           {"run, md", run},
           {"run, dsmc", run_dsmc},
           {"run, every observable", run_all},
           {"a law of one's own", extend},
           {"theories", theories},
           {"theories, rough", theories_rough},
           {"save and load", save},
           {"run to a file", run_to_file},
           {"go on", go_on},
           {"compare to a file", compare},
           {"sweep", sweep},
           {"collect", collect},
           {"read a result", read_result},
           {"read a comparison", read_comparison},
           {"read a trajectory", play},
           {"export", export},
           {"plot", plot}};
enum { OPS = sizeof ops / sizeof *ops };

static void clear(things *t)
{
  gg_scene_free(t->scene);
  gg_scene_free(t->other);
  gg_result_free(t->result);
  gg_comparison_free(t->comparison);
  gg_simulation_free(t->simulation);
  gg_trajectory_free(t->trajectory);
  gg_sweep_free(t->sweep);
  for (size_t i = 0; i < sizeof t->text / sizeof *t->text; i++) free(t->text[i]);
}

/* What the call left: in memory, and in files, of which those that begin with "new" are its own. */
static void look(const things *t, bool whole, int *litter)
{
  struct dirent **all;
  if (whole && t->result) say_result(t->result);
  if (whole && t->comparison) say_comparison(t->comparison);
  for (int i = 0; whole && i < 3; i++) say_json(t->text[i]);
  if (whole)
    for (int i = 0; i < 8; i++) say("%a ", t->numbers[i]);
  if (whole) say("%d\n", t->told);
  const char *const folders[] = {".", "new.sweep"};
  for (int f = 0; f < 2; f++) {
    int n = scandir(folders[f], &all, NULL, alphasort);
    for (int i = 0; i < n; i++) {
      const char *name = all[i]->d_name;
      char path[600];
      snprintf(path, sizeof path, "%s/%s", folders[f], name);
      bool own = *name != '.' && (f == 1 || strncmp(name, "new", 3) == 0);
      bool temporary = strstr(name, "graingas-") || strstr(name, ".work.");
      if (temporary) ++*litter, printf("#   is left: %s\n", path);
      if (own && whole) ends_with(name, ".h5") ? say_file(path) : say_bytes(path);
      bool some = t->written || t->result || t->comparison; /* a comparison of which one engine failed is written */
      if (own && !whole && !some && !temporary && !strstr(name, "checkpoint") && !ends_with(name, ".sweep") && f == 0)
        ++*litter, printf("#   is there although it failed: %s\n", path);
      free(all[i]);
    }
    if (n >= 0) free(all);
  }
}

static char *reference; /* shared with the processes of the tries */
static const char *home;

static void enter_folder(void)
{
  char command[300];
  snprintf(command, sizeof command, "rm -rf %s/try && cp -r %s/there %s/try", home, home, home);
  if (system(command) != 0 || chdir(home) != 0 || chdir("try") != 0) abort();
}

typedef struct outcome { /* of one try, told by its process */
  uint64_t calls, faults, cached;
  int clean, harmless, wrong, ended;
} outcome;

static int wrong(const char *what, const char *message)
{
  printf("#   %s: %.300s; failed was", what, message);
  failing_malloc_where(stdout);
  return 1;
}

static void try_one(const struct op *op, uint64_t at, bool last, const char *in, outcome *o)
{
  things t = {0};
  gg_error err = {0};
  int litter = 0;
  if (gg_scene_parse(scene_text, "memory", &t.scene, NULL) != GG_OK) abort();
  *digest = digest[sizeof digest - 1] = 0, digested = 0;
  failing_malloc_arm(at, last, in);
  gg_status status = op->work(&t, &err);
  o->calls = failing_malloc_disarm(&o->faults);
  bool whole = status == GG_OK;
  look(&t, whole, &litter);
  clear(&t);
  if (litter) o->wrong += wrong("litter", "");
  if (whole && at && strcmp(digest, reference) != 0) {
    size_t same = 0;
    while (digest[same] == reference[same]) same++;
    o->wrong += wrong("GG_OK, and another answer", digest + (same > 40 ? same - 40 : 0));
  }
  bool said = strstr(err.message, "memory") || digest[sizeof digest - 1];
  if (!whole && (!said || (status != GG_FAILED && status != GG_BAD_FILE))) o->wrong += wrong("said", err.message);
  if (at && failing_malloc_left(NULL, &o->cached)) {
    failing_malloc_left(stdout, NULL);
    o->wrong += wrong("leaks", err.message);
  }
  if (!at) memcpy(reference, digest, sizeof digest);
  o->clean = !whole, o->harmless = whole;
}

/* HDF5, FFTW, GSL's linear algebra and its solvers end the program where they lack memory in some places, which nobody
 * can keep them from; elsewhere it is our mistake. */
static outcome *ending;

static void end(void)
{
  ending->ended = failing_malloc_was_in("libhdf5") || failing_malloc_was_in("libfftw") ||
                  failing_malloc_was_in("gsl_linalg_") || failing_malloc_was_in("gsl_eigen_") ||
                  failing_malloc_was_in("gsl_multiroot_");
  if (ending->ended) return;
  printf("#   ended; failed was");
  failing_malloc_where(stdout);
  fflush(stdout);
}

static void on_signal(int number)
{
  end();
  signal(number, SIG_DFL);
  raise(number);
}

static void watch(outcome *o)
{
  ending = o;
  signal(SIGSEGV, on_signal);
  signal(SIGABRT, on_signal);
  if (atexit(end) != 0) abort();
}

#ifdef COUNTS_LINES
enum { SLOW = 10 };
#else
enum { SLOW = 1 };
#endif

/* In a process of its own. */
static void fork_one(const struct op *op, uint64_t at, bool last, const char *in, outcome *o)
{
  memset(o, 0, sizeof *o);
  fflush(stdout);
  enter_folder();
  if (getenv("MEMORY_HERE")) { /* for a debugger */
    try_one(op, at, last, in, o);
    return;
  }
  pid_t child = fork();
  if (child == 0) {
    alarm(60 * SLOW);
    watch(o);
    try_one(op, at, last, in, o);
    fflush(stdout);
    failing_malloc_keep_counts();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (o->ended) return;
  o->wrong++;
  printf("#   ended by %s %d\n", WIFSIGNALED(status) ? "signal" : "exit code",
         WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
}

static uint64_t number_of(const char *name, uint64_t otherwise)
{
  const char *text = getenv(name);
  return text ? strtoull(text, NULL, 10) : otherwise;
}

static bool try_all(const struct op *op, outcome *shared)
{
  const char *in = getenv("MEMORY_IN");
  const bool last = getenv("MEMORY_LAST");
  uint64_t tries = number_of("MEMORY_TRIES", 25), only = number_of("MEMORY_AT", 0);
  fork_one(op, 0, false, in, shared); /* to know the answer, and how many there are */
  const uint64_t calls = shared->calls, step = tries && calls > tries ? calls / tries : 1;
  uint64_t done = 0, clean = 0, harmless = 0, ended = 0, bad = shared->wrong != 0;
  for (uint64_t at = only ? only : 1; at <= calls && (!only || at == only); at += step) {
    fork_one(op, at, last, in, shared);
    done++, clean += shared->clean != 0, harmless += shared->harmless != 0, ended += shared->ended != 0,
        bad += shared->wrong != 0;
    if (shared->wrong) printf("# %s, allocation %llu\n", op->name, (unsigned long long)at);
  }
  printf("# | %s | %llu | %llu | %llu | %llu | %llu | %llu |\n", op->name, (unsigned long long)calls,
         (unsigned long long)done, (unsigned long long)clean, (unsigned long long)harmless, (unsigned long long)ended,
         (unsigned long long)bad);
  return bad == 0;
}

/* What calls go on from and read. */
static void prepare(void)
{
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  gg_comparison *both = NULL;
  gg_sweep *points = NULL;
  const gg_run_options one = {.output = "there.h5"}, two = {.output = "both.h5"};
  if (mkdtemp((char *)(uintptr_t)home) == NULL || chdir(home) != 0 || system("mkdir there") != 0 || chdir("there") != 0)
    abort();
  if (gg_scene_parse(scene_text, "memory", &scene, NULL) != GG_OK) abort();
  gg_run(scene, &one, &result, NULL);
  gg_result_free(result);
  gg_compare(scene, &two, &both, NULL);
  gg_comparison_free(both);
  result = NULL;
  gg_scene_set(scene, "output", "{trajectory_every: 5, checkpoint_every: 1.0e-6}", NULL);
  gg_scene_set(scene, "run", "{collisions: 40, warmup: 10, time_limit: 1.0e-9}", NULL);
  const gg_run_options stopped = {.output = "x.h5", .checkpoint = "there.checkpoint.h5"};
  gg_run(scene, &stopped, &result, NULL);
  gg_result_free(result);
  gg_scene_free(scene);
  if (gg_sweep_parse(sweep_text, "sweep", &points, NULL) == GG_OK) gg_sweep_run(points, "there.sweep", NULL, NULL);
  gg_sweep_free(points);
}

int main(void)
{
  static char folder[] = "/tmp/graingas-memory-XXXXXX";
  const char *only = getenv("MEMORY_ONLY");
  int failed = 0;
  char command[100];
  home = folder;
  prepare();
  outcome *shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  reference = mmap(NULL, sizeof digest, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED || reference == MAP_FAILED) abort();
  printf("1..%d\n", OPS);
  for (int i = 0; i < OPS; i++) {
    bool skip = only && !strstr(ops[i].name, only);
    bool good = skip || try_all(&ops[i], shared);
    failed += !good;
    printf("%sok %d - %s%s\n", good ? "" : "not ", i + 1, ops[i].name, skip ? " # SKIP" : "");
  }
  snprintf(command, sizeof command, "rm -rf %s", home);
  if (system(command) != 0) return 1;
  return failed != 0;
}
