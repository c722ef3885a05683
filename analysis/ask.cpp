#include "analysis/ask.h"

#include "case/precision.h"
#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/judge.h"

namespace plumbline {

Case put_at(Case asked, Precision precision) {
  asked.bag = at_precision(std::move(asked.bag), precision);
  asked.ray = at_precision(asked.ray, precision);
  return asked;
}

Answer ask(const Tracer& tracer, const Case& asked) {
  const Case put = put_at(asked, tracer.info().contract.precision);
  Answer answer;
  tracer.prepare(put.bag)->trace({&put.ray, 1}, {&answer, 1});
  return answer;
}

Judgement judge(const Case& asked, const Answer& answer, const Contract& contract) {
  const Triangle triangle = at_precision(asked.bag.triangles.front(), contract.precision);
  const Ray ray = at_precision(asked.ray, contract.precision);
  const Ray searched = searched_ray(ray, contract);
  Judgement judgement{.truth = classify(triangle, searched), .hit = {}, .severity = {}};
  judgement.hit = hit(triangle, searched, judgement.truth);
  judgement.verdict = judge(triangle, ray, judgement.truth, answer, contract);
  if (wrong(judgement.verdict))
    judgement.severity = severity(triangle, searched, answer.outcome == Outcome::hit, contract.precision);
  return judgement;
}

}  // namespace plumbline
