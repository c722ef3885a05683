/* Plugs hits() in. */
#include <plumbline_tracer.h>
#include <stdlib.h>
#include <string.h>

#include "hits.h"

#ifndef FLAT
#define FLAT 0.0
#endif

static void describe(plumbline_description* into) {
  into->name = "consumer_tracer";
  into->precision = 64;
}

static void* prepare(const double* vertices, size_t triangles) {
  if (triangles != 1) return NULL;
  double* copy = malloc(9 * sizeof *copy);
  if (copy) memcpy(copy, vertices, 9 * sizeof *copy);
  return copy;
}

static size_t trace(void* triangle, const plumbline_ray_f64* rays, size_t count, plumbline_answer* answers) {
  for (size_t i = 0; i < count; ++i)
    answers[i].outcome = hits(triangle, rays[i].origin, rays[i].direction, rays[i].t_min, rays[i].t_max, FLAT)
                             ? PLUMBLINE_HIT
                             : PLUMBLINE_MISS;
  return count;
}

const plumbline_tracer_table* plumbline_tracer(void) {
  static const plumbline_tracer_table table = {.version = PLUMBLINE_TRACER_VERSION,
                                               .describe = describe,
                                               .prepare_f64 = prepare,
                                               .trace_f64 = trace,
                                               .release = free};
  return &table;
}
