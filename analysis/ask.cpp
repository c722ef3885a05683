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

Reply ask(const Tracer& tracer, const Case& asked) {
  const Case put = put_at(asked, tracer.info().contract.precision);
  const auto bag = tracer.prepare(put.bag);
  Reply reply;
  bag->trace({&put.ray, 1}, {&reply.answer, 1});
  reply.query = bag->asked(put.ray);
  reply.conduct = bag->conduct();
  return reply;
}

Judgement judge(const Case& asked, const Answer& answer, const Contract& contract) {
  return judge(asked, Reply{.query = at_precision(asked.ray, contract.precision), .answer = answer}, contract);
}

Judgement judge(const Case& asked, const Reply& reply, const Contract& contract) {
  const Triangle triangle = at_precision(asked.bag.triangles.front(), contract.precision);
  const auto& [query, answer, conduct] = reply;
  const Query searched = searched_ray(query, contract);
  Judgement judgement{.truth = classify(triangle, searched), .hit = {}, .severity = {}};
  judgement.hit = hit(triangle, searched, judgement.truth);
  judgement.verdict = judge(triangle, query, judgement.truth, answer, contract);
  if (wrong(judgement.verdict))
    judgement.severity = severity(triangle, searched, answer.outcome == Outcome::hit, contract.precision);
  return judgement;
}

}  // namespace plumbline
