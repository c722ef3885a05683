#include <fmt/format.h>

#include "cli/lattice_options.h"
#include "cli/output.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

void print_lattice(const LatticeOptions& options) {
  const std::vector<Lattice> places = lattices(options);
  const TripleRange range = triple_range(places.front(), options.first, options.count);
  Output output;
  output.write("index,ax,ay,az,bx,by,bz,cx,cy,cz\n");
  for (const Lattice& lattice : places)
    for (std::uint64_t i = range.first; i < range.end; ++i) {
      const LatticeTriple triple = triple_at(lattice, i);
      if (collinear(triple)) continue;
      const auto [a, b, c] = triangle_of(lattice, triple);
      output.write(fmt::format("{},{},{},{},{},{},{},{},{},{}\n", i, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z));
    }
  output.finish();
}

}  // namespace

void add_lattice(CLI::App& app) {
  auto options = std::make_shared<LatticeOptions>();
  CLI::App* verb = app.add_subcommand("lattice", "Print the triangles of a lattice as CSV");
  verb->footer(
      "Every ordered triple a, b, c of the points offset + k * step of the box, collinear ones left out; the index\n"
      "counts these too. c runs fastest, and of each point z. Coordinates are the doubles nearest to the exact ones, "
      "in\n"
      "shortest decimals.\n\n"
      "  plumbline lattice --box 1 1 1 --step 0.5 > triangles.csv");
  add_lattice_options(*verb, *options);
  verb->callback([options] { print_lattice(*options); });
}

}  // namespace plumbline
