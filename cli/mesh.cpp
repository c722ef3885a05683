#include <fmt/format.h>

#include "case/enum_names.h"
#include "case/input_error.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/verb.h"
#include "mesh/mesh_report.h"
#include "mesh/read_mesh.h"
#include "mesh/sphere.h"
#include "mesh/write_mesh.h"

namespace plumbline {
namespace {

struct ReportOptions {
  std::string file;
  bool json = false;
};

struct MakeOptions {
  std::string shape, precision = "binary64", output;
  SphereOptions sphere;
};

void print_report(const ReportOptions& options) {
  if (options.file.empty())
    throw InputError("which mesh? Name a file .obj, .ply or .stl; see 'plumbline mesh --help'");
  const MeshReport found = report(read_mesh(options.file));
  Output output;
  output.write(options.json ? to_json(found) : to_text(found));
  output.finish();
}

void make(MakeOptions options) {
  const MeshFormat format = mesh_format_of(options.output);
  if (!(options.sphere.jitter >= 0 && options.sphere.jitter < 1))
    throw InputError(fmt::format("--jitter {}: radii would not be positive; take 0 or more, and less than 1",
                                 options.sphere.jitter));
  if (options.sphere.triangles < 1 || options.sphere.triangles > most_sphere_triangles)
    throw InputError(fmt::format("--triangles {}: from 1 to {}", options.sphere.triangles, most_sphere_triangles));
  options.sphere.precision = *from_name<Precision>(precision_names, options.precision);
  Output output(options.output);
  write_mesh(make_sphere(options.sphere), format, [&output](std::string_view part) { output.write(part); });
  output.finish();
}

void add_make(CLI::App& mesh) {
  CLI::App* verb = mesh.add_subcommand("make", "Write a closed mesh of any size");
  auto options = std::make_shared<MakeOptions>();
  MakeOptions& o = *options;
  verb->add_option("SHAPE", o.shape, "sphere: around the origin, the faces of an icosahedron divided")
      ->required()
      ->check(CLI::IsMember({"sphere"}));
  verb->add_option("--triangles", o.sphere.triangles, "At least so many: the next 20 n^2")
      ->check(whole_number())
      ->type_name("N")
      ->required();
  verb->add_option("--jitter", o.sphere.jitter, "Radii are uniform in 1 +- J, 0 <= J < 1")
      ->type_name("J")
      ->capture_default_str();
  verb->add_option("--seed", o.sphere.seed, "The same seed gives the same bytes on every machine")
      ->check(whole_number())
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--precision", o.precision, "Round the coordinates to it")
      ->check(CLI::IsMember(std::vector<std::string>(precision_names.begin(), precision_names.end())))
      ->type_name("PRECISION")
      ->capture_default_str();
  verb->add_option(
          "-o,--output", o.output,
          "Where it goes, by its name a PLY (binary, of floats or doubles) or an OBJ; it appears whole or not at "
          "all")
      ->type_name("FILE")
      ->required();
  verb->footer(
      "\nExample, a mesh of half a million triangles:\n"
      "  plumbline mesh make sphere --triangles 500000 --jitter 0.001 --precision binary32 -o sphere.ply\n"
      "  plumbline mesh sphere.ply");
  verb->callback([options] { make(*options); });
}

}  // namespace

void add_mesh(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("mesh", "What a mesh file holds, and what it cannot hold; or make one");
  auto options = std::make_shared<ReportOptions>();
  verb->add_option("FILE", options->file, "A mesh: .obj, .ply (ascii or binary) or .stl (ascii or binary)");
  verb->add_flag("--json", options->json, "One JSON object instead of lines");
  verb->footer(
      "Vertices with equal coordinates are one vertex, exactly: no tolerance. Polygons become fans. Triangles count "
      "from 0.\n"
      "  coordinates       binary32 if all of them are floats, else binary64\n"
      "  pieces            triangles that hang together by vertices\n"
      "  degenerate        triangles without area, exactly: no ray hits them\n"
      "  duplicate         triangles with the vertices of an earlier one: each ray hits twice\n"
      "  open edges        of one triangle: rays pass there\n"
      "  non-manifold      edges of three triangles or more\n"
      "  misoriented       edges of two triangles that run along it the same way: one of them is inside out\n"
      "  closed            every edge is of two triangles that run along it in opposite ways\n"
      "  least edge, least altitude\n"
      "                    of a triangle with area, in units in the last place of the largest coordinate: a feature "
      "of a\n"
      "                    few ulps is as coarse as the numbers that hold it, and a tracer can't do better\n"
      "\nExamples:\n"
      "  plumbline mesh bunny.ply\n"
      "  plumbline mesh bunny.ply --json | jq .open_edges.count\n"
      "  plumbline mesh make sphere --triangles 500000 --jitter 0.001 --precision binary32 -o sphere.ply");
  add_make(*verb);
  verb->callback([verb, options] {
    if (verb->get_subcommands().empty()) print_report(*options);
  });
}

}  // namespace plumbline
