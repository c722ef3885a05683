// Shared libraries that don't keep to plumbline_tracer.h, each in one way: HOSTILE_... says in which. Without any it
// is a tracer that hits everything at t = 1.
#include <stddef.h>
#include <stdlib.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "float_tracer/plumbline_tracer.h"

static void describe(plumbline_description* into) {
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
  return triangles == 0 ? NULL : malloc(1);
}

static size_t trace(void* bag, const plumbline_ray_f32* rays, size_t count, plumbline_answer* answers) {
  size_t answered = count;
  (void)bag, (void)rays;
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
#ifdef HOSTILE_UNSET
    if (i == 1) continue;
#endif
    answers[i].outcome = PLUMBLINE_HIT;
    answers[i].has_t = 1;
    answers[i].t = 1;
#ifdef HOSTILE_OUTCOME
    if (i == 1) answers[i].outcome = 3;
#endif
#ifdef HOSTILE_TRIANGLE
    if (i == 1) answers[i].triangle = 1;
#endif
  }
#if defined(HOSTILE_CONTROLS) && defined(__x86_64__)
  _MM_SET_ROUNDING_MODE(_MM_ROUND_UP);
#endif
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
