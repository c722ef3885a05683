// Shared libraries that don't keep to plumbline_tracer.h, each in one way: HOSTILE_... says in which. Without any it
// is a tracer that hits everything, at the t of the ray's origin's x. With HOSTILE_DEED, what that names happens at a
// ray with t_max 7; with HOSTILE_BAG at a bag of two triangles too, with HOSTILE_LOADING as soon as it is loaded.
#include <fenv.h>
#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include "float_tracer/plumbline_tracer.h"

#ifdef HOSTILE_DEED
static void aborts(plumbline_answer* answer) { (void)answer, abort(); }
static void segfaults(plumbline_answer* answer) {
  volatile int* volatile nowhere = NULL;
  (void)answer;
  *nowhere = 1;
}
static void traps(plumbline_answer* answer) { (void)answer, raise(SIGFPE); }
static void ends(plumbline_answer* answer) { (void)answer, exit(0); }
static void hangs(plumbline_answer* answer) {
  (void)answer;
  volatile int i = 0;
  for (;;) i = i ^ 1;
}
static void floods(plumbline_answer* answer) {
  (void)answer;
  for (int i = 0; i < 200000; ++i) {
    puts("a flood of output");
    fputs("a flood of errors\n", stderr);
  }
  fflush(stdout);
}
static void answers_nan(plumbline_answer* answer) { answer->t = NAN; }
static void rounds_upward(plumbline_answer* answer) { (void)answer, fesetround(FE_UPWARD); }
#endif

static void describe(plumbline_description* into) {
#if defined(HOSTILE_DEED) && defined(HOSTILE_LOADING)
  HOSTILE_DEED(NULL);
#endif
  into->name = "hostile";
  into->precision = 32;
#ifdef HOSTILE_PRECISION
  into->precision = 80;
#endif
#ifdef HOSTILE_EDGES
  into->edges = 4;
#endif
#ifdef HOSTILE_SLACK
  into->slack_absolute = -1;
#endif
#ifdef HOSTILE_NAME
  into->name = "two words";
#endif
}

static void* prepare(const float* vertices, size_t triangles) {
  (void)vertices;
#if defined(HOSTILE_DEED) && defined(HOSTILE_BAG)
  if (triangles == 2) HOSTILE_DEED(NULL);
#endif
  return triangles == 0 ? NULL : malloc(1);
}

static size_t trace(void* bag, const plumbline_ray_f32* rays, size_t count, plumbline_answer* answers) {
  const size_t last = count - 1;
  size_t answered = count;
  (void)bag;
#ifdef HOSTILE_FEWER
  answered = count - 1;
#endif
#ifdef HOSTILE_MORE
  answered = count + 1;
#endif
#ifdef HOSTILE_BEHIND
  ++count;
#endif
  for (size_t i = 0; i < count; ++i) {
    const plumbline_ray_f32* const ray = &rays[i < last ? i : last];
#ifdef HOSTILE_UNSET
    if (i == 1) continue;
#endif
    answers[i].outcome = PLUMBLINE_HIT;
    answers[i].has_t = 1;
    answers[i].t = ray->origin[0];
#ifdef HOSTILE_DEED
    if (ray->t_max == 7) HOSTILE_DEED(&answers[i]);
#endif
#ifdef HOSTILE_OUTCOME
    if (i == 1) answers[i].outcome = 3;
#endif
#ifdef HOSTILE_TRIANGLE
    if (i == 1) answers[i].triangle = 1;
#endif
  }
  return answered;
}

#ifdef HOSTILE_TAIL
static void asked(void* bag, plumbline_query* query) {
  (void)bag;
  query->direction_tail[2] = 0.5;
}
#endif

static void release(void* bag) { free(bag); }

#ifdef HOSTILE_NO_SYMBOL
#define plumbline_tracer another_name
const plumbline_tracer_table* another_name(void);
#endif

const plumbline_tracer_table* plumbline_tracer(void) {
  static plumbline_tracer_table table = {.version = PLUMBLINE_TRACER_VERSION,
                                         .describe = describe,
                                         .prepare_f32 = prepare,
                                         .trace_f32 = trace,
                                         .release = release};
#ifdef HOSTILE_VERSION
  table.version = 7;
#endif
#ifdef HOSTILE_NULL_DESCRIBE
  table.describe = NULL;
#endif
#ifdef HOSTILE_NULL_PREPARE
  table.prepare_f32 = NULL;
#endif
#ifdef HOSTILE_NULL_TRACE
  table.trace_f32 = NULL;
#endif
#ifdef HOSTILE_NULL_RELEASE
  table.release = NULL;
#endif
#ifdef HOSTILE_TAIL
  table.asked = asked;
#endif
#ifdef HOSTILE_NO_TABLE
  return NULL;
#endif
  return &table;
}
