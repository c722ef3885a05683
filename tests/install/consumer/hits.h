/* Moller and Trumbore's test. `flat` is the tolerance below which a determinant counts as zero. */
#ifndef HITS_H
#define HITS_H

static inline void cross(const double* p, const double* q, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
}

static inline double dot(const double* p, const double* q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

static inline int hits(const double* triangle, const double* origin, const double* direction, double t_min,
                       double t_max, double flat) {
  double to_b[3], to_c[3], from_a[3], p[3], q[3];
  for (int i = 0; i < 3; ++i) {
    to_b[i] = triangle[3 + i] - triangle[i];
    to_c[i] = triangle[6 + i] - triangle[i];
    from_a[i] = origin[i] - triangle[i];
  }
  cross(direction, to_c, p);
  cross(from_a, to_b, q);
  const double det = dot(to_b, p);
  if (det >= -flat && det <= flat) return 0;
  const double u = dot(from_a, p) / det, v = dot(direction, q) / det, t = dot(to_c, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= t_min && t <= t_max;
}

#endif
