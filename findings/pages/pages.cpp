#include "findings/pages/pages.h"

#include <algorithm>

#include "findings/pages/finding_page.h"
#include "findings/pages/list_page.h"

namespace plumbline {
namespace {

// The nominal first, the worst first.
std::vector<const FindingRow*> ranked(std::span<const FindingRow> rows) {
  std::vector<const FindingRow*> ranks;
  ranks.reserve(rows.size());
  for (const FindingRow& row : rows) ranks.push_back(&row);
  std::ranges::sort(ranks, [](const FindingRow* x, const FindingRow* y) {
    const auto ill = [](const FindingRow* r) { return r->conditioning != Conditioning::nominal; };
    if (ill(x) != ill(y)) return ill(y);
    if (x->worst.ulps != y->worst.ulps) return x->worst.ulps > y->worst.ulps;
    return x->id < y->id;
  });
  return ranks;
}

}  // namespace

void write_pages(std::span<const FindingRow> rows, std::span<const SearchRow> searches, const PageOptions& options,
                 const std::function<void(const std::string& name, const std::string& text)>& write) {
  const auto ranks = ranked(rows);
  const auto paged = std::span(ranks).first(std::min(options.pages, ranks.size()));
  for (std::size_t rank = 0; rank < paged.size(); ++rank) {
    const FindingFiles files = finding_files(paged, rank, options);
    write(page_name(paged[rank]->id, "case"), files.cases);
    write(page_name(paged[rank]->id, "html"), files.page);
    if (options.progress) options.progress(rank + 1, paged.size());
  }
  write("index.html", list_page(ranks, paged.size(), searches));
}

}  // namespace plumbline
