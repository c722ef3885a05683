// How Plumbline loads a tracer from a shared library: `plumbline sweep --tracer ./libmine.so`. This header is all
// that it needs; C99 and C++, no other file, nothing to link. examples/c_abi is a complete tracer.
//
// The library exports one function, plumbline_tracer(), which returns a table; the table and all that it points to
// stay valid until the library is unloaded. A tracer reads binary32 or binary64 numbers, and fills in the functions
// of that precision. It is judged by what describe() says that it promises: say what its documentation says.
//
// It runs in child processes, where it may abort, hang or print: a ray that it dies of is a fault, and nothing else
// is lost. Each child has one thread; standard input, output and error are /dev/null. The processor's floating-point
// controls are the default ones at every call (round to nearest, subnormals kept); leaving them changed is told.
#ifndef PLUMBLINE_TRACER_H
#define PLUMBLINE_TRACER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Another version has another layout: a library is loaded only by a program of the same version.
#define PLUMBLINE_TRACER_VERSION 2u

// What the tracer is and promises. All is zero when describe() is called: fill in the precision, and what differs.
typedef struct plumbline_description {
  const char* name;       // as tables show it, one word; NULL: the file's name
  const char* summary;    // one sentence, or NULL
  uint32_t precision;     // of the numbers that it reads: 32 or 64
  uint32_t edges;         // PLUMBLINE_EDGES_...
  uint32_t range;         // PLUMBLINE_RANGE_...
  uint32_t t_min, t_max;  // the ends of that range, PLUMBLINE_END_...
  uint32_t coplanar;      // a ray within the triangle's plane, PLUMBLINE_TOUCH_...
  uint32_t degenerate;    // a triangle without area, PLUMBLINE_TOUCH_...
  uint32_t culling;       // PLUMBLINE_CULLING_...
  double slack_absolute;  // by how much it widens a triangle, as a length
  double slack_relative;  // the same, as a multiple of the longest edge
} plumbline_description;

enum {                            // the boundary of a triangle: edges and vertices
  PLUMBLINE_EDGES_CLOSED = 0,     // belongs to it: must hit
  PLUMBLINE_EDGES_OPEN = 1,       // doesn't: must miss
  PLUMBLINE_EDGES_ONE_OWNER = 2,  // exactly one of the triangles that share it is hit
  PLUMBLINE_EDGES_UNSPECIFIED = 3
};
enum {                        // which t are searched
  PLUMBLINE_RANGE_GIVEN = 0,  // the ray's t_min to t_max
  PLUMBLINE_RANGE_RAY = 1,    // from 0 on, whatever the ray says
  PLUMBLINE_RANGE_LINE = 2    // all, whatever the ray says
};
enum { PLUMBLINE_END_CLOSED = 0, PLUMBLINE_END_OPEN = 1, PLUMBLINE_END_UNSPECIFIED = 2 };
enum {  // contact without a crossing
  PLUMBLINE_TOUCH_MISS = 0,
  PLUMBLINE_TOUCH_HIT = 1,
  PLUMBLINE_TOUCH_UNSPECIFIED = 2
};
enum {  // which side is not hit; the front is where the vertices appear counter-clockwise
  PLUMBLINE_CULLING_NONE = 0,
  PLUMBLINE_CULLING_BACK = 1,
  PLUMBLINE_CULLING_FRONT = 2
};

// The points origin + t * direction. The direction has any length but zero; t counts in lengths of it. t_max may be
// infinite, t_min -infinite; hostile cases hold NaN and infinity elsewhere too.
typedef struct plumbline_ray_f32 {
  float origin[3], direction[3], t_min, t_max;
} plumbline_ray_f32;
typedef struct plumbline_ray_f64 {
  double origin[3], direction[3], t_min, t_max;
} plumbline_ray_f64;

// The nearest hit. `outcome` has to be set for every ray; it comes as a value that is none of these.
enum {
  PLUMBLINE_MISS = 0,
  PLUMBLINE_HIT = 1,
  PLUMBLINE_FAULT = 2  // no answer: the input is outside the tracer's stated limits
};
typedef struct plumbline_answer {
  uint32_t outcome;
  uint32_t has_t;     // 1: t is given
  uint32_t has_uv;    // 1: u and v are given: the weights of the second and the third vertex
  uint32_t triangle;  // which one is hit, from 0
  double t, u, v;
} plumbline_answer;

// What the tracer is really asked where its interface can't hold the ray, such as the end points of a segment: the
// exact direction is direction + direction_tail, where the tail is at most half a unit in the last place of the
// direction.
typedef struct plumbline_query {
  double origin[3], direction[3], direction_tail[3], t_min, t_max;
} plumbline_query;

typedef struct plumbline_tracer_table {
  uint32_t version;  // PLUMBLINE_TRACER_VERSION

  void (*describe)(plumbline_description* into);

  // Gets ready to shoot at triangles of three vertices of three coordinates each; the numbers stay valid only during
  // the call. NULL: it can't take these triangles, and every ray is a fault.
  void* (*prepare_f32)(const float* vertices, size_t triangles);   // precision 32; else NULL
  void* (*prepare_f64)(const double* vertices, size_t triangles);  // precision 64; else NULL

  // answers[i] is of rays[i]. Returns how many it answered, which has to be `count`: else all of them are faults.
  size_t (*trace_f32)(void* bag, const plumbline_ray_f32* rays, size_t count, plumbline_answer* answers);
  size_t (*trace_f64)(void* bag, const plumbline_ray_f64* rays, size_t count, plumbline_answer* answers);

  // NULL: it is asked the ray as given. Else: fills in what it is really asked, which is the ray when called.
  void (*asked)(void* bag, plumbline_query* query);

  // Once for each bag that prepare returned, unless NULL; the last ones go with their process instead.
  void (*release)(void* bag);
} plumbline_tracer_table;

#if defined(__GNUC__)
__attribute__((visibility("default")))  // in builds with -fvisibility=hidden too
#endif
const plumbline_tracer_table* plumbline_tracer(void);

#ifdef __cplusplus
}
#endif

#endif
