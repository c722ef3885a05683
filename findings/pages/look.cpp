#include "findings/pages/look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/bag_examine.h"
#include "case/float_bits.h"
#include "case/precision.h"
#include "oracle/judge.h"

namespace plumbline {
namespace {

double largest_coordinate(const Triangle& triangle, const Ray& ray) {
  double largest = 0;
  for (const Vec3& v : {triangle.a, triangle.b, triangle.c, ray.origin})
    largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest;
}

Neighbours neighbours(const Triangle& triangle, const Ray& ray, const Tracer& tracer) {
  Triangle t = triangle;
  Ray r = ray;
  const std::array<Vec3*, 5> vectors = {&t.a, &t.b, &t.c, &r.origin, &r.direction};
  Examiner examiner(tracer);
  Neighbours n;
  for (Vec3* const v : vectors) {
    for (double* const x : {&v->x, &v->y, &v->z}) {
      const double here = *x;
      for (const int step : {-1, 1}) {
        *x = step_ulps(here, step, tracer.info().contract.precision);
        if (!is_finite(*x)) continue;
        ++n.asked;
        n.wrong += signature(examiner.examine(t, r)).has_value();
      }
      *x = here;
    }
  }
  return n;
}

OtherOpinion opinion_on_several(const Case& asked, const Tracer& tracer) {
  const BagExamination e = examine_bag(tracer, asked);
  return {.outcome = e.answer.outcome,
          .verdict = verdict_kind(e.judgement.verdict),
          .ulps = e.judgement.ulps,
          .rounded = e.put.bag != asked.bag || e.put.ray != asked.ray,
          .own_query = e.query != searched_ray(e.put.ray, tracer.info().contract)};
}

}  // namespace

Look look(const FoundCase& found, FindingKind kind, const Tracer* tracer) {
  Look l;
  l.contract.precision = found.what.precision;
  if (tracer) l.contract = tracer->info().contract;
  const Precision precision = l.contract.precision;
  l.triangle = at_precision(found.what.bag.triangles.front(), precision);
  l.given = at_precision(found.what.ray, precision);
  l.ulps = found.ulps;
  l.query = searched_ray(l.given, l.contract);
  if (tracer) {
    const Examination e = Examiner(*tracer).examine(l.triangle, l.given);
    l.query = e.query;
    l.own_query = e.query != searched_ray(l.given, l.contract);
    l.answer = e.answer;
    l.verdict = e.verdict;
    l.signature = signature(e, found.what.aim ? found.what.aim->wish : Wish::none);
    if (l.signature) l.ulps = finding_ulps(e, *l.signature);
    if (kind != FindingKind::death) l.neighbours = neighbours(l.triangle, l.given, *tracer);
  }
  l.certificate = certificate(l.triangle, l.query);
  l.margins = margins(l.triangle, l.query, precision);
  l.duty = duty(l.triangle, l.query, l.certificate.truth, l.contract);
  if (l.margins) l.longest_edge_ulps = l.margins->size * (largest_coordinate(l.triangle, l.given) / l.margins->ulp);
  return l;
}

std::vector<OtherOpinion> opinions(const Case& asked, std::span<const Tracer* const> tracers) {
  std::vector<OtherOpinion> all;
  for (const Tracer* const tracer : tracers) {
    if (asked.bag.triangles.size() > 1) {
      all.push_back(opinion_on_several(asked, *tracer));
      continue;
    }
    const Contract& contract = tracer->info().contract;
    const Case put = put_at(asked, contract.precision);
    const Reply reply = ask(*tracer, asked);
    const Judgement judgement = judge(asked, reply, contract);
    all.push_back({.outcome = reply.answer.outcome,
                   .verdict = judgement.verdict,
                   .ulps = judgement.severity ? judgement.severity->ulps : 0,
                   .rounded = put.bag != asked.bag || put.ray != asked.ray,
                   .own_query = reply.query != Query(put.ray)});
  }
  return all;
}

}  // namespace plumbline
