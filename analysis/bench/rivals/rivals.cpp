#include "analysis/bench/rivals/rivals.h"

namespace plumbline {

std::vector<Rival> rivals() {
  std::vector<Rival> list;
#ifdef PLUMBLINE_CGAL
  list.push_back(
      {.name = "epick_orientations", .answers = Answers::feature, .exact = false, .ask = ask_epick_orientations});
  list.push_back(
      {.name = "epeck_do_intersect", .answers = Answers::hit, .needs_area = true, .ask = ask_epeck_do_intersect});
  list.push_back({.name = "epeck_ft", .ask = ask_epeck_ft});
#endif
  list.push_back({.name = "mpq_class", .ask = ask_mpq});
#ifdef PLUMBLINE_BOOST
  list.push_back({.name = "cpp_rational", .ask = ask_cpp_rational});
#endif
  return list;
}

}  // namespace plumbline
