#include "cli/lattice_options.h"

#include "case/input_error.h"
#include "cli/number_options.h"

namespace plumbline {

void add_lattice_options(CLI::App& verb, LatticeOptions& options) {
  verb.add_option("--box", options.box, "Size of the bounding box along x, y and z (decimals, taken exactly)")
      ->check(no_option_among("3 numbers X Y Z"))
      ->type_name("X Y Z")
      ->capture_default_str()
      ->group("Triangles");
  verb.add_option("--step", options.step, "Lattice step: one number, or one each for x, y and z")
      ->type_name("S|X Y Z")
      ->expected(1, 3)
      ->capture_default_str()
      ->group("Triangles");
  verb.add_option("--offset", options.offsets, "Where the box begins; repeat it to visit several places")
      ->check(no_option_among("3 numbers X Y Z"))
      ->type_name("X Y Z")
      ->group("Triangles");
  verb.add_option("--first", options.first, "Index of the first ordered triple of lattice points")
      ->check(whole_number())
      ->type_name("N")
      ->capture_default_str()
      ->group("Triangles");
  verb.add_option("--count", options.count, "How many ordered triples (default: all that follow)")
      ->check(whole_number())
      ->type_name("N")
      ->group("Triangles");
}

std::vector<Lattice> lattices(const LatticeOptions& options) {
  if (options.step.size() == 2) throw InputError("--step: two numbers; give one, or one each for x, y and z");
  std::vector<Lattice> list;
  for (const auto& offset : options.offsets) {
    std::array<LatticeAxis, 3> axes;
    for (std::size_t i = 0; i < 3; ++i)
      axes[i] = {parse_decimal(options.box[i], "--box"),
                 parse_decimal(options.step[options.step.size() == 1 ? 0 : i], "--step"),
                 parse_decimal(offset[i], "--offset")};
    list.push_back(make_lattice(axes));
  }
  return list;
}

}  // namespace plumbline
