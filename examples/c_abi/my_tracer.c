// A tracer of your own as a shared library. In place of hit_triangle and the loop around it, call what you want
// tested.
//
//   cc -std=c99 -O2 -shared -fPIC -I FOLDER_OF_THE_HEADER -o libmine.so my_tracer.c -lm
//   plumbline sweep --tracer ./libmine.so --tracer exact
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plumbline_tracer.h"

typedef struct bag {
  size_t count;
  double vertices[];  // 9 numbers a triangle
} bag;

static void minus(const double* p, const double* q, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = p[i] - q[i];
}

static void cross(const double* p, const double* q, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
}

static double dot(const double* p, const double* q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

// Where the ray meets the plane, by the triangle's normal; inside where the point is left of all three edges.
static int hit_triangle(const double* triangle, const plumbline_ray_f64* ray, plumbline_answer* answer) {
  double edge[3], other[3], normal[3], to_plane[3], point[3], weight[3];
  minus(triangle + 3, triangle, edge);
  minus(triangle + 6, triangle, other);
  cross(edge, other, normal);
  const double slope = dot(normal, ray->direction);
  if (slope == 0) return 0;
  minus(triangle, ray->origin, to_plane);
  const double t = dot(normal, to_plane) / slope;
  if (!(t >= ray->t_min && t <= ray->t_max)) return 0;
  for (int i = 0; i < 3; ++i) point[i] = ray->origin[i] + t * ray->direction[i];
  for (int corner = 0; corner < 3; ++corner) {  // its weight is the part of the area that is opposite
    const double* from = triangle + 3 * ((corner + 1) % 3);
    minus(triangle + 3 * ((corner + 2) % 3), from, edge);
    minus(point, from, other);
    double part[3];
    cross(edge, other, part);
    weight[corner] = dot(part, normal);
    if (!(weight[corner] >= 0)) return 0;
  }
  const double whole = dot(normal, normal);
  answer->outcome = PLUMBLINE_HIT;
  answer->has_t = answer->has_uv = 1;
  answer->t = t;
  answer->u = weight[1] / whole;
  answer->v = weight[2] / whole;
  return 1;
}

static void describe(plumbline_description* into) {
  into->name = "my_tracer";
  into->summary = "the example of the C interface: a point in the plane, three times left of an edge";
  into->precision = 64;
}

static void* prepare(const double* vertices, size_t triangles) {
  const size_t size = triangles * 9 * sizeof *vertices;
  bag* made = malloc(sizeof *made + size);
  if (!made) return NULL;
  made->count = triangles;
  if (size != 0) memcpy(made->vertices, vertices, size);
  return made;
}

static size_t trace(void* prepared, const plumbline_ray_f64* rays, size_t count, plumbline_answer* answers) {
  const bag* triangles = prepared;
  for (size_t i = 0; i < count; ++i) {
    answers[i].outcome = PLUMBLINE_MISS;
    plumbline_ray_f64 rest = rays[i];
    for (size_t k = 0; k < triangles->count; ++k)
      if (hit_triangle(triangles->vertices + 9 * k, &rest, &answers[i])) {
        answers[i].triangle = (uint32_t)k;
        rest.t_max = answers[i].t;
      }
  }
  return count;
}

static void release(void* prepared) { free(prepared); }

const plumbline_tracer_table* plumbline_tracer(void) {
  static const plumbline_tracer_table table = {
      .version = PLUMBLINE_TRACER_VERSION,
      .describe = describe,
      .prepare_f64 = prepare,
      .trace_f64 = trace,
      .release = release,
  };
  return &table;
}
