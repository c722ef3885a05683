// The options by which `sweep` and `lattice` choose triangles.
#pragma once
#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "case/lattice.h"

namespace plumbline {

/// As on the command line; decimals are kept as text, to be read exactly.
struct LatticeOptions {
  std::array<std::string, 3> box = {"2", "2", "2"};
  std::vector<std::string> step = {"1.5"};
  std::vector<std::array<std::string, 3>> offsets = {{"0", "0", "0"}};
  std::uint64_t first = 0;
  std::optional<std::uint64_t> count;
};

void add_lattice_options(CLI::App& verb, LatticeOptions& options);

/// A lattice for each offset.
std::vector<Lattice> lattices(const LatticeOptions& options);

}  // namespace plumbline
