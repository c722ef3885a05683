#include "repros/c_check.h"

#include <fmt/format.h>

#include "case/float_bits.h"
#include "case/real_text.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr std::string_view main_text =
    R"(static bool is_near(const char* name, double got, double exact, double leeway) {
  const bool near_enough = fabs(got - exact) <= leeway;  // a NaN isn't
  printf("  %s = %-24a (%.17g), expected %a (%.17g)%s\n", name, got, got, exact, exact, near_enough ? "" : ": WRONG");
  return near_enough;
}

int main(void) {
  const Answer got = ask();
  bool right = @RIGHT@;
  printf("expected @EXPECTED@, got %s%s\n", got.hit ? "a hit" : "a miss", right ? "" : ": WRONG");
@NUMBERS@  return right ? 0 : 1;
}
)";

constexpr std::string_view numbers_text = R"(  if (got.hit) {
    // The exact numbers, rounded, and how far off a hit may be: 2^-10 of the longest edge, at the most twice that.
@LINES@  }
)";

constexpr std::string_view unused_text = R"(int main(void) {
  const Answer got = ask();
  const bool right = @RIGHT@;
  printf("expected @EXPECTED@, got %s%s\n", got.hit ? "a hit" : "a miss", right ? "" : ": WRONG");
  return right ? 0 : 1;
}
)";

std::string vector_line(std::string_view type, std::string_view name, const Vec3& v, Precision precision) {
  return fmt::format("{} {}[3] = {{{}}};  // {}\n", type, name, c_numbers(v, precision), decimals(v));
}

std::string near_line(std::string_view name, double exact, double leeway) {
  if (!is_finite(exact)) return "";  // beyond double: not to be compared with
  return fmt::format("    right = is_near(\"{}\", got.{}, {}, {}) && right;\n", name, name, hexfloat(exact),
                     c_number(leeway, Precision::binary64));
}

std::string number_lines(const Evidence& e, Told told) {
  if (!e.has_numbers()) return "";
  std::string lines;
  if (told.t) lines += near_line("t", e.exact->t, e.leeway->t);
  if (told.uv) lines += near_line("u", e.exact->u, e.leeway->u) + near_line("v", e.exact->v, e.leeway->v);
  return lines;
}

}  // namespace

std::string c_triangle(const Evidence& e, std::string_view type) {
  const Triangle& t = e.triangle();
  const Precision p = e.contract.precision;
  return vector_line(type, "a", t.a, p) + vector_line(type, "b", t.b, p) + vector_line(type, "c", t.c, p);
}

std::string c_ray(const Evidence& e, std::string_view type) {
  const Precision p = e.contract.precision;
  return vector_line(type, "origin", e.ray().origin, p) + vector_line(type, "direction", e.ray().direction, p);
}

std::string c_range(const Evidence& e, std::string_view type) {
  const Ray searched = searched_ray(e.ray(), e.contract).ray;
  const Precision p = e.contract.precision;
  return fmt::format("{} t_min = {}, t_max = {};\n", type, c_number(searched.t_min, p), c_number(searched.t_max, p));
}

std::string c_answer() {
  return "typedef struct {\n  bool hit;\n  double t, u, v;  // u: weight of b; v: of c\n} Answer;\n";
}

std::string c_main(const Evidence& e, Told told) {
  constexpr std::string_view expected[] = {"a hit", "a miss", "either (nothing is promised here)"};
  constexpr std::string_view right[] = {"got.hit", "!got.hit", "true"};
  const auto duty = static_cast<unsigned>(e.duty);
  const std::string lines = number_lines(e, told);
  return fill(lines.empty() ? unused_text : main_text, {{"RIGHT", std::string(right[duty])},
                                                        {"EXPECTED", std::string(expected[duty])},
                                                        {"NUMBERS", fill(numbers_text, {{"LINES", lines}})}});
}

}  // namespace plumbline
