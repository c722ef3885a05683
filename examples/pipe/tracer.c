// A tracer of your own as a program in C, with no library: cases come in as JSON lines, each goes out again with its
// answer. It reads binary64 numbers and rounds them to float, so it is put binary32 cases:
//
//   cc -std=c99 -O2 -ffp-contract=off -o tracer tracer.c
//   plumbline generate exact_edge23 --precision binary32 | ./tracer | plumbline judge -
//   plumbline sweep --tracer pipe32:./tracer --tracer exact
//
// In place of hit_triangle, call what you want tested. The reader is no parser of JSON: it finds the keys in lines
// that Plumbline wrote.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void minus(const float* p, const float* q, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = p[i] - q[i];
}

static void cross(const float* p, const float* q, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
}

static float dot(const float* p, const float* q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

// By the volumes that the ray spans with each edge: all of one sign inside. t is of the plane.
static int hit_triangle(const float* triangle, const float* origin, const float* direction, float t_min, float t_max,
                        float* t) {
  float corner[9], edge[3], other[3], normal[3];
  for (int i = 0; i < 3; ++i) minus(triangle + 3 * i, origin, corner + 3 * i);
  int negative = 0, positive = 0;
  for (int i = 0; i < 3; ++i) {
    cross(corner + 3 * i, corner + 3 * ((i + 1) % 3), other);
    const float volume = dot(other, direction);
    negative += volume < 0;
    positive += volume > 0;
    if (volume != volume) return 0;
  }
  if (negative != 0 && positive != 0) return 0;
  minus(corner + 3, corner, edge);
  minus(corner + 6, corner, other);
  cross(edge, other, normal);
  const float slope = dot(normal, direction);
  if (slope == 0) return 0;
  *t = dot(normal, corner) / slope;
  return *t >= t_min && *t <= t_max;
}

// The numbers behind "key":, whatever brackets and quotes are around them; how many were there. null is `none`.
static int numbers(const char* line, const char* key, int at_most, float none, float* out) {
  char quoted[32];
  snprintf(quoted, sizeof quoted, "\"%s\":", key);
  const char* at = strstr(line, quoted);
  if (!at) return 0;
  at += strlen(quoted);
  int count = 0, depth = 0;
  while (*at && count < at_most) {
    if (*at == '[') {
      ++depth, ++at;
    } else if (*at == ']') {
      ++at;
      if (--depth == 0) break;
    } else if (*at == '"' || *at == ',' || *at == ' ') {
      if (*at == ',' && depth == 0) break;
      ++at;
    } else if (strncmp(at, "null", 4) == 0) {
      out[count++] = none;
      at += 4;
    } else {
      char* end;
      out[count++] = (float)strtod(at, &end);  // "inf" and hexfloats too
      if (end == at) return 0;
      at = end;
    }
  }
  return count;
}

int main(void) {
  static char line[1 << 20];
  while (fgets(line, sizeof line, stdin)) {
    float triangle[9], origin[3], direction[3], t_min = 0, t_max = INFINITY, t = 0;
    char* end = strrchr(line, '}');
    if (!end) continue;
    *end = 0;
    const int complete = numbers(line, "triangle", 9, 0, triangle) == 9 &&
                         numbers(line, "origin", 3, 0, origin) == 3 &&
                         numbers(line, "direction", 3, 0, direction) == 3;
    numbers(line, "t_min", 1, 0, &t_min);
    numbers(line, "t_max", 1, INFINITY, &t_max);
    if (!complete)  // several triangles: this tracer takes one
      printf("%s,\"hit\":null}\n", line);
    else if (hit_triangle(triangle, origin, direction, t_min, t_max, &t))
      printf("%s,\"hit\":true,\"t\":\"%a\"}\n", line, t);
    else
      printf("%s,\"hit\":false}\n", line);
    fflush(stdout);  // Plumbline waits for the answer
  }
  return 0;
}
