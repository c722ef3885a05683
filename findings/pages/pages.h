// Findings as static pages, for a browser and nothing else: a list of all, and a page for each of the worst. Each
// page is one file with all it needs; nothing is fetched.
//
// While pages are written, this build's tracers are asked each page's cases once more.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "findings/finding_row.h"
#include "float_tracer/tracer.h"
#include "repros/repro.h"

namespace plumbline {

struct PageOptions {
  std::size_t pages = 200;             ///< so many findings get a page of their own, the worst nominal ones first
  std::vector<const Tracer*> tracers;  ///< whose answers a page compares; findings name their tracers as these do
  /// A repro of a case in which a tracer is wrong; no value where the case can't be told in that form.
  std::function<std::optional<std::string>(const Case&, ReproForm, std::string_view tracer)> repro = {};
  std::function<void(std::size_t done, std::size_t of)> progress = {};  ///< of the pages
};

/// Calls write(name, text) for each file: finding-ID.html and finding-ID.case of each finding that gets a page, at
/// last index.html, so that what it names is there. Throws InputError where several triangles
/// aren't surfaces.
void write_pages(std::span<const FindingRow> rows, std::span<const SearchRow> searches, const PageOptions& options,
                 const std::function<void(const std::string& name, const std::string& text)>& write);

}  // namespace plumbline
