// A fuzzer's input: the first byte says which space, precision and domain, the rest is the input, cut off or filled
// up with zeros.
#include "case/case_bytes.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fuzz/readers/promise.h"

namespace plumbline {
namespace {

void run(unsigned which, std::span<const std::byte> given) {
  const Space space = which & 1 ? Space::target : Space::ray;
  const Precision precision = which & 2 ? Precision::binary64 : Precision::binary32;
  const Domain domain = which & 4 ? Domain::full : Domain::nominal;
  std::vector<std::byte> bytes(input_size(space, precision));
  std::ranges::copy(given.first(std::min(given.size(), bytes.size())), bytes.begin());

  const FuzzInput input = decode(bytes, space, precision, domain);
  if (!in_domain(input, domain)) broken("an input outside of its domain");
  std::vector<std::byte> written(bytes.size()), again(bytes.size());
  encode(input, written);
  const FuzzInput reread = decode(written, space, precision, domain);
  encode(reread, again);
  if (reread != input || again != written) broken("an input that reads back as another");

  if (space != Space::ray) return;  // of the other, several inputs make the same case
  const auto of_its_case = from_case(to_case(input), space, precision);
  if (!of_its_case || *of_its_case != input) broken("a case that is another input's");
}

}  // namespace
}  // namespace plumbline

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) plumbline::run(data[0], std::as_bytes(std::span(data + 1, size - 1)));
  return 0;
}
